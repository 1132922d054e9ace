// The editor: highlighting, findings under the text, and what is known of a block when the pointer rests on it.
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { EditorState, type Text } from "@codemirror/state";
import {
  drawSelection,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  hoverTooltip,
  keymap,
  lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";

import type { Finding, Fix, Place } from "./commands";
import { macroLanguage } from "./textmate";

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--comment)" },
  { tag: [tags.keyword, tags.unit], color: "var(--keyword)" },
  { tag: [tags.operator, tags.punctuation], color: "var(--operator)" },
  { tag: [tags.number, tags.atom], color: "var(--number)" },
  { tag: tags.string, color: "var(--string)" },
  { tag: [tags.className, tags.labelName], color: "var(--name)", fontWeight: "600" },
  { tag: [tags.variableName, tags.special(tags.variableName)], color: "var(--variable)" },
  { tag: tags.function(tags.variableName), color: "var(--function)" },
  { tag: tags.propertyName, color: "var(--address)" },
  { tag: tags.meta, color: "var(--contract)" },
  { tag: tags.invalid, color: "var(--error)" },
]);

export interface EditorEvents {
  changed(): void;
  /** What to show for a place: its line from 1, and the variable there, if there is one. */
  explain(line: number, variable: string | undefined): HTMLElement | undefined;
}

export class Editor {
  private readonly view: EditorView;

  constructor(parent: HTMLElement, events: EditorEvents) {
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        extensions: [
          lineNumbers(),
          lintGutter(),
          history(),
          drawSelection(),
          highlightActiveLine(),
          highlightActiveLineGutter(),
          macroLanguage,
          syntaxHighlighting(colours),
          keymap.of([...defaultKeymap, ...historyKeymap, ...lintKeymap, indentWithTab]),
          EditorView.updateListener.of((update) => update.docChanged && events.changed()),
          EditorView.contentAttributes.of({ "aria-label": "Program", spellcheck: "false" }),
          hoverTooltip((view, at) => tooltip(view, at, events)),
        ],
      }),
    });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }
  set text(text: string) {
    this.view.dispatch({
      changes: { from: 0, to: this.view.state.doc.length, insert: text },
      selection: { anchor: 0 },
      scrollIntoView: true,
    });
  }

  show(findings: Finding[]): void {
    const { doc } = this.view.state;
    const diagnostics = findings.map((finding): Diagnostic => {
      const { from, to } = spanOf(doc, finding);
      const actions = finding.fixes.map((fix) => ({ name: fix.title, apply: () => this.apply(fix) }));
      return { from, to, severity: finding.severity, source: finding.rule, message: finding.message, actions };
    });
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }

  apply(fix: Fix): void {
    const { doc } = this.view.state;
    this.view.dispatch({ changes: fix.edits.map((edit) => ({ ...spanOf(doc, edit), insert: edit.replacement })) });
    this.view.focus();
  }

  goTo(line: number, column: number): void {
    const anchor = offsetOf(this.view.state.doc, line, column);
    this.view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
    this.view.focus();
  }
}

/** Columns count characters, positions of the editor units of UTF-16. */
function offsetOf(doc: Text, line: number, column: number): number {
  const { from, text } = doc.line(Math.min(Math.max(line, 1), doc.lines));
  return from + [...text].slice(0, column - 1).join("").length;
}

function spanOf(doc: Text, place: Place): { from: number; to: number } {
  return { from: offsetOf(doc, place.line, place.column), to: offsetOf(doc, place.endLine, place.endColumn) };
}

function tooltip(view: EditorView, at: number, events: EditorEvents) {
  const line = view.state.doc.lineAt(at);
  const column = at - line.from;
  const variables = [...line.text.matchAll(/#\s*(\d+|<[^>]*>)/g)];
  const under = variables.find(({ index, 0: { length } }) => index <= column && column <= index + length);
  const dom = events.explain(line.number, under?.[0].replaceAll(/\s/g, ""));
  if (!dom) return null;
  const from = under ? line.from + under.index : line.from;
  return { pos: from, end: under ? from + under[0].length : line.to, above: true, create: () => ({ dom }) };
}
