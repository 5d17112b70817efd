// A language server that finds "wrong" in a document, for tests of the client: no mudline is needed.
"use strict";

let rest = Buffer.alloc(0);

function send(message) {
  const body = Buffer.from(JSON.stringify({ jsonrpc: "2.0", ...message }));
  process.stdout.write(`Content-Length: ${body.length}\r\n\r\n`);
  process.stdout.write(body);
}

function publish({ uri, text }) {
  const lines = text.split("\n");
  const diagnostics = lines.flatMap((line, number) => {
    const at = line.indexOf("ten");
    const place = { start: { line: number, character: at }, end: { line: number, character: at + 3 } };
    return at < 0 ? [] : [{ range: place, severity: 1, code: "SYN002", source: "mudline", message: "not a number" }];
  });
  send({ method: "textDocument/publishDiagnostics", params: { uri, diagnostics } });
}

function take({ id, method, params }) {
  if (method === "initialize") {
    send({ id, result: { capabilities: { textDocumentSync: 1, hoverProvider: true } } });
  } else if (method === "textDocument/didOpen") {
    publish(params.textDocument);
  } else if (method === "exit") {
    process.exit(0);
  } else if (id !== undefined) {
    send({ id, result: null });
  }
}

process.stdin.on("data", (data) => {
  rest = Buffer.concat([rest, data]);
  for (;;) {
    const head = rest.indexOf("\r\n\r\n");
    const length = Number(/Content-Length: (\d+)/i.exec(rest.subarray(0, Math.max(head, 0)).toString())?.[1]);
    if (head < 0 || rest.length < head + 4 + length) {
      return;
    }
    const body = rest.subarray(head + 4, head + 4 + length).toString();
    rest = rest.subarray(head + 4 + length);
    take(JSON.parse(body));
  }
});
