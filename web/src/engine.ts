// One run of the program `feedhold`: a fresh instance with a file system in memory, as a process has it.
import type { Create, Program } from "feedhold-program";

const HOME = "/work";
const OUTPUT = "/output";
const ERRORS = "/errors";

export interface Request {
  words: string[]; // of the command line
  files: Record<string, string | Uint8Array>; // by path, below the folder in which it runs
  collect?: string; // a folder whose files are returned
}

export interface Outcome {
  code: number;
  output: string;
  errors: string;
  files: Record<string, Uint8Array>; // by path below the folder that was asked for
  fault?: string; // it did not come to its end; nothing else is of worth then
}

export async function run(create: Create, module: WebAssembly.Module, request: Request): Promise<Outcome> {
  let program: Program | undefined;
  try {
    program = await create({
      instantiateWasm(imports, receive) {
        WebAssembly.instantiate(module, imports).then((instance) => receive(instance));
        return {};
      },
      preRun: [(given) => prepare(given, request.files)],
      printErr() {}, // of the runtime itself, whose exceptions say the same
    });
    const code = program.callMain(request.words);
    const errors = textOf(program, ERRORS);
    if (errors.includes("std::bad_alloc")) return failed("it ran out of memory");
    const files = request.collect === undefined ? {} : filesBelow(program, `${HOME}/${request.collect}`);
    return { code, output: textOf(program, OUTPUT), errors, files };
  } catch (error) {
    const last = program && textOf(program, ERRORS).trim().split("\n").at(-1);
    return failed(last || describe(error));
  }
}

function failed(fault: string): Outcome {
  return { code: 2, output: "", errors: "", files: {}, fault };
}

function textOf(program: Program, path: string): string {
  return program.FS.readFile(path, { encoding: "utf8" });
}

/** Files, and standard output and error as files: they are read as whole texts behind the run. */
function prepare(program: Program, files: Request["files"]): void {
  const { FS } = program;
  FS.mkdir(HOME);
  for (const [path, content] of Object.entries(files)) {
    const full = `${HOME}/${path}`;
    FS.mkdirTree(full.slice(0, full.lastIndexOf("/")));
    FS.writeFile(full, content);
  }
  FS.chdir(HOME);
  for (const path of [OUTPUT, ERRORS]) FS.writeFile(path, "");
  FS.init(() => null);
  for (const [descriptor, path] of [[1, OUTPUT], [2, ERRORS]] as const) {
    FS.close(FS.getStream(descriptor));
    FS.open(path, "w", 0o666, descriptor);
  }
}

function filesBelow(program: Program, folder: string): Record<string, Uint8Array> {
  const { FS } = program;
  const found: Record<string, Uint8Array> = {};
  const visit = (path: string, name: string): void => {
    if (!FS.isDir(FS.stat(path).mode)) {
      found[name] = FS.readFile(path);
      return;
    }
    const entries = FS.readdir(path).filter((entry) => entry !== "." && entry !== "..");
    for (const entry of entries.sort()) visit(`${path}/${entry}`, name === "" ? entry : `${name}/${entry}`);
  };
  if (FS.analyzePath(folder).exists) visit(folder, "");
  return found;
}

function describe(error: unknown): string {
  const text = error instanceof Error ? error.message : String(error);
  if (error instanceof RangeError && /stack/i.test(text)) return "it ran out of stack";
  if (/memory|OOM/i.test(text)) return "it ran out of memory";
  return error instanceof Error ? text : "it threw an exception";
}
