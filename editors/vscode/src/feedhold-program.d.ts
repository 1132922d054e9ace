// What emscripten makes of the program for Node.js, as far as the extension uses it: package.mjs puts `feedhold-node.js` in
// the place of the name.
declare module "feedhold-program" {
  export interface Program {
    ENV: Record<string, string | undefined>; // what the program finds in its environment
    callMain(words: string[]): number;
  }
  export interface Options {
    wasmBinary: Uint8Array;
    buildId: string;
    preRun: ((program: Program) => void)[];
    receive(to: Uint8Array, milliseconds: number): number;
    send(bytes: Uint8Array): void;
  }
  const create: (options: Options) => Promise<Program>;
  export default create;
}
