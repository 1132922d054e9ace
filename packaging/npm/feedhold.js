#!/usr/bin/env node
// Starts the program of the package for this platform, with the same arguments, streams and exit code.
"use strict";
const { spawn } = require("child_process");

const platform = `${process.platform}-${process.arch}`;

function program() {
  try {
    return require.resolve(`@feedhold/${platform}/bin/feedhold${process.platform === "win32" ? ".exe" : ""}`);
  } catch {
    console.error(`feedhold: error: the package @feedhold/${platform} is not installed: ` +
                  "npm was told to leave out optional packages, or there is none for this platform");
    process.exit(2);
  }
}

const child = spawn(program(), process.argv.slice(2), { stdio: "inherit" });
for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"]) process.on(signal, () => child.kill(signal));
child.on("error", (problem) => {
  console.error(`feedhold: error: ${problem.message}`);
  process.exit(2);
});
child.on("exit", (code, signal) => process.exit(signal ? 2 : code));
