// The client of `mudline lsp`: it starts the server, restarts it when its setting changes, and says what is missing.
"use strict";

const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

const ID = "mudline";
const FILES = "**/{mudline.toml,pyproject.toml,*.keyx,*.keyxm,*.keyxi,*.das}";
const INSTALL = "Install it with `pip install \"mudline[lsp]\"`, or set `mudline.command` to its path.";

/** The client that runs now; undefined while none does. */
let client;

/** Reports files that other programs change; made once. */
let watcher;

/** Starts and stops follow each other: each waits for the one before. */
let queue = Promise.resolve();

function makeClient() {
  const [command, ...args] = vscode.workspace.getConfiguration(ID).get("command") ?? ["mudline", "lsp"];
  const options = {
    documentSelector: [{ scheme: "file", language: ID }, { scheme: "untitled", language: ID }],
    synchronize: { fileEvents: watcher },
  };
  const env = { ...process.env, PYTHONSAFEPATH: "1" }; // no module of the workspace is imported
  return new LanguageClient(ID, "mudline", { command, args, options: { env } }, options);
}

async function stop() {
  const running = client;
  client = undefined;
  if (running) {
    await running.dispose().catch(() => undefined); // it has ended by itself, or never began
  }
}

async function start() {
  await stop();
  if (!vscode.workspace.isTrusted) {
    return;
  }
  client = makeClient();
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    void vscode.window.showErrorMessage(`mudline does not start: ${error?.message ?? error}. ${INSTALL}`);
  }
}

function restart() {
  queue = queue.then(start);
  return queue;
}

function activate(context) {
  watcher = vscode.workspace.createFileSystemWatcher(FILES);
  context.subscriptions.push(
    watcher,
    vscode.commands.registerCommand("mudline.restart", restart),
    vscode.workspace.onDidGrantWorkspaceTrust(restart),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("mudline.command")) {
        void restart();
      }
    }),
  );
  return restart();
}

function deactivate() {
  queue = queue.then(stop);
  return queue;
}

module.exports = { activate, deactivate };
