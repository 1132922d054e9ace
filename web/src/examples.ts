// The examples of the page; examples/examples.json describes them, and build.mjs adds their texts.

export interface Example {
  file: string;
  title: string;
  purpose: string; // one line, shown above the program
  dialect: string;
  show: "check" | "prove" | "run";
  arguments: string; // of a run
  text: string;
}
