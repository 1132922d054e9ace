// The page: an editor, the program in workers, and what it answers.
import {
  commands,
  complaintOf,
  optionsOf,
  optionsOfWitness,
  type Checked,
  type Dialect,
  type Proved,
  type Ranges,
  type Source,
} from "./commands";
import { button, byId, element, plural } from "./dom";
import { Editor } from "./editor";
import type { Outcome, Request } from "./engine";
import { Dropped, Lane } from "./lane";
import { fromBase64, fromFragment, through, toFragment } from "./link";
import { tarOf } from "./tar";
import { factsView, findingsView, note, proofView, type Actions } from "./views";

type Tab = "findings" | "proof" | "drawing";

const PAUSE = 250; // ms without a key before the program is checked
const LONGEST_CHECK = 60;
const LONGEST_PROOF = 1800;

const module = loadProgram();
const script = URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" }));
const checks = new Lane(module, script, LONGEST_CHECK);
const facts = new Lane(module, script, LONGEST_CHECK);
const works = new Lane(module, script, LONGEST_PROOF);
const questions = new Lane(module, script, LONGEST_CHECK); // for what does not belong to the text

const actions: Actions = {
  goTo: (line, column) => editor.goTo(line, column),
  apply: (fix) => editor.apply(fix),
  explain: (rule) => void explainRule(rule),
  draw: (command) => void draw(optionsOfWitness(command), command),
};
const editor = new Editor(byId("editor"), {
  changed,
  explain: (line, variable) => ranges && factsView(ranges, line, variable),
});
const dialects = byId<HTMLSelectElement>("dialect");
const examples = byId<HTMLSelectElement>("example");
const callArguments = byId<HTMLInputElement>("arguments");

let ranges: Ranges | undefined; // of the text as it is
let pause: number | undefined;

async function loadProgram(): Promise<WebAssembly.Module> {
  const packed = fromBase64(byId("program").textContent!.trim());
  const bytes = await through(packed, new DecompressionStream("gzip"));
  return WebAssembly.compile(bytes as Uint8Array<ArrayBuffer>);
}

function source(): Source {
  return { text: editor.text, dialect: dialects.value };
}

// ---- panels ----

function show(tab: Tab): void {
  for (const name of ["findings", "proof", "drawing"] as const) {
    byId(`${name}-tab`).setAttribute("aria-selected", String(name === tab));
    byId(name).hidden = name !== tab;
  }
}

function fill(tab: Tab, ...content: (Node | string)[]): void {
  byId(tab).replaceChildren(...content);
}

function tell(text: string): void {
  byId("status").textContent = text;
}

/** Runs; a fault is reported in the panel.  Absent: there is no answer. */
async function ask(lane: Lane, request: Request, tab: Tab | undefined): Promise<Outcome | undefined> {
  try {
    return await lane.run(request);
  } catch (error) {
    const text = `Feedhold stopped: ${(error as Error).message}. The page has started it anew.`;
    if (!(error instanceof Dropped) && tab) fill(tab, element("p", { class: "fault", role: "alert" }, text));
    return undefined;
  }
}

/** The answer in JSON; a complaint of the program is reported in the panel. */
function read<Answer>(outcome: Outcome, tab: Tab): Answer | undefined {
  if (outcome.output !== "") return JSON.parse(outcome.output) as Answer;
  fill(tab, element("p", { class: "fault", role: "alert" }, complaintOf(outcome)));
  return undefined;
}

// ---- as one types ----

function changed(): void {
  ranges = undefined;
  window.clearTimeout(pause);
  pause = window.setTimeout(() => void check(), PAUSE);
}

async function check(): Promise<void> {
  window.clearTimeout(pause);
  const checkedSource = source();
  const began = performance.now();
  const outcome = await ask(checks, commands.check(checkedSource), "findings");
  const checked = outcome && read<Checked>(outcome, "findings");
  if (!checked || editor.text !== checkedSource.text) return;
  fill("findings", findingsView(checked, actions));
  editor.show(checked.findings);
  byId("findings-tab").textContent = `Findings (${checked.findings.length})`;
  const dialect = checked.files[0]?.dialect;
  byId("detected").textContent = dialect === undefined ? "Detect" : `Detect: ${dialect}`;
  tell(`${plural(checked.findings.length, "finding")}, ${Math.round(performance.now() - began)} ms`);
  document.body.dataset.checked = String(Number(document.body.dataset.checked ?? 0) + 1);
  await findRanges(checkedSource);
}

async function findRanges(asked: Source): Promise<void> {
  const outcome = await ask(facts, commands.ranges(asked), undefined);
  if (!outcome || outcome.output === "" || editor.text !== asked.text) return;
  ranges = JSON.parse(outcome.output) as Ranges;
  document.body.dataset.ranges = "ready";
}

// ---- on demand ----

async function working<Result>(text: string, work: () => Promise<Result>): Promise<Result> {
  tell(text);
  byId("stop").hidden = false;
  try {
    return await work();
  } finally {
    byId("stop").hidden = true;
    tell("");
  }
}

async function prove(): Promise<void> {
  show("proof");
  fill("proof", element("p", { class: "empty" }, "Proving ..."));
  const asked = source();
  await working("Proving ...", async () => {
    const outcome = await ask(works, commands.prove(asked), "proof");
    const proved = outcome && read<Proved>(outcome, "proof");
    if (!proved) return;
    const certificates = element("p", { id: "certificates" }, button("Write certificates", () => void certify(asked)));
    fill("proof", certificates, proofView(proved, actions));
  });
}

/** Writes certificates, and has them verified in another run, by the checker that has no solver. */
async function certify(asked: Source): Promise<void> {
  const told = byId("certificates");
  await working("Writing certificates ...", async () => {
    told.textContent = "Proving in exact arithmetic ...";
    const outcome = await ask(works, commands.certify(asked), "proof");
    if (!outcome) return;
    const count = Object.keys(outcome.files).filter((name) => name.endsWith(".certificate")).length;
    told.textContent = count === 0 ? "No proof has a certificate." : "Verifying the certificates ...";
    if (count === 0) return;
    const checked = await ask(works, commands.recheck(asked, outcome.files), "proof");
    if (!checked) return;
    const result = checked.code === 0
      ? `${plural(count, "certificate")} in exact arithmetic, verified by the solver-free checker. `
      : `The certificates were not verified: ${checked.output.trim() || complaintOf(checked)} `;
    told.replaceChildren(result, button("Save", () => save("evidence.tar", tarOf(outcome.files)), { class: "fix" }));
  });
}

function save(name: string, content: Blob): void {
  const link = element("a", { href: URL.createObjectURL(content), download: name });
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

async function draw(options: string[], title: string): Promise<void> {
  show("drawing");
  fill("drawing", element("p", { class: "empty" }, "Running ..."));
  const asked = source();
  await working("Running ...", async () => {
    const drawn = await ask(works, commands.plot(asked, options), "drawing");
    if (!drawn) return;
    if (drawn.output === "") {
      fill("drawing", element("p", { class: "fault", role: "alert" }, complaintOf(drawn)));
      return;
    }
    const holder = element("div", { class: "picture" });
    holder.attachShadow({ mode: "open" }).innerHTML = `<style>svg { max-width: 100%; height: auto }</style>${drawn.output}`;
    const notes = drawn.errors.split("\n").filter((line) => line !== "").map(note);
    fill("drawing", element("p", { class: "where" }, title), ...notes, holder);
    const listed = await ask(works, commands.run(asked, options), undefined);
    if (listed) byId("drawing").append(details("Movements, variables and the end", listed.output + listed.errors));
  });
}

function details(title: string, text: string): HTMLElement {
  return element("details", {}, element("summary", {}, title), element("pre", {}, text));
}

async function explainRule(rule: string): Promise<void> {
  const outcome = await ask(questions, commands.explain(rule), undefined);
  if (!outcome) return;
  byId("explanation-text").textContent = outcome.output;
  byId<HTMLDialogElement>("explanation").showModal();
}

// ---- programs from elsewhere ----

function open(text: string, dialect: string, runArguments: string, purpose: string): void {
  works.stop();
  dialects.value = dialect;
  callArguments.value = runArguments;
  editor.text = text;
  byId("purpose").textContent = purpose;
  fill("proof", element("p", { class: "empty" }, "“Prove” proves the program for all inputs that its contract allows."));
  fill("drawing", element("p", { class: "empty" }, "“Run” executes the program and draws its tool path."));
  show("findings");
}

async function openExample(name: string): Promise<void> {
  const example = EXAMPLES.find((each) => each.file === name);
  if (!example) return;
  open(example.text, example.dialect, example.arguments, example.purpose);
  await check();
  if (example.show === "prove") await prove();
  if (example.show === "run") await draw(optionsOf(example.arguments), example.title);
}

async function openFragment(): Promise<boolean> {
  const shared = await fromFragment(location.hash);
  if (!shared) return false;
  examples.value = "";
  open(shared.text, shared.dialect, shared.arguments, "");
  void check();
  return true;
}

async function copyLink(): Promise<void> {
  const fragment = await toFragment({ dialect: dialects.value, arguments: callArguments.value, text: editor.text });
  history.replaceState(null, "", fragment);
  try {
    await navigator.clipboard.writeText(location.href);
    tell("The link is in the clipboard.");
  } catch {
    tell("The link is in the address bar.");
  }
}

// ---- the beginning ----

async function listDialects(): Promise<void> {
  const outcome = await ask(questions, commands.dialects(), undefined);
  if (!outcome) return;
  const chosen = dialects.value;
  for (const { id, title } of JSON.parse(outcome.output) as Dialect[])
    if (!dialects.querySelector(`option[value="${id}"]`)) dialects.append(element("option", { value: id }, `${id}: ${title}`));
  dialects.value = chosen;
  const version = await ask(questions, commands.version(), undefined);
  if (version) byId("version").textContent = version.output.trim().replace(/^f/, "F");
}

async function begin(): Promise<void> {
  for (const each of EXAMPLES) {
    examples.append(element("option", { value: each.file }, each.title));
    if (each.dialect !== "" && !dialects.querySelector(`option[value="${each.dialect}"]`))
      dialects.append(element("option", { value: each.dialect }, each.dialect));
  }
  for (const tab of ["findings", "proof", "drawing"] as const) byId(`${tab}-tab`).addEventListener("click", () => show(tab));
  byId("prove").addEventListener("click", () => void prove());
  byId("run").addEventListener("click", () => void draw(optionsOf(callArguments.value), `Run with ${callArguments.value || "no arguments"}`));
  byId("stop").addEventListener("click", () => works.stop());
  byId("link").addEventListener("click", () => void copyLink());
  byId("close").addEventListener("click", () => byId<HTMLDialogElement>("explanation").close());
  examples.addEventListener("change", () => void openExample(examples.value));
  dialects.addEventListener("change", () => changed());
  window.addEventListener("hashchange", () => void openFragment());
  if (!(await openFragment())) {
    const [first] = EXAMPLES;
    examples.value = first!.file;
    open(first!.text, first!.dialect, first!.arguments, first!.purpose);
    void check();
  }
  void listDialects();
}

void begin();
