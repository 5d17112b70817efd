// The client of `mudline lsp`: it starts the server, starts it again when another one is to be taken, says what is
// missing, and offers a task that lints all decks of a folder.
"use strict";

const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { find } = require("./find.js");

const ID = "mudline";
const FILES = "**/{mudline.toml,pyproject.toml,*.keyx,*.keyxm,*.keyxi,*.das}";
const INSTALL =
  'Install it into the selected interpreter with `python -m pip install "mudline[lsp]"`, or set `mudline.command` to its path.';

/** The client that runs now; undefined while none does. */
let client;

/** Reports files that other programs change; made once. */
let watcher;

/** Starts and stops follow each other: each waits for the one before. */
let queue = Promise.resolve();

/** The environments of the extension for Python; undefined where it is not installed. */
let environments;

const folders = () => (vscode.workspace.workspaceFolders ?? []).map((folder) => folder.uri.fsPath);

async function followInterpreter(context) {
  const python = vscode.extensions.getExtension("ms-python.python");
  environments = python && (await python.activate().catch(() => undefined))?.environments;
  const changed = environments?.onDidChangeActiveEnvironmentPath?.(() => void restart());
  if (changed) {
    context.subscriptions.push(changed);
  }
}

/** The command that was found, without arguments. */
function found() {
  const configured = vscode.workspace.getConfiguration(ID).get("command") ?? [];
  const resource = vscode.workspace.workspaceFolders?.[0]?.uri;
  return find(configured, environments?.getActiveEnvironmentPath?.(resource)?.path, folders());
}

function makeClient() {
  const { command: [command, ...args], source } = found();
  const served = source === "mudline.command" && args.at(-1) === "lsp" ? args : [...args, "lsp"];
  const options = {
    documentSelector: [{ scheme: "file", language: ID }, { scheme: "untitled", language: ID }],
    synchronize: { fileEvents: watcher },
  };
  const env = { ...process.env, PYTHONSAFEPATH: "1" }; // no module of the workspace is imported
  return new LanguageClient(ID, "mudline", { command, args: served, options: { env } }, options);
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
    const { command, source } = found();
    const what = `${command[0]} (from ${source}) does not start: ${error?.message ?? error}`;
    void vscode.window.showErrorMessage(`mudline: ${what}. ${INSTALL}`);
  }
}

function restart() {
  queue = queue.then(start);
  return queue;
}

/** A task for each folder that lints its decks; the problem matcher shows what it prints. */
function lintTasks() {
  if (!vscode.workspace.isTrusted) {
    return [];
  }
  return (vscode.workspace.workspaceFolders ?? []).map((folder) => {
    const { command: [command, ...args] } = found();
    const plain = args.at(-1) === "lsp" ? args.slice(0, -1) : args;
    const run = new vscode.ProcessExecution(command, [...plain, "lint", "--color", "never", "."], { cwd: folder.uri.fsPath });
    return new vscode.Task({ type: ID, task: "lint" }, folder, "lint all decks", ID, run, "$mudline");
  });
}

async function activate(context) {
  watcher = vscode.workspace.createFileSystemWatcher(FILES);
  context.subscriptions.push(
    watcher,
    vscode.commands.registerCommand("mudline.restart", restart),
    vscode.tasks.registerTaskProvider(ID, { provideTasks: lintTasks, resolveTask: () => undefined }),
    vscode.workspace.onDidGrantWorkspaceTrust(restart),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("mudline.command")) {
        void restart();
      }
    }),
  );
  await followInterpreter(context);
  return restart();
}

function deactivate() {
  queue = queue.then(stop);
  return queue;
}

module.exports = { activate, deactivate };
