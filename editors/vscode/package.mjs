// Makes build/feedhold-VERSION.vsix: one bundle, the licences of what is in it, and the same bytes from the same tree.
// `package.mjs TARGET PROGRAM OUT` makes OUT/feedhold-TARGET-VERSION.vsix for one platform, with the files of the folder
// PROGRAM inside.
import { execFileSync } from "node:child_process";
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { createVSIX } from "@vscode/vsce";
import { build } from "esbuild";

import { notices } from "../../packaging/notices.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../..");
process.chdir(here);

const bundled = await build({
  entryPoints: ["src/extension.ts"],
  outfile: "dist/extension.js",
  bundle: true,
  minify: true,
  platform: "node",
  format: "cjs",
  target: "node18", // that of VS Code 1.82, the oldest one
  external: ["vscode"],
  legalComments: "none", // THIRD-PARTY.txt has the whole texts
  metafile: true,
});
writeFileSync("THIRD-PARTY.txt", notices(Object.keys(bundled.metafile.inputs)));
copyFileSync(join(root, "LICENSE"), "LICENSE");

// vsce puts this time on every entry of the archive.
process.env.SOURCE_DATE_EPOCH ??= timeOfLastCommit();
const { name, version } = JSON.parse(readFileSync("package.json", "utf8"));
const [target, program, out = join(root, "build")] = process.argv.slice(2);
mkdirSync(out, { recursive: true });
rmSync("bin", { recursive: true, force: true });
if (program) cpSync(program, "bin", { recursive: true });
const packagePath = join(out, `${[name, target, version].filter(Boolean).join("-")}.vsix`);
await createVSIX({ cwd: here, target, packagePath, dependencies: false });
rmSync("bin", { recursive: true, force: true });

/** 1980 is the first year that an archive can name: for trees without history. */
function timeOfLastCommit() {
  if (!existsSync(join(root, ".git"))) return "315532800";
  return execFileSync("git", ["-C", root, "log", "-1", "--format=%ct"], { encoding: "utf8" }).trim();
}
