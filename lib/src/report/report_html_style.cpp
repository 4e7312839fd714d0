#include "report_html_parts.hpp"

namespace tcm_icp::html {

// Neither & nor < may stand here: XML reads them, HTML does not.
const char* style_sheet() {
  return R"css(:root { color-scheme: light; --ink: #1c2733; --soft: #5b6875; --line: #d5dbe1; --good: #1a7f37;
  --fair: #9a6700; --bad: #c62828; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 66rem; padding: 2rem 1.5rem; background: #fff; color: var(--ink);
  font: .875rem/1.45 "Segoe UI", "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
header { border-bottom: 2px solid var(--ink); margin-bottom: 1.2rem; }
header p { margin: 0 0 .6rem; color: var(--soft); }
h1 { font-size: 1.7rem; margin: 0; }
h2 { font-size: 1.1rem; margin: 2rem 0 .6rem; padding-bottom: .2rem; border-bottom: 1px solid var(--line); }
p { margin: .4rem 0; }
.note { color: var(--soft); font-size: .85rem; max-width: 52rem; }
.verdict { border-left: 6px solid; padding: .7rem 1rem; }
.verdict p, .verdict ul { margin: .2rem 0; }
.verdict .line { font-size: 1.15rem; font-weight: 600; }
.verdict.good { border-color: var(--good); background: #eef8f0; }
.verdict.fair { border-color: var(--fair); background: #fdf6e3; }
.verdict.bad { border-color: var(--bad); background: #fdeeee; }
.facts { display: grid; grid-template-columns: repeat(auto-fill, minmax(11.5rem, 1fr)); gap: .5rem 1.5rem;
  margin: .8rem 0; }
.facts div { border-top: 1px solid var(--line); padding-top: .2rem; }
.facts dt { color: var(--soft); font-size: .8rem; }
.facts dd { margin: 0; font-weight: 600; overflow-wrap: anywhere; }
table { width: 100%; border-collapse: collapse; font-size: .82rem; font-variant-numeric: tabular-nums; }
th { text-align: left; vertical-align: bottom; color: var(--soft); font-weight: 600; border-bottom: 1px solid var(--ink); }
th, td { padding: .22rem .4rem; }
th:first-child, td:first-child { padding-left: 0; }
td { vertical-align: top; border-bottom: 1px solid var(--line); }
.number { text-align: right; white-space: nowrap; }
.text { white-space: nowrap; }
.name { min-width: 6rem; }
.wide { overflow-wrap: anywhere; min-width: 13rem; }
.file { overflow-wrap: anywhere; }
.badge { white-space: nowrap; font-weight: 600; }
.badge.good { color: var(--good); }
.badge.fair { color: var(--fair); }
.badge.bad { color: var(--bad); }
.swatch { display: inline-block; width: .8em; height: .8em; border-radius: 50%; border: 1px solid #0006;
  vertical-align: -.05em; margin-right: .45em; }
figure { margin: .5rem 0; }
figcaption { color: var(--soft); font-size: .85rem; }
svg { display: block; width: 100%; height: auto; font: 11px "Segoe UI", "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
.legend { display: flex; flex-wrap: wrap; gap: .2rem 1.5rem; font-size: .85rem; }
.key { display: inline-flex; align-items: center; gap: .5rem; }
.key svg { width: 34px; height: 8px; }
svg .cover { fill-opacity: .04; stroke-opacity: .25; }
svg .link { fill: none; stroke-linecap: round; }
svg .good { stroke: var(--good); }
svg .fair { stroke: #d08700; stroke-dasharray: 6 4; }
svg .bad { stroke: var(--bad); stroke-dasharray: 1.5 4.5; }
svg .plain { stroke: #6b7885; }
code { display: block; font: .8rem/1.4 "DejaVu Sans Mono", Consolas, monospace; overflow-wrap: anywhere;
  background: #f5f7f9; padding: .5rem .7rem; }
.signatures { display: grid; grid-template-columns: 1fr 1fr; gap: 1rem 3rem; break-inside: avoid; }
.signatures h3 { font-size: .95rem; margin: 0; }
.signatures p { display: grid; grid-template-columns: 5.5rem 1fr; margin: 1.6rem 0 0; color: var(--soft); }
.signatures i { border-bottom: 1px solid var(--ink); }
@page { size: A4; margin: 15mm 14mm; }
@media print {
  html { font-size: 11.5px; }
  .wide { min-width: 11rem; }
  body { padding: 0; max-width: none; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  h2 { break-after: avoid; }
  thead { display: table-header-group; }
  tr, figure, .verdict, .facts div { break-inside: avoid; }
}
)css";
}

}  // namespace tcm_icp::html
