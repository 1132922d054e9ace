// Starts `feedhold lsp` and hands it the settings; everything else is the server's work.
import { execFile } from "node:child_process";
import { dirname } from "node:path";
import { promisify } from "node:util";

import * as vscode from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";

import { NAME, chosen, pathBefore, programInside } from "./program";

const LANGUAGES = ["macrob", "macrob-contract"];
const SETUP_PAGE = "feedhold.path";

let client: LanguageClient | undefined;
let inside: string | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  inside = programInside(context.extensionPath, process.platform);
  context.subscriptions.push(
    vscode.commands.registerCommand("feedhold.restart", restart),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("feedhold.path")) await restart();
    }),
    vscode.workspace.onDidGrantWorkspaceTrust(restart),
  );
  await start();
}

export async function deactivate(): Promise<void> {
  await stop();
}

async function restart(): Promise<void> {
  await stop();
  await start();
}

async function stop(): Promise<void> {
  const old = client;
  client = undefined;
  await vscode.commands.executeCommand("setContext", "feedhold.running", false);
  await old?.dispose();
}

async function start(): Promise<void> {
  const command = program();
  const problem = await whyNot(command);
  if (problem) {
    void complain(problem); // the editor need not wait for an answer
    return;
  }
  const server: ServerOptions = { command, args: ["lsp"] };
  client = new LanguageClient("feedhold", "Feedhold", server, clientOptions());
  await client.start();
  await vscode.commands.executeCommand("setContext", "feedhold.running", true);
}

function program(): string {
  return chosen(vscode.workspace.getConfiguration("feedhold").get("path", NAME), inside);
}

function clientOptions(): LanguageClientOptions {
  const { proofs } = vscode.workspace.getConfiguration("feedhold");
  return {
    documentSelector: LANGUAGES.flatMap((language) => ["file", "untitled"].map((scheme) => ({ scheme, language }))),
    initializationOptions: { proofs },
    synchronize: { configurationSection: "feedhold" },
    middleware: {
      // The palette passes nothing: then the program in front of the user is meant.
      executeCommand: async (command, args, next) => {
        const answer: unknown = await next(command, args.length ? args : activeDocument());
        if (command === "feedhold.runWitness") runInTerminal(answer, args);
        return answer;
      },
    },
  };
}

/** A witness comes with the command line that shows its run: `feedhold run ..`. */
function runInTerminal(answer: unknown, args: unknown[]): void {
  const { run } = (answer ?? {}) as { run?: string };
  const { uri } = (args[0] ?? {}) as { uri?: string };
  if (!run || !uri) return;
  const path = program();
  const isInside = path === inside;
  const terminal = vscode.window.createTerminal({
    name: "Feedhold",
    cwd: dirname(vscode.Uri.parse(uri).fsPath),
    env: isInside ? pathBefore(path, process.env) : {},
  });
  terminal.show();
  const word = path.includes(" ") ? `"${path}"` : path;
  terminal.sendText(isInside ? run : run.replace(/^feedhold(?= )/, word));
}

function activeDocument(): string[] {
  const document = vscode.window.activeTextEditor?.document;
  return document ? [document.uri.toString()] : [];
}

/** Why `command` cannot be the server; nothing when it can. */
async function whyNot(command: string): Promise<string | undefined> {
  try {
    await promisify(execFile)(command, ["lsp", "--help"]);
    return undefined;
  } catch (error) {
    const { code } = error as NodeJS.ErrnoException;
    if (code === "ENOENT") return `The program \`${command}\` was not found.`;
    if (code === "EACCES") return `\`${command}\` cannot be executed: permission denied.`;
    return `\`${command} lsp\` does not start. The program is older than this extension, or it is not Feedhold.`;
  }
}

async function complain(problem: string): Promise<void> {
  const settings = "Open Settings";
  const again = "Try Again";
  const wayOut = "Install Feedhold, put it on the PATH, or set `feedhold.path`.";
  const answer = await vscode.window.showErrorMessage(`${problem} ${wayOut}`, settings, again);
  if (answer === settings) await vscode.commands.executeCommand("workbench.action.openSettings", SETUP_PAGE);
  if (answer === again) await start();
}
