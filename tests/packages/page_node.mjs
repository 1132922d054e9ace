// The program of the page under Node.js: `page_node.mjs WEB PROGRAM`, with the sources of the page and the program of the
// preset `wasm`.  Standard input is a list of requests {words, folder, collect}, standard output the list of outcomes.
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [web, program] = process.argv.slice(2);
globalThis.self = { location: { href: "" } }; // the program is built for workers

const { create, run } = await load();
const module = await WebAssembly.compile(readFileSync(join(program, "feedhold.wasm")));
const outcomes = [];
for (const { words, folder, collect } of JSON.parse(readFileSync(0, "utf8"))) {
  const began = performance.now();
  const outcome = await run(create, module, { words, files: filesBelow(folder, ""), ...(collect ? { collect } : {}) });
  const files = Object.entries(outcome.files).map(([name, bytes]) => [name, Buffer.from(bytes).toString("latin1")]);
  outcomes.push({ ...outcome, files: Object.fromEntries(files), ms: performance.now() - began });
}
process.stdout.write(JSON.stringify(outcomes));

/** As the worker of the page has them. */
async function load() {
  const { build } = createRequire(join(web, "package.json"))("esbuild");
  const holder = mkdtempSync(join(tmpdir(), "feedhold-page-"));
  const outfile = join(holder, "engine.mjs");
  const contents = `export { default as create } from "feedhold-program"; export { run } from "./src/engine";`;
  await build({
    stdin: { contents, resolveDir: web, loader: "ts" },
    bundle: true, format: "esm", target: "es2022", outfile, alias: { "feedhold-program": join(program, "feedhold.mjs") },
  });
  const loaded = await import(pathToFileURL(outfile));
  rmSync(holder, { recursive: true });
  return loaded;
}

function filesBelow(folder, name) {
  if (!folder) return {};
  const files = {};
  for (const entry of readdirSync(folder).sort()) {
    const path = join(folder, entry);
    if (statSync(path).isDirectory()) Object.assign(files, filesBelow(path, `${name}${entry}/`));
    else files[`${name}${entry}`] = new Uint8Array(readFileSync(path));
  }
  return files;
}
