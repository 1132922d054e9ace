// Colours files as VS Code would: one JSON line for each file, a list of [begin, end, scopes].  Bytes are characters.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const extension = join(import.meta.dirname, "../../editors/vscode/");
const require = createRequire(extension);
const { OnigScanner, OnigString, loadWASM } = require("vscode-oniguruma");
const { INITIAL, Registry, parseRawGrammar } = require("vscode-textmate");

await loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")));
const { grammars } = JSON.parse(readFileSync(join(extension, "package.json"))).contributes;
const registry = new Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new OnigScanner(patterns),
    createOnigString: (text) => new OnigString(text),
  }),
  loadGrammar: async (scope) => {
    const path = join(extension, grammars.find(({ scopeName }) => scopeName === scope).path);
    return parseRawGrammar(readFileSync(path, "utf8"), path);
  },
});

const [scope, ...files] = process.argv.slice(2);
const grammar = await registry.loadGrammar(scope);
for (const file of files) console.log(JSON.stringify(tokensOf(readFileSync(file, "latin1"))));

function tokensOf(text) {
  const tokens = [];
  let stack = INITIAL;
  let start = 0;
  for (const line of text.split("\n")) {
    const result = grammar.tokenizeLine(line, stack);
    stack = result.ruleStack;
    for (const { startIndex, endIndex, scopes } of result.tokens)
      tokens.push([start + startIndex, start + endIndex, scopes.slice(1)]);
    start += line.length + 1;
  }
  return tokens;
}
