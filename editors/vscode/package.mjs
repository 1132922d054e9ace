// Makes build/feedhold-VERSION.vsix: one bundle, the licences of what is in it, and the same bytes from the same tree.
// `package.mjs TARGET PROGRAM OUT` makes OUT/feedhold-TARGET-VERSION.vsix for one platform, with the files of the folder
// PROGRAM inside.  Of the TARGET `universal` it is OUT/feedhold-VERSION.vsix, for all others, and the program is that of the
// preset `wasm` for Node.js (feedhold-node.js and feedhold-node.wasm).
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { createVSIX } from "@vscode/vsce";
import { build } from "esbuild";

import { notices } from "../../packaging/notices.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../..");
process.chdir(here);

const bundled = await bundle("src/extension.ts", "dist/extension.js", { external: ["vscode"] });
writeFileSync("THIRD-PARTY.txt", notices(Object.keys(bundled.metafile.inputs)));
copyFileSync(join(root, "LICENSE"), "LICENSE");

// vsce puts this time on every entry of the archive.
process.env.SOURCE_DATE_EPOCH ??= timeOfLastCommit();
const { name, version } = JSON.parse(readFileSync("package.json", "utf8"));
const [platform, program, out = join(root, "build")] = process.argv.slice(2);
const target = platform === "universal" ? undefined : platform;
mkdirSync(out, { recursive: true });
rmSync("bin", { recursive: true, force: true });
if (program) cpSync(program, "bin", { recursive: true });
if (platform === "universal") await bundleServer();
const packagePath = join(out, `${[name, target, version].filter(Boolean).join("-")}.vsix`);
await createVSIX({ cwd: here, target, packagePath, dependencies: false });
rmSync("bin", { recursive: true, force: true });

function bundle(entry, outfile, more) {
  return build({
    entryPoints: [entry],
    outfile,
    bundle: true,
    minify: true,
    platform: "node",
    format: "cjs",
    target: "node18", // that of VS Code 1.82, the oldest one
    legalComments: "none", // THIRD-PARTY.txt has the whole texts
    metafile: true,
    ...more,
  });
}

/** In place of the two files of emscripten: bin/feedhold.js and, beside it, bin/feedhold.wasm. */
async function bundleServer() {
  renameSync("bin/feedhold-node.wasm", "bin/feedhold.wasm");
  const id = createHash("sha256").update(readFileSync("bin/feedhold.wasm")).digest("hex");
  await bundle("src/server.ts", "bin/feedhold.js", {
    alias: { "feedhold-program": join(here, "bin/feedhold-node.js") },
    define: { BUILD_ID: JSON.stringify(id) },
  });
  rmSync("bin/feedhold-node.js");
}

/** 1980 is the first year that an archive can name: for trees without history. */
function timeOfLastCommit() {
  if (!existsSync(join(root, ".git"))) return "315532800";
  return execFileSync("git", ["-C", root, "log", "-1", "--format=%ct"], { encoding: "utf8" }).trim();
}
