/** The client: starts `axcomp lsp`, and starts it anew when its settings change. */

import * as vscode from "vscode";
import { LanguageClient, type LanguageClientOptions } from "vscode-languageclient/node";

import { programOf, SELECTOR, WATCHED } from "./server";

let client: LanguageClient | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  context.subscriptions.push(
    vscode.workspace.onDidChangeConfiguration(async (event) => {
      if (event.affectsConfiguration("axcomp.command")) {
        await deactivate();
        await start();
      }
    }),
  );
  await start();
}

export async function deactivate(): Promise<void> {
  await client?.stop();
  client = undefined;
}

async function start(): Promise<void> {
  const program = programOf(vscode.workspace.getConfiguration("axcomp").get<string[]>("command"));
  const options: LanguageClientOptions = {
    documentSelector: SELECTOR,
    synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher(WATCHED) },
  };
  client = new LanguageClient("axcomp", "axcomp", program, options);
  try {
    await client.start();
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    void vscode.window.showErrorMessage(
      `${program.command} does not start: ${why}. pip install 'axcomp[lsp]' installs it; axcomp.command names another one.`,
    );
  }
}
