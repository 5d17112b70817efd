// The client against a stub of VS Code. MUDLINE_CLIENT is the file that is tested, the source by default;
// MUDLINE_SERVER the command of a server as JSON, that of test/server.js by default.
"use strict";

const assert = require("node:assert/strict");
const fs = require("node:fs");
const Module = require("node:module");
const os = require("node:os");
const path = require("node:path");
const { afterEach, beforeEach, test } = require("node:test");

const { vscode, state, emitter, makeDocument } = require("./vscode-stub.js");

const load = Module._load;
Module._load = function (name, ...others) {
  return name === "vscode" ? vscode : load.call(this, name, ...others);
};

const SERVER = process.env.MUDLINE_SERVER
  ? JSON.parse(process.env.MUDLINE_SERVER)
  : [process.execPath, path.join(__dirname, "server.js")];
const DECK = "$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 0.0, ten\n";

const { activate, deactivate } = require(process.env.MUDLINE_CLIENT ?? "../extension.js");

let folder;
let context;

beforeEach(() => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "mudline-client-"));
  context = { subscriptions: [] };
  state.trusted = true;
  state.errors.length = 0;
  state.documents.length = 0;
  state.diagnostics.clear();
  state.interpreter = undefined;
  state.folders = undefined;
  state.config = { "mudline.command": SERVER };
});

afterEach(async () => {
  await deactivate();
  context.subscriptions.forEach((one) => one.dispose());
  fs.rmSync(folder, { recursive: true });
});

/** An open deck, as a file too. */
function open(text = DECK) {
  const file = path.join(folder, "deck.keyxm");
  fs.writeFileSync(file, text);
  const document = makeDocument(file, text);
  state.documents.push(document);
  return document;
}

/** Wait until something holds. */
async function until(holds, what) {
  for (let waited = 0; !holds(); waited += 20) {
    assert.ok(waited < 20_000, `waited for ${what} in vain: ${state.errors.join("; ")} ${state.log.slice(-5).join("\n")}`);
    await new Promise((done) => setTimeout(done, 20));
  }
}

const foundIn = (document) => state.diagnostics.get(document.uri.toString()) ?? [];

test("findings of an open deck are shown where they are", async () => {
  const document = open();
  await activate(context);
  await until(() => foundIn(document).length, "findings");
  const [found] = foundIn(document).filter((one) => one.range.start.line === 3);
  assert.deepEqual([found.range.start.character, found.range.end.character], [9, 12]);
  assert.equal(found.severity, vscode.DiagnosticSeverity.Error);
  assert.equal(typeof found.code === "object" ? found.code.value : found.code, "SYN002");
  assert.ok(state.providers.includes("registerHoverProvider"));
  assert.deepEqual(state.errors, []);
});

test("a deck that is opened later, and closed", async () => {
  await activate(context);
  const document = open();
  emitter("onDidOpenTextDocument").fire(document);
  await until(() => foundIn(document).length, "findings");
  emitter("onDidCloseTextDocument").fire(document);
});

test("the command restarts the server, and so does its setting", async () => {
  const document = open();
  await activate(context);
  await until(() => foundIn(document).length, "findings");
  await state.commands.get("mudline.restart")();
  await until(() => foundIn(document).length, "findings after a restart");
  state.diagnostics.clear();
  emitter("onDidChangeConfiguration").fire({ affectsConfiguration: (name) => name === "mudline.command" });
  await until(() => foundIn(document).length, "findings after a change of the setting");
  assert.deepEqual(state.errors, []);
});

test("a program that is missing is said, with what to do", async () => {
  state.config = { "mudline.command": [path.join(folder, "no-mudline"), "lsp"] };
  await activate(context);
  await until(() => state.errors.some((text) => text.includes("does not start")), "the message");
  assert.ok(state.errors.some((text) => text.includes('pip install "mudline[lsp]"')));
});

/** An environment with a program called mudline that runs the server of the tests; returns its folder. */
function environment(place) {
  const programs = path.join(folder, place, process.platform === "win32" ? "Scripts" : "bin");
  const run = SERVER.map((word) => JSON.stringify(word)).join(" ");
  fs.mkdirSync(programs, { recursive: true });
  const name = process.platform === "win32" ? "mudline.exe" : "mudline"; // there it is found only, not run
  fs.writeFileSync(path.join(programs, name), `#!/bin/sh\nexec ${run} "$@"\n`, { mode: 0o755 });
  return path.join(folder, place);
}

const workspaceOf = (place) => [{ uri: vscode.Uri.file(place), name: "work", index: 0 }];

test("mudline is found in .venv of the workspace, and before it in the selected interpreter", async () => {
  const { find } = require("../find.js");
  const venv = environment(".venv");
  const other = environment("other");
  assert.equal(find([], undefined, [folder]).source, ".venv");
  assert.ok(find([], undefined, [folder]).command[0].startsWith(venv));
  for (const interpreter of [other, path.join(other, process.platform === "win32" ? "Scripts" : "bin", "python")]) {
    const found = find([], interpreter, [folder]);
    assert.equal(found.source, "the selected interpreter");
    assert.ok(found.command[0].startsWith(other));
  }
  assert.equal(find([], path.join(folder, "empty", "bin", "python"), [folder]).source, ".venv");
  assert.deepEqual(find([], undefined, []), { command: ["mudline"], source: "PATH" });
  assert.deepEqual(find(["here", "lsp"], other, [folder]), { command: ["here", "lsp"], source: "mudline.command" });
});

test("the server of the selected interpreter serves, and the one of another interpreter after it", { skip: process.platform === "win32" }, async () => {
  state.config = {};
  state.interpreter = environment("selected");
  const document = open();
  await activate(context);
  await until(() => foundIn(document).length, "findings");
  state.diagnostics.clear();
  state.interpreter = environment("another");
  emitter("interpreter").fire();
  await until(() => foundIn(document).length, "findings of the other interpreter");
  assert.deepEqual(state.errors, []);
});

test("a task lints all decks of a folder", async () => {
  state.config = {};
  environment(".venv");
  state.folders = workspaceOf(folder);
  await activate(context);
  const [task] = state.taskProviders.get("mudline").provideTasks();
  assert.deepEqual(task.execution.args, ["lint", "--color", "never", "."]);
  assert.ok(task.execution.process.startsWith(path.join(folder, ".venv")));
  assert.equal(task.execution.options.cwd, folder);
  assert.equal(task.problemMatchers, "$mudline");
  state.trusted = false;
  assert.deepEqual(state.taskProviders.get("mudline").provideTasks(), []);
});

test("no program is started in a workspace that is not trusted, until it is", async () => {
  const document = open();
  state.trusted = false;
  await activate(context);
  assert.equal(foundIn(document).length, 0);
  state.trusted = true;
  emitter("onDidGrantWorkspaceTrust").fire();
  await until(() => foundIn(document).length, "findings");
});
