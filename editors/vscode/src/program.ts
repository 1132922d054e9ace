// Which program is the server: the one that the settings name, the one inside the extension, the one on the PATH; and where
// there is none, the one in WebAssembly, if the extension has that.
import { existsSync } from "node:fs";
import { delimiter, dirname, join } from "node:path";

/** The setting as it is when nobody has changed it. */
export const NAME = "feedhold";

/** Packages for one platform contain the program. */
export function programInside(extension: string, platform: string): string | undefined {
  const path = join(extension, "bin", platform === "win32" ? `${NAME}.exe` : NAME);
  return existsSync(path) ? path : undefined;
}

/** Packages for all other platforms contain the program in WebAssembly, as a script for Node.js. */
export function scriptInside(extension: string): string | undefined {
  const path = join(extension, "bin", `${NAME}.js`);
  return existsSync(path) ? path : undefined;
}

export function chosen(setting: string, inside: string | undefined): string {
  return setting === NAME ? (inside ?? NAME) : setting;
}

/** An environment in which the program is found by its name; Windows writes `Path`. */
export function pathBefore(program: string, environment: NodeJS.ProcessEnv): Record<string, string> {
  const name = Object.keys(environment).find((each) => each.toUpperCase() === "PATH") ?? "PATH";
  return { [name]: [dirname(program), environment[name]].filter(Boolean).join(delimiter) };
}
