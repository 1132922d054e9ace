// One session in VS Code's real workbench, in a browser: node workbench.mjs PACKAGES VSIX FOLDER; what is seen is printed.
import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { join } from "node:path";

const LONGEST_WAIT = 40_000;
const [packages, vsix, folder] = process.argv.slice(2);
const { chromium } = createRequire(join(packages, "node_modules/"))("playwright-core");
const programs = join(folder, "programs");
const places = ["--user-data-dir", join(folder, "user"), "--extensions-dir", join(folder, "extensions")];
const entry = join(packages, "node_modules/code-server/out/node/entry.js");

writeSettings("User", {
  "chat.disableAIFeatures": true,
  "editor.minimap.enabled": false,
  "terminal.integrated.gpuAcceleration": "off", // rows are text then
  "workbench.secondarySideBar.defaultVisibility": "hidden",
  "workbench.startupEditor": "none",
});
writeSettings("Machine", { "feedhold.path": "/nowhere/feedhold" }); // of the machine where the server runs
const installed = spawnSync(process.execPath, [entry, ...places, "--install-extension", vsix], { encoding: "utf8" });
if (installed.status !== 0) throw new Error(installed.stdout + installed.stderr);

const port = await freePort();
const quiet = ["--auth", "none", "--disable-telemetry", "--disable-update-check", "--disable-workspace-trust"];
const server = spawn(process.execPath, [entry, ...quiet, "--bind-addr", `127.0.0.1:${port}`, ...places, programs]);
await new Promise((resolve) => server.stdout.on("data", (text) => `${text}`.includes("HTTP server listening") && resolve()));
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 1200 } });
page.setDefaultTimeout(LONGEST_WAIT);
try {
  console.log(JSON.stringify(await session()));
} finally {
  await page.screenshot({ path: join(folder, "workbench.png") });
  await browser.close();
  server.kill();
}

async function session() {
  const seen = {};
  const file = `vscode-remote://127.0.0.1:${port}${programs}/O1000.nc`;
  const payload = JSON.stringify([["gotoLineMode", "true"], ["openFile", `${file}:3:1`]]);
  await page.goto(`http://127.0.0.1:${port}/?folder=${programs}&payload=${encodeURIComponent(payload)}`);
  seen.missing = await page.locator(".notification-list-item-message").first().innerText();
  seen.swatchesBefore = await swatches();
  await page.locator(".notification-list-item").first().hover();
  await page.locator(".notification-list-item .codicon-notifications-clear").first().click();
  writeSettings("Machine", { "feedhold.path": process.env.FEEDHOLD }); // the extension starts anew by itself
  await page.locator(".squiggly-error").first().waitFor({ state: "attached" });
  seen.language = await page.locator("#status\\.editor\\.mode").innerText();

  await page.keyboard.press("Control+Shift+M");
  await page.locator(".markers-panel .monaco-list-row", { hasText: "loop-without-progress" }).first().waitFor();
  seen.problems = await page.locator(".markers-panel .monaco-list-row").allInnerTexts();
  seen.links = await page.locator(".markers-panel a.monaco-link").evaluateAll((all) => all.map((it) => it.href));
  seen.swatches = await swatches();

  await page.mouse.move(...(await placeOf("#101", "#100")));
  seen.hover = await page.locator(".monaco-hover:visible", { hasText: "variable" }).first().innerText();
  await page.mouse.move(700, 450); // what hovers covers the lines above
  await page.locator(".monaco-hover:visible").first().waitFor({ state: "hidden" });

  await page.mouse.click(...(await placeOf("g01", "g01")));
  await page.locator("#status\\.editor\\.selection", { hasText: "Ln 7," }).waitFor();
  await page.keyboard.press("Control+.");
  await page.locator(".action-widget .monaco-list-row", { hasText: "upper case" }).first().click();
  await page.locator(".view-line", { hasText: "G01" }).waitFor();
  await page.locator(".markers-panel .monaco-list-row", { hasText: "lower-case" }).first().waitFor({ state: "detached" });
  await page.keyboard.press("Control+S");
  await page.waitForTimeout(500); // saving has no end that could be seen
  seen.repaired = readFileSync(join(programs, "O1000.nc"), "utf8");

  await page.locator(".explorer-folders-view .monaco-list-row", { hasText: "O9020.nc" }).dblclick();
  const lens = page.locator(".codelens-decoration a", { hasText: "refuted" });
  seen.lens = await lens.innerText();
  await lens.click();
  await page.locator(".xterm-rows", { hasText: "#510" }).first().waitFor();
  seen.terminal = await page.locator(".xterm-rows").first().innerText();
  return seen;
}

/** Editors take `#500` for a colour if they may. */
function swatches() {
  return page.locator(".colorpicker-color-decoration").count();
}

/** Where a word of the program begins on the screen. */
async function placeOf(line, word) {
  const words = page.locator(".view-line", { hasText: line }).locator("span span").filter({ hasText: word });
  for (let tries = 0; tries < 100; ++tries) {
    const box = await words.first().boundingBox(); // null while lines are drawn anew
    if (box) return [box.x + 4, box.y + box.height / 2];
    await page.waitForTimeout(100);
  }
  throw new Error(`${word} is not on the screen`);
}

function writeSettings(of, settings) {
  mkdirSync(join(folder, "user", of), { recursive: true });
  writeFileSync(join(folder, "user", of, "settings.json"), JSON.stringify(settings));
}

function freePort() {
  return new Promise((resolve) => {
    const probe = createServer();
    probe.listen(0, "127.0.0.1", () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });
}
