// Makes the page: `build.mjs PROGRAM OUT` puts the program of the preset `wasm` (the folder PROGRAM has feedhold.mjs and
// feedhold.wasm), the scripts, the styles and the examples into OUT/index.html, and the notices of the npm packages in it
// beside it.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

import { build } from "esbuild";

import { notices } from "../packaging/notices.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const [program, out] = process.argv.slice(2).map((path) => resolve(path));
process.chdir(here);

const worker = await bundle("src/worker.ts", {});
const page = await bundle("src/main.ts", { WORKER: JSON.stringify(worker.text), EXAMPLES: JSON.stringify(examples()) });
const script = page.text.replaceAll("</script", "<\\/script");
const parts = {
  POLICY: policy(script),
  STYLE: readFileSync("style.css", "utf8"),
  PROGRAM: gzipSync(readFileSync(join(program, "feedhold.wasm")), { level: 9 }).toString("base64"),
  SCRIPT: script,
};
const html = readFileSync("index.html", "utf8").replaceAll(/\b(POLICY|STYLE|PROGRAM|SCRIPT)\b/g, (name) => parts[name]);
mkdirSync(out, { recursive: true });
writeFileSync(join(out, "index.html"), html);
writeFileSync(join(out, "THIRD-PARTY-NPM.txt"), notices([...worker.inputs, ...page.inputs]));

async function bundle(entry, define) {
  const made = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    alias: { "feedhold-program": join(program, "feedhold.mjs") },
    define,
    legalComments: "none", // the notices have the whole texts
    metafile: true,
  });
  return { text: made.outputFiles[0].text, inputs: Object.keys(made.metafile.inputs) };
}

function examples() {
  const described = JSON.parse(readFileSync("examples/examples.json", "utf8"));
  return described.map(({ expect, ...shown }) => ({ ...shown, text: readFileSync(join("examples", shown.file), "utf8") }));
}

/** What the browser lets the page do: run its own script and the program inside, and ask nobody for anything. */
function policy(text) {
  const hash = createHash("sha256").update(text).digest("base64");
  return [
    "default-src 'none'",
    `script-src 'sha256-${hash}' 'wasm-unsafe-eval' blob:`,
    "worker-src blob:",
    "style-src 'unsafe-inline'",
    "img-src data:",
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
}
