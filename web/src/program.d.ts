// What emscripten makes of the program, as far as the page uses it: build.mjs puts `feedhold.mjs` in the place of the name.
declare module "feedhold-program" {
  export interface Files {
    init(input: () => number | null): void;
    mkdir(path: string): void;
    mkdirTree(path: string): void;
    chdir(path: string): void;
    writeFile(path: string, content: string | Uint8Array): void;
    readFile(path: string): Uint8Array;
    readFile(path: string, options: { encoding: "utf8" }): string;
    readdir(path: string): string[];
    stat(path: string): { mode: number };
    isDir(mode: number): boolean;
    analyzePath(path: string): { exists: boolean };
    getStream(descriptor: number): unknown;
    open(path: string, flags: string, mode: number, descriptor: number): unknown;
    close(stream: unknown): void;
  }
  export interface Program {
    FS: Files;
    callMain(words: string[]): number;
  }
  export interface Options {
    instantiateWasm(imports: WebAssembly.Imports, receive: (instance: WebAssembly.Instance) => void): object;
    preRun: ((program: Program) => void)[];
    printErr(text: string): void;
  }
  export type Create = (options: Options) => Promise<Program>;
  const create: Create;
  export default create;
}

declare module "*.css" {
  const text: string;
  export default text;
}

/** The script of the worker, and the examples: build.mjs fills them in. */
declare const WORKER: string;
declare const EXAMPLES: import("./examples").Example[];
