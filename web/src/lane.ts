// Lane: a worker that answers one request at a time.  A worker that fails, or is stopped, is replaced by a new one.
import type { Outcome, Request } from "./engine";

/** A newer request has taken the place of this one, or the person has stopped it: nobody waits for the answer. */
export class Dropped extends Error {}

/** The program did not come to its end. */
export class Fault extends Error {}

interface Job {
  request: Request;
  resolve(outcome: Outcome): void;
  reject(error: Error): void;
}

export class Lane {
  private worker: Worker | undefined;
  private running: Job | undefined;
  private waiting: Job | undefined;
  private clock: number | undefined;

  /** `limit`: seconds after which a run is given up. */
  constructor(
    private readonly module: Promise<WebAssembly.Module>,
    private readonly script: string,
    private readonly limit: number,
  ) {}

  run(request: Request): Promise<Outcome> {
    return new Promise((resolve, reject) => {
      this.waiting?.reject(new Dropped());
      this.waiting = { request, resolve, reject };
      this.next();
    });
  }

  /** Whatever runs or waits. */
  stop(): void {
    this.waiting?.reject(new Dropped());
    this.waiting = undefined;
    if (this.running) this.fail(new Dropped());
  }

  private next(): void {
    if (this.running || !this.waiting) return;
    const job = this.waiting;
    this.running = job;
    this.waiting = undefined;
    this.module.then(
      (module) => {
        if (this.running === job) this.send(module, job.request);
      },
      (error: Error) => this.fail(new Fault(`the program could not be loaded: ${error.message}`)),
    );
  }

  private send(module: WebAssembly.Module, request: Request): void {
    this.worker ??= this.start(module);
    this.clock = window.setTimeout(
      () => this.fail(new Fault(`it took longer than ${this.limit} seconds`)),
      1000 * this.limit,
    );
    this.worker.postMessage(request);
  }

  private start(module: WebAssembly.Module): Worker {
    const worker = new Worker(this.script);
    worker.addEventListener("message", (event: MessageEvent<Outcome>) => {
      if (this.worker === worker) this.receive(event.data);
    });
    worker.addEventListener("error", (event) => {
      if (this.worker === worker) this.fail(new Fault(event.message || "its worker failed"));
    });
    worker.postMessage(module);
    return worker;
  }

  private receive(outcome: Outcome): void {
    if (outcome.fault !== undefined) {
      this.fail(new Fault(outcome.fault));
      return;
    }
    this.finish()?.resolve(outcome);
    this.next();
  }

  private fail(error: Error): void {
    this.worker?.terminate();
    this.worker = undefined;
    this.finish()?.reject(error);
    this.next();
  }

  private finish(): Job | undefined {
    window.clearTimeout(this.clock);
    const job = this.running;
    this.running = undefined;
    return job;
  }
}
