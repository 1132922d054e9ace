// What the panel beside the editor shows: findings, proofs and facts, as elements.
import type { Checked, Fact, Finding, Fix, KnownBlock, Obligation, Proved, Ranges } from "./commands";
import { button, element, plural } from "./dom";

export interface Actions {
  goTo(line: number, column: number): void;
  apply(fix: Fix): void;
  explain(rule: string): void;
  /** A run that the program proposes, by its command line. */
  draw(command: string): void;
}

function place(line: number, column: number, actions: Actions): HTMLElement {
  return button(`line ${line}`, () => actions.goTo(line, column), { class: "link" });
}

function fixButton(fix: Fix, actions: Actions): HTMLElement {
  const review = fix.safety === "safe" ? "" : " (review)";
  return button(`${fix.title}${review}`, () => actions.apply(fix), { class: "fix" });
}

// ---- findings ----

export function findingsView(checked: Checked, actions: Actions): HTMLElement {
  const view = element("div");
  for (const { reason } of checked.skipped) view.append(note(reason));
  for (const { message } of checked.errors) view.append(note(message));
  if (checked.findings.length === 0 && checked.skipped.length + checked.errors.length === 0)
    view.append(element("p", { class: "empty" }, "No findings."));
  const list = element("ul", { class: "list" });
  list.append(...checked.findings.map((finding) => findingItem(finding, actions)));
  view.append(list);
  return view;
}

function findingItem(finding: Finding, actions: Actions): HTMLElement {
  return element(
    "li",
    { class: finding.severity, "data-rule": finding.rule },
    element(
      "p",
      {},
      element("span", { class: "badge" }, finding.severity),
      " ",
      element("span", { class: "message" }, ...withCode(finding.message)),
    ),
    element(
      "p",
      { class: "where" },
      place(finding.line, finding.column, actions),
      " · ",
      button(finding.rule, () => actions.explain(finding.rule), { class: "link", title: "Explain this rule" }),
    ),
    ...finding.flow.map((step) =>
      element("p", { class: "note" }, place(step.line, step.column, actions), ": ", ...withCode(step.message)),
    ),
    ...finding.notes.map(note),
    ...finding.fixes.map((fix) => fixButton(fix, actions)),
  );
}

export function note(text: string): HTMLElement {
  return element("p", { class: "note" }, ...withCode(text));
}

/** Between backticks stands code. */
function withCode(text: string): (Node | string)[] {
  return text.split("`").map((part, index) => (index % 2 === 0 ? part : element("code", {}, part)));
}

// ---- proofs ----

const ORDER = ["refuted", "unknown", "proved", "unreachable"] as const;

export function proofView(proved: Proved, actions: Actions): HTMLElement {
  const obligations = proved.files.flatMap((file) => file.obligations);
  const view = element("div");
  for (const { message } of proved.errors) view.append(note(message));
  for (const { reason } of proved.skipped) view.append(note(reason));
  const counts = ORDER.map((verdict) => [verdict, obligations.filter((each) => each.verdict === verdict)] as const);
  const told = counts.filter(([verdict, all]) => verdict !== "unreachable" || all.length > 0);
  view.append(
    element("p", { class: "summary", id: "verdicts" }, told.map(([verdict, all]) => `${all.length} ${verdict}`).join(" · ")),
  );
  const certified = obligations.filter(({ grade }) => grade === "certified").length;
  if (certified > 0) view.append(note(`${plural(certified, "proof")} verified by the solver-free checker`));
  for (const [, all] of counts)
    if (all.length > 0) {
      const list = element("ul", { class: "list" });
      list.append(...all.map((obligation) => obligationItem(obligation, actions)));
      view.append(list);
    }
  for (const program of proved.files.flatMap((file) => file.programs)) {
    if (program.incomplete !== null) view.append(note(`${program.name}: ${program.incomplete}`));
    for (const each of program.unmodelled) view.append(note(`not modelled, line ${each.line}: ${each.reason}`));
  }
  return view;
}

function obligationItem(obligation: Obligation, actions: Actions): HTMLElement {
  const { witness, guard } = obligation;
  return element(
    "li",
    { class: obligation.verdict, "data-id": obligation.id },
    element(
      "p",
      {},
      element("span", { class: "badge" }, obligation.verdict),
      " ",
      element("span", { class: "message" }, ...withCode(obligation.claim)),
    ),
    element("p", { class: "where" }, place(obligation.line, obligation.column, actions), ` · ${howOf(obligation)}`),
    obligation.reason !== null && note(obligation.reason),
    obligation.bound !== null && note(`bound: ${obligation.bound}`),
    witness !== null && note(witness.call === null ? witness.happened : `${witness.call}: ${witness.happened}`),
    witness !== null && button("Draw this run", () => actions.draw(witness.run), { class: "fix draw" }),
    guard !== null && note(`holds if ${guard.conditions.join(" and ")}`),
    guard?.fix ? fixButton(guard.fix, actions) : undefined,
  );
}

function howOf({ program, grade, method }: Obligation): string {
  return [program, grade, method].filter((part) => part !== null).join(" · ");
}

// ---- facts about a block ----

export function factsView(ranges: Ranges, line: number, variable: string | undefined): HTMLElement | undefined {
  const known = ranges.contexts.flatMap((context) =>
    context.blocks
      .filter((block) => block.line === line)
      .map((block) => ({ rows: rowsOf(block, variable), title: titleOf(context) })),
  );
  const shown = known.filter(({ rows }) => rows.length > 0);
  if (shown.length === 0) return undefined;
  const view = element("div", { class: "facts" });
  for (const { rows, title } of shown.slice(0, 3)) {
    const table = element("table");
    table.append(...rows.map(({ name, text }) => element("tr", {}, element("th", {}, name), element("td", {}, text))));
    view.append(element("p", {}, title), table);
  }
  return view;
}

function titleOf({ start, calls, program, assumesContract }: Ranges["contexts"][number]): string {
  const call = calls.at(-1);
  if (call) return `${program.program}, called in line ${call.line} of ${call.program}: before this block`;
  return `${start.program}, ${assumesContract ? "in the calls that its contract allows" : "for any start"}: before this block`;
}

function rowsOf(block: KnownBlock, variable: string | undefined): Fact[] {
  if (variable !== undefined) {
    const fact = block.variables.find((each) => each.name.toUpperCase() === variable.toUpperCase());
    return fact ? [fact] : [{ name: variable, text: "unchanged since the start, any value" }];
  }
  const modes = block.modes.map(({ name, codes, asAtStart }) => ({
    name,
    text: [...codes, ...(asAtStart ? ["as at start"] : [])].join(" or "),
  }));
  return [...block.variables, ...block.positions, ...modes, ...block.settings];
}
