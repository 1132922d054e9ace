// Starts `feedhold lsp` and hands it the settings; everything else is the server's work.
import { execFile } from "node:child_process";
import { dirname } from "node:path";
import { promisify } from "node:util";

import * as vscode from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions, TransportKind } from "vscode-languageclient/node";

import { NAME, chosen, pathBefore, programInside, scriptInside } from "./program";

const LANGUAGES = ["macrob", "macrob-contract"];
const SETUP_PAGE = "feedhold.path";

let client: LanguageClient | undefined;
let inside: string | undefined;
let script: string | undefined; // the program in WebAssembly
let runsScript = false; // the server that was started last

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  inside = programInside(context.extensionPath, process.platform);
  script = scriptInside(context.extensionPath);
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
  runsScript = problem?.isAbsent === true && command === NAME && script !== undefined;
  if (problem && !runsScript) {
    void complain(problem.text); // the editor need not wait for an answer
    return;
  }
  client = new LanguageClient("feedhold", "Feedhold", server(command), clientOptions());
  if (runsScript) client.info("No program `feedhold` is installed: the server runs in WebAssembly.");
  await client.start();
  await vscode.commands.executeCommand("setContext", "feedhold.running", true);
}

/** The script runs on the Node.js of the editor. */
function server(command: string): ServerOptions {
  if (runsScript && script) return { module: script, args: ["lsp"], transport: TransportKind.stdio };
  return { command, args: ["lsp"] };
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
    env: runsScript ? { ELECTRON_RUN_AS_NODE: "1" } : isInside ? pathBefore(path, process.env) : {},
  });
  terminal.show();
  const words = (runsScript && script ? [process.execPath, script] : [path]).map(quoted).join(" ");
  terminal.sendText(isInside ? run : run.replace(/^feedhold(?= )/, () => words));
}

function quoted(path: string): string {
  return path.includes(" ") ? `"${path}"` : path;
}

function activeDocument(): string[] {
  const document = vscode.window.activeTextEditor?.document;
  return document ? [document.uri.toString()] : [];
}

interface Problem {
  text: string;
  isAbsent?: boolean; // there is no such program
}

/** Why `command` cannot be the server; nothing when it can. */
async function whyNot(command: string): Promise<Problem | undefined> {
  try {
    await promisify(execFile)(command, ["lsp", "--help"]);
    return undefined;
  } catch (error) {
    const { code } = error as NodeJS.ErrnoException;
    if (code === "ENOENT") return { text: `The program \`${command}\` was not found.`, isAbsent: true };
    if (code === "EACCES") return { text: `\`${command}\` cannot be executed: permission denied.` };
    return { text: `\`${command} lsp\` does not start. The program is older than this extension, or it is not Feedhold.` };
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
