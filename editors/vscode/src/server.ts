// The program `feedhold` in WebAssembly, on the Node.js that runs the extension: `feedhold.js WORDS..`, as the program
// itself takes them.  It works in a worker and waits there for its client: who waits on the main thread receives nothing.
import fs from "node:fs";
import { join } from "node:path";
import { MessageChannel, Worker, isMainThread, receiveMessageOnPort, workerData } from "node:worker_threads";
import type { MessagePort } from "node:worker_threads";

import create from "feedhold-program";

/** That of the program, to know again what it has kept on disk. */
declare const BUILD_ID: string;

const COULD_NOT_RUN = 2;
const STANDARD_OUTPUT = 1;
/** Deeply nested programs need as much as elsewhere; a worker has 4 otherwise. */
const STACK_MB = 16;
/** Until someone who is slow to read, or to write, is tried again. */
const PAUSE_MS = 5;

interface Work {
  words: string[];
  client: MessagePort;
  arrivals: Int32Array; // one number: how many messages have been sent to the port
}

if (isMainThread) begin(process.argv.slice(2));
else void work(workerData as Work);

function begin(words: string[]): void {
  const { port1, port2 } = new MessageChannel();
  const arrivals = new Int32Array(new SharedArrayBuffer(Int32Array.BYTES_PER_ELEMENT));
  const given: Work = { words, client: port2, arrivals };
  const worker = new Worker(__filename, {
    workerData: given,
    transferList: [port2],
    resourceLimits: { stackSizeMb: STACK_MB },
  });
  worker.on("error", (error) => {
    console.error(`feedhold: ${error.message}`);
    process.exit(COULD_NOT_RUN);
  });
  worker.on("exit", (code) => process.exit(code));
  if (words[0] !== "lsp") return; // the program reads it itself
  const deliver = (chunk: Uint8Array | null): void => {
    port1.postMessage(chunk);
    Atomics.add(arrivals, 0, 1);
    Atomics.notify(arrivals, 0);
  };
  process.stdin.on("data", deliver);
  process.stdin.on("end", () => deliver(null));
  process.stdin.on("error", () => deliver(null));
}

async function work({ words, client, arrivals }: Work): Promise<void> {
  // What the program writes by itself: the pipes of Node.js do not wait until they are read.
  fs.writeSync = patient(fs.writeSync);
  fs.readSync = patient(fs.readSync);
  const program = await create({
    wasmBinary: fs.readFileSync(join(__dirname, "feedhold.wasm")),
    buildId: BUILD_ID,
    preRun: [(given) => Object.assign(given.ENV, process.env)],
    receive: receiver(client, arrivals),
    send: writeAll,
  });
  process.exit(program.callMain(words));
}

/** Fills an array: how many bytes came; 0 when none did in that time, and -1 when the client is gone. */
function receiver(client: MessagePort, arrivals: Int32Array): (to: Uint8Array, milliseconds: number) => number {
  let rest: Uint8Array = new Uint8Array();
  let isOver = false;
  return (to, milliseconds) => {
    const until = milliseconds < 0 ? Infinity : performance.now() + milliseconds;
    while (rest.length === 0 && !isOver) {
      const seen = Atomics.load(arrivals, 0); // before the look: what comes behind it does not let it wait
      const arrived = receiveMessageOnPort(client) as { message: Uint8Array | null } | undefined;
      if (arrived) {
        isOver = arrived.message === null;
        rest = arrived.message ?? rest;
        continue;
      }
      const left = until - performance.now();
      if (left <= 0) return 0;
      Atomics.wait(arrivals, 0, seen, left);
    }
    if (rest.length === 0) return -1;
    const count = Math.min(rest.length, to.length);
    to.set(rest.subarray(0, count));
    rest = rest.subarray(count);
    return count;
  };
}

function writeAll(bytes: Uint8Array): void {
  try {
    for (let at = 0; at < bytes.length; ) at += fs.writeSync(STANDARD_OUTPUT, bytes, at);
  } catch {
    // The client is gone, and nobody reads.
  }
}

/** The same function, for as long as it takes. */
function patient<T extends (...words: never[]) => number>(once: T): T {
  const pause = new Int32Array(new SharedArrayBuffer(Int32Array.BYTES_PER_ELEMENT));
  const again = (...words: Parameters<T>): number => {
    for (;;) {
      try {
        return once(...words);
      } catch (error) {
        if ((error as NodeJS.ErrnoException).code !== "EAGAIN") throw error;
        Atomics.wait(pause, 0, 0, PAUSE_MS);
      }
    }
  };
  return again as T;
}
