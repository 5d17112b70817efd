// What the client uses of VS Code, without VS Code: `module.exports.vscode` is required in its place, `state` says what
// the client did. A class that is not written out here is an empty one.
"use strict";

const { pathToFileURL, fileURLToPath } = require("node:url");
const { EventEmitter: Emitter } = require("node:events");

const state = {
  config: {},
  trusted: true,
  documents: [],
  diagnostics: new Map(),
  providers: [],
  commands: new Map(),
  taskProviders: new Map(),
  interpreter: undefined,
  folders: undefined,
  errors: [],
  log: [],
};

class Disposable {
  constructor(dispose = () => undefined) {
    this.dispose = dispose;
  }
  static from(...all) {
    return new Disposable(() => all.forEach((one) => one.dispose()));
  }
}

class EventEmitter {
  constructor() {
    this.emitter = new Emitter();
    this.event = (listener, self, disposables) => {
      const call = (value) => listener.call(self, value);
      this.emitter.on("event", call);
      const off = new Disposable(() => this.emitter.off("event", call));
      disposables?.push(off);
      return off;
    };
  }
  fire(value) {
    this.emitter.emit("event", value);
  }
  dispose() {
    this.emitter.removeAllListeners();
  }
}

class Uri {
  constructor(text) {
    this.text = text;
    const parsed = new URL(text);
    this.scheme = parsed.protocol.slice(0, -1);
    this.authority = parsed.host;
    this.path = decodeURIComponent(parsed.pathname);
    this.query = "";
    this.fragment = "";
  }
  get fsPath() {
    return fileURLToPath(this.text);
  }
  toString() {
    return this.text;
  }
  with() {
    return this;
  }
  static parse(text) {
    return new Uri(text);
  }
  static file(path) {
    return new Uri(pathToFileURL(path).href);
  }
}

class Position {
  constructor(line, character) {
    Object.assign(this, { line, character });
  }
}

class Range {
  constructor(...given) {
    const [start, end] = given.length === 4 ? [new Position(given[0], given[1]), new Position(given[2], given[3])] : given;
    Object.assign(this, { start, end });
  }
}

class Diagnostic {
  constructor(range, message, severity) {
    Object.assign(this, { range, message, severity });
  }
}

class CodeActionKind {
  constructor(value) {
    this.value = value;
  }
  append(part) {
    return new CodeActionKind(this.value ? `${this.value}.${part}` : part);
  }
  static Empty = new CodeActionKind("");
}

class CancellationTokenSource {
  constructor() {
    this.emitter = new EventEmitter();
    this.token = { isCancellationRequested: false, onCancellationRequested: this.emitter.event };
  }
  cancel() {
    this.token.isCancellationRequested = true;
    this.emitter.fire();
  }
  dispose() {}
}

const events = new Map();

/** The emitter behind an `onDid...` of VS Code. */
function emitter(name) {
  if (!events.has(name)) {
    events.set(name, new EventEmitter());
  }
  return events.get(name);
}

/** An object of VS Code: what is not given is an event, a `register...`, or nothing. */
function partial(given) {
  return new Proxy(given, {
    get(target, name) {
      if (name in target || typeof name !== "string") {
        return target[name];
      }
      if (/^on(Did|Will)/.test(name)) {
        return emitter(name).event;
      }
      if (name.startsWith("register")) {
        return () => {
          state.providers.push(name);
          return new Disposable();
        };
      }
      return undefined;
    },
  });
}

function logger() {
  const line = (text) => void state.log.push(String(text));
  const named = Object.fromEntries(["append", "appendLine", "trace", "debug", "info", "warn", "error"].map((name) => [name, line]));
  return { ...named, show() {}, clear() {}, replace() {}, dispose() {}, logLevel: 3, onDidChangeLogLevel: emitter("logLevel").event };
}

const workspace = partial({
  get isTrusted() {
    return state.trusted;
  },
  get textDocuments() {
    return state.documents;
  },
  get workspaceFolders() {
    return state.folders;
  },
  notebookDocuments: [],
  getConfiguration: (section) => ({
    get: (key, fallback) => state.config[`${section}.${key}`] ?? fallback,
    has: () => false,
    inspect: () => undefined,
  }),
  createFileSystemWatcher: () => partial({ dispose() {} }),
  applyEdit: async () => true,
});

const window = partial({
  activeTextEditor: undefined,
  visibleTextEditors: [],
  tabGroups: partial({ all: [], activeTabGroup: { tabs: [] } }),
  createOutputChannel: logger,
  showErrorMessage: async (text) => void state.errors.push(text),
  showWarningMessage: async (text) => void state.errors.push(text),
  showInformationMessage: async () => undefined,
  withProgress: async (_options, task) => task({ report() {} }, new CancellationTokenSource().token),
});

const languages = partial({
  match: (selector, document) => ([selector].flat().some((one) => (one.language ?? one) === document.languageId) ? 10 : 0),
  createDiagnosticCollection: () => ({
    set: (uri, found) => void state.diagnostics.set(uri.toString(), found),
    delete: (uri) => void state.diagnostics.delete(uri.toString()),
    clear: () => state.diagnostics.clear(),
    dispose() {},
  }),
});

const commands = partial({
  registerCommand: (name, run) => {
    state.commands.set(name, run);
    return new Disposable(() => state.commands.delete(name));
  },
});

const tasks = {
  registerTaskProvider: (type, provider) => {
    state.taskProviders.set(type, provider);
    return new Disposable(() => state.taskProviders.delete(type));
  },
};

/** The extension for Python, with an interpreter that was selected; undefined: it is not installed. */
const extensions = {
  getExtension: (name) =>
    name === "ms-python.python" && state.interpreter
      ? {
          activate: async () => ({
            environments: {
              getActiveEnvironmentPath: () => ({ path: state.interpreter }),
              onDidChangeActiveEnvironmentPath: emitter("interpreter").event,
            },
          }),
        }
      : undefined,
};

class ProcessExecution {
  constructor(process, args, options) {
    Object.assign(this, { process, args, options });
  }
}

class Task {
  constructor(definition, scope, name, source, execution, problemMatchers) {
    Object.assign(this, { definition, scope, name, source, execution, problemMatchers });
  }
}

const known = {
  version: "1.101.0",
  workspace,
  window,
  languages,
  commands,
  tasks,
  extensions,
  ProcessExecution,
  Task,
  env: { language: "en", appName: "stub", openExternal: async () => true, uriScheme: "vscode" },
  Disposable,
  EventEmitter,
  Uri,
  Position,
  Range,
  Diagnostic,
  CodeActionKind,
  CancellationTokenSource,
  CancellationError: class extends Error {},
  DiagnosticSeverity: { Error: 0, Warning: 1, Information: 2, Hint: 3 },
};

const vscode = new Proxy(known, {
  get(target, name) {
    if (!(name in target) && typeof name === "string") {
      target[name] = class {};
    }
    return target[name];
  },
});

/** A document as VS Code has it open. */
function makeDocument(path, text) {
  return { uri: Uri.file(path), fileName: path, languageId: "mudline", version: 1, isClosed: false, getText: () => text };
}

module.exports = { vscode, state, emitter, makeDocument };
