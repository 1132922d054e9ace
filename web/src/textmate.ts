// Highlighting by the TextMate grammar of the extension for VS Code (editors/vscode/syntaxes): what this grammar uses of the
// format, on the regular expressions of the browser.
import { StreamLanguage } from "@codemirror/language";

import grammar from "../../editors/vscode/syntaxes/macrob.tmLanguage.json";

interface Rule {
  include?: string;
  name?: string;
  match?: string;
  begin?: string;
  end?: string;
  captures?: Captures;
  beginCaptures?: Captures;
  endCaptures?: Captures;
  patterns?: Rule[];
}
type Captures = Record<string, Rule>;

export interface Token {
  from: number;
  to: number;
  scope: string;
}

const repository = grammar.repository as Record<string, Rule>;
const top: Rule = { patterns: grammar.patterns };
const compiled = new Map<string, RegExp>();

/** `(?i)` is a flag here, and `\G`, the end of the match before, is where a search may only begin. */
export function toRegExp(pattern: string): RegExp {
  const known = compiled.get(pattern);
  if (known) return known;
  const source = pattern.replaceAll("(?i)", "").replace("\\G", "");
  const flags = "d" + (pattern.includes("(?i)") ? "i" : "") + (pattern.includes("\\G") ? "y" : "g");
  const expression = new RegExp(source, flags);
  compiled.set(pattern, expression);
  return expression;
}

/** The rules that can match, with includes in place. */
function* matching(rules: readonly Rule[]): Generator<Rule> {
  for (const rule of rules) {
    const meant = rule.include === undefined ? rule : repository[rule.include.slice(1)];
    if (!meant) continue;
    if (meant.match === undefined && meant.begin === undefined) yield* matching(meant.patterns ?? []);
    else yield meant;
  }
}

interface Found {
  match: RegExpExecArray;
  rule: Rule | undefined; // absent: the end of the open rule
}

function matchAt(pattern: string, line: string, at: number): RegExpExecArray | null {
  const expression = toRegExp(pattern);
  expression.lastIndex = at;
  return expression.exec(line);
}

/** The first match behind `at`; of several at one place that of the first rule, and before all the end. */
function findNext(line: string, at: number, open: Rule): Found | undefined {
  let best: Found | undefined;
  const end = open.end === undefined ? null : matchAt(open.end, line, at);
  if (end) best = { match: end, rule: undefined };
  for (const rule of matching(open.patterns ?? [])) {
    if (best?.match.index === at) break;
    const match = matchAt((rule.match ?? rule.begin)!, line, at);
    if (match && (!best || match.index < best.match.index)) best = { match, rule };
  }
  return best;
}

/** The tokens of a line; `open`, the rules that are open, innermost last, is left as it is behind the line. */
export function tokensOf(line: string, open: Rule[]): Token[] {
  const tokens: Token[] = [];
  let at = 0;
  for (;;) {
    const rule = open.at(-1) ?? top;
    const found = findNext(line, at, rule);
    if (!found) break;
    const { match } = found;
    const next = match.index + match[0].length;
    add(tokens, at, match.index, rule.name);
    if (!found.rule) {
      add(tokens, match.index, next, rule.name);
      addCaptures(tokens, line, match, rule.endCaptures ?? rule.captures);
      open.pop();
    } else {
      add(tokens, match.index, next, found.rule.name ?? rule.name);
      addCaptures(tokens, line, match, found.rule.beginCaptures ?? found.rule.captures);
      if (found.rule.begin !== undefined) open.push(found.rule);
      else if (next === at) break; // an empty match leads nowhere
    }
    if (next >= line.length && !endsHere(line, open)) break;
    at = next;
  }
  add(tokens, at, line.length, open.at(-1)?.name);
  return flat(tokens, line.length);
}

/** The open rule ends with the line: `$`. */
function endsHere(line: string, open: Rule[]): boolean {
  const end = open.at(-1)?.end;
  return end !== undefined && matchAt(end, line, line.length) !== null;
}

function add(tokens: Token[], from: number, to: number, scope: string | undefined): void {
  if (scope !== undefined && from < to) tokens.push({ from, to, scope });
}

function addCaptures(tokens: Token[], line: string, match: RegExpExecArray, captures: Captures = {}): void {
  for (const [group, capture] of Object.entries(captures)) {
    const place = match.indices?.[Number(group)];
    if (!place) continue;
    const [from, to] = place;
    add(tokens, from, to, capture.name);
    if (capture.patterns)
      for (const token of tokensOf(line.slice(from, to), [{ patterns: capture.patterns }]))
        add(tokens, from + token.from, from + token.to, token.scope);
  }
}

/** Without overlaps: the later token covers the earlier one. */
function flat(tokens: Token[], length: number): Token[] {
  const scopes = new Array<string | undefined>(length);
  for (const token of tokens) scopes.fill(token.scope, token.from, token.to);
  const result: Token[] = [];
  scopes.forEach((scope, at) => {
    const last = result.at(-1);
    if (scope === undefined) return;
    if (last && last.to === at && last.scope === scope) last.to = at + 1;
    else result.push({ from: at, to: at + 1, scope });
  });
  return result;
}

/** Names of CodeMirror by the beginnings of scopes; the first that fits. */
const NAMES: [string, string | null][] = [
  ["comment.block.suppression", "meta"],
  ["comment", "comment"],
  ["invalid", "invalid"],
  ["keyword.operator", "operator"],
  ["keyword", "keyword"],
  ["storage", "meta"],
  ["entity.name.label", "labelName"],
  ["entity.name.function", "className"],
  ["entity", "name"],
  ["constant.numeric", "number"],
  ["constant", "atom"],
  ["string", "string"],
  ["support.type", "unit"],
  ["support.variable", "variableName.special"],
  ["support", "variableName.function"],
  ["variable.parameter.address", "propertyName"],
  ["variable", "variableName"],
  ["punctuation.definition.comment", "comment"],
  ["punctuation.definition.string", "string"],
];

function nameFor(scope: string): string | null {
  return NAMES.find(([prefix]) => scope.startsWith(prefix))?.[1] ?? null;
}

interface State {
  open: Rule[];
  tokens: Token[];
}

export const macroLanguage = StreamLanguage.define<State>({
  name: "macrob",
  startState: () => ({ open: [], tokens: [] }),
  copyState: (state) => ({ open: [...state.open], tokens: [...state.tokens] }),
  token(stream, state) {
    if (stream.sol()) state.tokens = tokensOf(stream.string, state.open);
    while (state.tokens[0] && state.tokens[0].to <= stream.pos) state.tokens.shift();
    const [token] = state.tokens;
    if (!token) {
      stream.skipToEnd();
      return null;
    }
    stream.pos = token.from > stream.pos ? token.from : token.to;
    return stream.pos === token.to ? nameFor(token.scope) : null;
  },
  languageData: { commentTokens: { block: { open: "(", close: ")" } } },
});
