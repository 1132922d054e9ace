// The commands of the page: words of the command line, and what the program answers (docs/schemas).
import type { Outcome, Request } from "./engine";

export interface Source {
  text: string;
  dialect: string; // empty: detected
}

/** The name of the file is that of its first program, as in a shop: it appears in calls that can be run again. */
export function fileOf(text: string): string {
  const number = /^\s*[O:]\s*(\d{1,8})/im.exec(text)?.[1];
  return number === undefined ? "program.nc" : `O${number}.nc`;
}

function request(source: Source, command: string, options: string[], collect?: string): Request {
  const file = fileOf(source.text);
  const isSaid = source.dialect === "" || options.includes("--dialect"); // as witnesses do
  const dialect = isSaid ? [] : ["--dialect", source.dialect];
  const words = [command, ...dialect, ...options, file];
  return { words, files: { [file]: source.text }, ...(collect === undefined ? {} : { collect }) };
}

export const EVIDENCE = "evidence";

export const commands = {
  check: (source: Source) => request(source, "check", ["--format", "json"]),
  ranges: (source: Source) => request(source, "ranges", ["--format", "json"]),
  prove: (source: Source) => request(source, "prove", ["--format", "json"]),
  /** In exact arithmetic, as all evidence. */
  certify: (source: Source) => request(source, "prove", ["--format", "json", "--certificate", EVIDENCE], EVIDENCE),
  plot: (source: Source, options: string[]) => request(source, "plot", options),
  run: (source: Source, options: string[]) => request(source, "run", options),
  explain: (rule: string): Request => ({ words: ["explain", rule], files: {} }),
  dialects: (): Request => ({ words: ["dialects", "--format", "json"], files: {} }),
  version: (): Request => ({ words: ["--version"], files: {} }),
  /** The evidence once more, by the checker alone, with the program that it is about. */
  recheck: (source: Source, evidence: Record<string, Uint8Array>): Request => {
    const files = Object.entries(evidence).map(([path, content]) => [`${EVIDENCE}/${path}`, content] as const);
    return {
      words: ["recheck", "--solvers", "needed", EVIDENCE],
      files: { ...Object.fromEntries(files), [fileOf(source.text)]: source.text },
    };
  },
};

/** Words as a shell takes them apart, as far as the program quotes its own command lines. */
export function wordsOf(line: string): string[] {
  const words = line.match(/(?:"[^"]*"|'[^']*'|[^\s"'])+/g) ?? [];
  return words.map((word) => word.replaceAll(/"([^"]*)"|'([^']*)'/g, "$1$2"));
}

/** `X=0 R6.5 #500=3` for a run: letters are arguments of the call, numbers variables. */
export function optionsOf(line: string): string[] {
  return wordsOf(line).flatMap((word) => {
    if (word.startsWith("#")) return ["--var", word.slice(1)];
    const argument = /^([A-Za-z])=?([-+.\d]+)$/.exec(word);
    return argument ? ["--arg", `${argument[1]!.toUpperCase()}=${argument[2]}`] : ["--arg", word];
  });
}

/** Of `feedhold run FILE OPTIONS..`, as witnesses name it, the options. */
export function optionsOfWitness(command: string): string[] {
  return wordsOf(command).slice(3);
}

/** What the program says went wrong: the text behind `error: `. */
export function complaintOf(outcome: Outcome): string {
  return outcome.errors.trim().replace(/^(feedhold: )?error: /, "") || "the command could not run";
}

// ---- what is read of the answers ----

export interface Place {
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
}
export interface Fix {
  title: string;
  safety: "safe" | "needs-review";
  edits: (Place & { replacement: string })[];
}
export interface Finding extends Place {
  rule: string;
  severity: "error" | "warning" | "info";
  message: string;
  flow: (Place & { message: string })[];
  notes: string[];
  fixes: Fix[];
}
export interface Checked {
  findings: Finding[];
  files: { dialect: string; chosenBy: string; reasons: string[] }[];
  skipped: { reason: string }[];
  errors: { message: string }[];
}

export interface Witness {
  call: string | null;
  run: string;
  happened: string;
}
export interface Obligation {
  id: string;
  program: string;
  line: number;
  column: number;
  claim: string;
  verdict: "proved" | "refuted" | "unknown" | "unreachable";
  grade: string | null;
  method: string | null;
  reason: string | null;
  bound: string | null;
  witness: Witness | null;
  guard: { conditions: string[]; clause: string; fix: Fix | null } | null;
}
export interface Proved {
  files: {
    programs: { name: string; incomplete: string | null; unmodelled: { reason: string; line: number }[] }[];
    obligations: Obligation[];
  }[];
  skipped: { reason: string }[];
  errors: { message: string }[];
}

export interface Fact {
  name: string;
  text: string;
}
export interface KnownBlock {
  line: number;
  variables: Fact[];
  positions: Fact[];
  modes: { name: string; codes: string[]; asAtStart: boolean }[];
  settings: Fact[];
}
export interface Ranges {
  contexts: {
    start: { program: string };
    calls: { program: string; line: number }[];
    assumesContract: boolean;
    program: { program: string };
    blocks: KnownBlock[];
  }[];
}

export interface Dialect {
  id: string;
  title: string;
}
