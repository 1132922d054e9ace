// The worker of the page: the compiled program comes first, then requests, one after the other.
import create from "feedhold-program";

import { run, type Request } from "./engine";

let module: WebAssembly.Module | undefined;

self.onmessage = async (event: MessageEvent<WebAssembly.Module | Request>) => {
  if (event.data instanceof WebAssembly.Module) module = event.data;
  else if (module) self.postMessage(await run(create, module, event.data));
};
