/** The server as the extension starts it, driven by the client library that the extension is built on. */

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { pathToFileURL } from "node:url";

import {
  createProtocolConnection,
  DidChangeTextDocumentNotification,
  DidOpenTextDocumentNotification,
  ExitNotification,
  HoverRequest,
  InitializedNotification,
  InitializeRequest,
  PublishDiagnosticsNotification,
  ShutdownRequest,
  StreamMessageReader,
  StreamMessageWriter,
  type Diagnostic,
} from "vscode-languageserver-protocol/node";

import { programOf, SELECTOR } from "../src/server";

const LIST = "kopf.achs_nr 1\nkw.ssfk.unit 1\nkw.ssfk.intervall 100000 # größer 😀\n";

void test("the setting names the program", () => {
  assert.deepEqual(programOf(undefined), { command: "axcomp", args: ["lsp"] });
  assert.deepEqual(programOf([]), { command: "axcomp", args: ["lsp"] });
  assert.deepEqual(programOf(["py", "-m", "x"]), { command: "py", args: ["-m", "x"] });
  assert.ok(SELECTOR.some((one) => one.language === "lis"));
});

void test("the server answers the client", async () => {
  const path = join(mkdtempSync(join(tmpdir(), "axcomp-")), "achskw1.lis");
  writeFileSync(path, LIST);
  const uri = pathToFileURL(path).href;
  const setting = JSON.parse(process.env.AXCOMP_COMMAND ?? "[]") as string[];
  const { command, args } = programOf(setting);
  const server = spawn(command, args, { stdio: ["pipe", "pipe", "inherit"] });
  const connection = createProtocolConnection(new StreamMessageReader(server.stdout), new StreamMessageWriter(server.stdin));
  const told: Diagnostic[][] = [];
  let wake: () => void = () => undefined;
  connection.onNotification(PublishDiagnosticsNotification.type, (parameters) => {
    told.push(parameters.diagnostics);
    wake();
  });
  connection.listen();
  const until = async (true_: (codes: unknown[]) => boolean): Promise<void> => {
    while (!true_(told.at(-1)?.map((one) => one.code) ?? ["nothing"])) {
      await new Promise<void>((resolve) => (wake = resolve));
    }
  };

  const { capabilities } = await connection.sendRequest(InitializeRequest.type, {
    processId: process.pid,
    rootUri: null, // eslint-disable-line @typescript-eslint/no-deprecated -- the protocol still asks for it
    capabilities: {},
  });
  for (const provider of ["hoverProvider", "completionProvider", "definitionProvider", "renameProvider"] as const) {
    assert.ok(capabilities[provider], provider);
  }
  await connection.sendNotification(InitializedNotification.type, {});
  await connection.sendNotification(DidOpenTextDocumentNotification.type, {
    textDocument: { uri, languageId: "lis", version: 1, text: LIST },
  });
  await until((codes) => codes.includes("AXC-TYPO"));
  const position = { line: 2, character: 10 };
  const hover = await connection.sendRequest(HoverRequest.type, { textDocument: { uri }, position });
  assert.match(JSON.stringify(hover), /kw\.ssfk\.interval/);
  const range = { start: { line: 2, character: 16 }, end: { line: 2, character: 17 } };
  await connection.sendNotification(DidChangeTextDocumentNotification.type, {
    textDocument: { uri, version: 2 },
    contentChanges: [{ range, text: "" }],
  });
  await until((codes) => !codes.includes("AXC-TYPO") && !codes.includes("nothing"));
  await connection.sendRequest(ShutdownRequest.type);
  await connection.sendNotification(ExitNotification.type);
  assert.equal(await new Promise((resolve) => server.once("exit", resolve)), 0);
  connection.dispose();
});
