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
  await until(() => state.errors.some((text) => text.includes("mudline does not start")), "the message");
  assert.ok(state.errors.some((text) => text.includes('pip install "mudline[lsp]"')));
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
