// The style of a certificate's page: light and dark as the reader has it, light on paper.  Internal to sink/.
#pragma once

#include <string_view>

namespace feedhold::certificate {

inline constexpr std::string_view kPageStyle = R"(:root { color-scheme: light;
  --paper: #ffffff; --ink: #1f2328; --faint: #59636e; --line: #d1d9e0; --soft: #f6f8fa; --link: #0a58ca;
  --proved: #1a7f37; --proved-soft: #e6f4ea; --refuted: #b3161c; --refuted-soft: #fdecec;
  --unknown: #8a5a00; --unknown-soft: #fff4dc; --unreachable: #59636e; --unreachable-soft: #eef1f4; }
@media screen and (prefers-color-scheme: dark) { :root { color-scheme: dark;
  --paper: #0d1117; --ink: #e6edf3; --faint: #9198a1; --line: #30363d; --soft: #161b22; --link: #58a6ff;
  --proved: #3fb950; --proved-soft: #12261a; --refuted: #ff7b72; --refuted-soft: #2d1517;
  --unknown: #e3b341; --unknown-soft: #2a2213; --unreachable: #9198a1; --unreachable-soft: #1c2128; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1040px; margin: 0 auto; padding: 40px 32px 80px; }
h1 { font-size: 34px; line-height: 1.15; margin: 0 0 8px; letter-spacing: -0.01em; }
h2 { font-size: 22px; line-height: 1.25; margin: 0 0 8px; }
h2 small { font-size: 15px; font-weight: 400; color: var(--faint); margin-left: 8px; }
h3 { font-size: 16px; margin: 28px 0 8px; }
p { margin: 0 0 8px; }
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
small { font-size: 12.5px; color: var(--faint); }
code, pre, .hash, .id { font-family: ui-monospace, "SF Mono", Consolas, "DejaVu Sans Mono", monospace; }
code { font-size: 0.88em; background: var(--soft); border-radius: 4px; padding: 1px 4px; overflow-wrap: anywhere; }
pre { font-size: 12.5px; background: var(--soft); border: 1px solid var(--line); border-radius: 6px;
  padding: 8px 12px; margin: 8px 0 0; white-space: pre-wrap; overflow-wrap: anywhere; }
section { margin-top: 40px; }
header { border-bottom: 2px solid var(--ink); padding-bottom: 16px; }
.kind { font-size: 13px; text-transform: uppercase; letter-spacing: 0.12em; color: var(--faint); margin: 0 0 4px; }
.meta { color: var(--faint); font-size: 13.5px; margin: 0 0 2px; }
.hash { font-size: 11.5px; overflow-wrap: anywhere; }
.id { font-size: 11.5px; overflow-wrap: anywhere; }
.verdict { display: flex; gap: 20px; align-items: center; margin-top: 24px; padding: 20px 24px; border-radius: 10px;
  border: 1px solid; }
.verdict h2 { margin-bottom: 4px; }
.verdict p { margin: 0 0 4px; }
.verdict .sign { flex: none; width: 56px; height: 56px; border-radius: 50%; font-size: 30px; line-height: 56px;
  text-align: center; font-weight: 700; color: var(--paper); margin: 0; }
.verdict.proved { background: var(--proved-soft); border-color: var(--proved); }
.verdict.refuted { background: var(--refuted-soft); border-color: var(--refuted); }
.verdict.unknown, .verdict.alarms { background: var(--unknown-soft); border-color: var(--unknown); }
.verdict.proved .sign { background: var(--proved); }
.verdict.refuted .sign { background: var(--refuted); }
.verdict.unknown .sign, .verdict.alarms .sign { background: var(--unknown); }
.count { font-weight: 700; }
table { width: 100%; border-collapse: collapse; font-size: 14px; }
th { text-align: left; font-size: 12.5px; font-weight: 600; color: var(--faint); }
th, td { padding: 7px 10px 7px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
thead th { border-bottom: 1.5px solid var(--faint); vertical-align: bottom; }
td:last-child, th:last-child { padding-right: 0; }
.n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.name { font-weight: 600; white-space: nowrap; }
td.none { color: var(--line); }
td.refuted, td.unknown, td.alarms { font-weight: 700; }
td.proved { color: var(--proved); } td.refuted { color: var(--refuted); } td.unknown, td.alarms { color: var(--unknown); }
.path { overflow-wrap: anywhere; } .named { line-height: 1.8; } .paper { display: none; }
.summary th:first-child { width: 16%; } .summary .hash { font-size: 10.5px; } .summary th.n { white-space: normal; width: 7.5%; }
.badge { display: inline-block; font-size: 12px; font-weight: 600; border-radius: 999px; padding: 1px 9px;
  white-space: nowrap; }
.badge.proved { color: var(--proved); background: var(--proved-soft); }
.badge.refuted { color: var(--refuted); background: var(--refuted-soft); }
.badge.unknown, .badge.alarms { color: var(--unknown); background: var(--unknown-soft); }
.badge.unreachable { color: var(--unreachable); background: var(--unreachable-soft); }
.claims td:nth-child(3) { overflow-wrap: anywhere; }
.claims td:first-child { width: 122px; } .claims td:nth-child(4) { width: 17%; } .claims td:nth-child(6) { width: 21%; }
.claims .many td { border-bottom: none; padding-bottom: 2px; }
.claims .one td { padding-top: 2px; padding-bottom: 2px; border-bottom: none; }
.claims .one td:first-child { text-align: right; padding-right: 16px; }
.claims .one td span.proved { color: var(--proved); } .claims .one td span.refuted { color: var(--refuted); }
.claims .one td span.unknown, .claims .one td span.alarms { color: var(--unknown); }
.claims tbody tr:last-child td { border-bottom: 1px solid var(--line); padding-bottom: 7px; }
.sign-off th { width: 15%; } .sign-off td { width: 25%; height: 44px; border: 1px solid var(--line); }
.sign-off tbody th { color: var(--ink); font-size: 14px; vertical-align: middle; }
.sentence { font-size: 16px; padding-left: 12px; border-left: 4px solid var(--proved); margin: 12px 0; }
.sentence.refuted { border-color: var(--refuted); } .sentence.unknown, .sentence.alarms { border-color: var(--unknown); }
.program { border-top: 2px solid var(--ink); padding-top: 24px; }
.witness { border: 1px solid var(--line); border-left: 4px solid var(--refuted); border-radius: 6px;
  padding: 10px 14px; margin: 8px 0; }
.witness.alarm { border-left-color: var(--unknown); } .witness .remedy { font-size: 13px; margin-top: 4px; }
.witness p { margin: 0 0 6px; } .witness ul { margin: 0; padding-left: 18px; }
.witness .call code { font-weight: 600; background: none; padding: 0; }
.warning, .caution { color: var(--unknown); font-weight: 600; }
.clauses, .calls { list-style: none; margin: 0; padding: 0; columns: 2; column-gap: 32px; }
.clauses li, .calls li { break-inside: avoid; padding: 2px 0; }
.clauses code { background: none; padding: 0; }
.alarm-list { margin: 0; padding-left: 18px; }
.call-part { margin: 20px 0 28px; }
.call-graph { display: block; max-width: 100%; height: auto; margin-bottom: 10px; }
.call-graph text { text-anchor: middle; font-family: inherit; }
.call-graph .label { font-size: 14px; font-weight: 600; fill: var(--ink); }
.call-graph .word { font-size: 11.5px; fill: var(--faint); }
.call-graph .box { fill: var(--paper); stroke: var(--faint); stroke-width: 1.5; }
.call-graph .line { fill: none; stroke: var(--faint); stroke-width: 1.4; } .call-graph .head { fill: var(--faint); }
.call-graph .back .line { stroke-dasharray: 5 3; stroke: var(--unknown); }
.call-graph .back .head { fill: var(--unknown); }
.call-graph .proved .box { fill: var(--proved-soft); stroke: var(--proved); }
.call-graph .proved .word { fill: var(--proved); }
.call-graph .refuted .box { fill: var(--refuted-soft); stroke: var(--refuted); stroke-width: 3; }
.call-graph .refuted .word { fill: var(--refuted); }
.call-graph .unknown .box, .call-graph .alarms .box { fill: var(--unknown-soft); stroke: var(--unknown); }
.call-graph .unknown .word, .call-graph .alarms .word { fill: var(--unknown); }
.call-graph .unknown .box { stroke-dasharray: 7 3; } .call-graph .missing .box { stroke-dasharray: 2 3; }
.call-graph a:hover .label, .call-graph a:focus .label { text-decoration: underline; }
.suppressed { color: var(--faint); }
figure { margin: 20px 0; border: 1px solid var(--line); border-radius: 8px; padding: 12px; }
figure svg.feedhold-plot { display: block; width: 100%; height: auto; }
figcaption { font-size: 13px; color: var(--faint); border-top: 1px solid var(--line); margin-top: 8px;
  padding-top: 8px; }
@media (max-width: 700px) { main { padding: 20px 16px 40px; } .clauses, .calls { columns: 1; } }
@page { size: A4; margin: 16mm 14mm 18mm;
  @bottom-right { content: "page " counter(page) " of " counter(pages); font: 8pt sans-serif; color: #59636e; }
  @bottom-left { font: 8pt monospace; color: #59636e; } }
@media print {
  body { font-size: 9pt; line-height: 1.4; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  main { max-width: none; padding: 0; }
  a { color: inherit; }
  .screen { display: none; } .paper { display: inline; }
  small, .id, .meta { font-size: 8pt; } .hash { font-size: 7pt; }
  section { margin-top: 5mm; }
  header { padding-bottom: 3mm; } h1 { font-size: 20pt; margin-bottom: 1mm; } h2 { font-size: 13pt; margin-bottom: 1mm; }
  h3 { font-size: 10.5pt; margin: 4mm 0 1mm; }
  h2, h3, .meta, .sentence { break-after: avoid; } p { orphans: 2; widows: 2; }
  .verdict { margin-top: 4mm; padding: 3mm 4mm; gap: 4mm; } .verdict p { margin-bottom: 0.5mm; }
  .verdict p { font-size: 8.5pt; } .verdict .named { line-height: 1.4; }
  .summary { table-layout: fixed; } .summary th.n { font-size: 7pt; width: 6.2%; }
  .summary th:first-child { width: 12.5%; } .summary .hash { font-size: 6.5pt; }
  table { font-size: 8.5pt; } thead { display: table-header-group; } th { font-size: 8pt; }
  th, td { padding: 1.2mm 2mm 1.2mm 0; }
  .claims { font-size: 8pt; } .claims small { font-size: 7.5pt; }
  .claims .one td { padding-top: 0.3mm; padding-bottom: 0.3mm; line-height: 1.25; }
  .claims tbody tr:last-child td { padding-bottom: 1.2mm; }
  .claims .many { break-after: avoid; } .claims .many + .one { break-before: avoid; }
  .claims td:first-child { width: 24mm; } .claims td:nth-child(4) { width: 34mm; }
  .claims td:nth-child(6) { width: 16mm; }
  .badge { font-size: 7.5pt; padding: 0 2mm; }
  .sign-off td { height: 8mm; } .summary th, .summary td { padding: 0.7mm 1.5mm 0.7mm 0; }
  .clauses { font-size: 8.5pt; } .clauses li, .calls li { padding: 0; }
  pre { font-size: 7.5pt; padding: 1.5mm 2.5mm; margin-top: 1mm; } .witness { padding: 2mm 3mm; }
  tr, figure, .witness, .verdict, #sign-off, #disclaimer, .call-graph { break-inside: avoid; }
  .program { padding-top: 5mm; margin-top: 8mm; } #sign-off + .program { break-before: page; }
  #sign-off + #calls { break-before: page; }
  .call-graph { max-height: 235mm; max-width: 100%; width: auto; }
  figure { padding: 2mm; margin: 3mm 0; } figure svg.feedhold-plot { max-height: 105mm; }
}
)";

} // namespace feedhold::certificate
