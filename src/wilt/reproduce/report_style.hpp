// The style sheet of the report; inside the reproduce room only.
#pragma once

namespace wilt::detail {

inline constexpr const char* kReportStyle = R"(
:root { color-scheme: light dark; --ink: #1d211c; --soft: #5d655b; --paper: #fbfaf7; --card: #ffffff; --line: #dcdad2;
  --yes: #00684c; --no: #a63c00; --tint: #f1efe8; }
@media (prefers-color-scheme: dark) { :root { --ink: #e7e6e0; --soft: #a5aaa0; --paper: #161815; --card: #20231f;
  --line: #3a3e38; --yes: #4fd0a4; --no: #ff9a5c; --tint: #262a25; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.55 system-ui, "Helvetica Neue", Arial, sans-serif; }
main, header, footer { max-width: 74rem; margin: 0 auto; padding: 0 1.5rem; }
header { padding-top: 3rem; }
h1 { font-size: 2.1rem; line-height: 1.2; margin: 0 0 .6rem; }
h2 { font-size: 1.4rem; line-height: 1.25; margin: 0 0 .5rem; }
h2 .number { color: var(--soft); font-weight: 500; }
section { border-top: 1px solid var(--line); margin-top: 3rem; padding-top: 2rem; }
p { max-width: 46rem; }
.lead { font-size: 1.1rem; color: var(--soft); }
.soft, figcaption, caption { color: var(--soft); font-size: .9rem; }
a { color: inherit; }
nav { display: flex; flex-wrap: wrap; gap: .4rem 1rem; margin: 1.5rem 0 0; font-size: .95rem; }
blockquote { margin: 0 0 1.2rem; padding: .1rem 0 .1rem 1rem; border-left: 3px solid var(--line); max-width: 46rem; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .92rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding-bottom: .4rem; }
th, td { text-align: left; vertical-align: top; padding: .35rem .9rem .35rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--soft); }
.scroll { overflow-x: auto; }
.claims { width: 100%; }
.claims td:first-child, .claims td:nth-child(n+4) { white-space: nowrap; }
.verdict { white-space: nowrap; font-weight: 600; }
.yes { color: var(--yes); } .no { color: var(--no); } .none { color: var(--soft); }
figure { margin: 1.4rem 0; }
figcaption { margin-top: .5rem; max-width: 60rem; }
.grid { display: grid; gap: .6rem; min-width: 44rem; align-items: end; }
.grid .label { align-self: center; font-size: .9rem; color: var(--soft); }
.grid .head { font-size: .9rem; color: var(--soft); text-align: center; }
.cell img, .strip img { display: block; width: 100%; height: auto; border-radius: 4px; }
.cell span { display: block; text-align: center; font-size: .8rem; color: var(--soft); }
.strips { display: grid; grid-template-columns: 5rem 1fr; gap: .3rem .6rem; min-width: 60rem; align-items: center; }
.strips .heads { display: flex; }
.strips .heads span { flex: 1; text-align: center; font-size: .8rem; color: var(--soft); }
.plot img { display: block; max-width: 100%; height: auto; background: #fff; border: 1px solid var(--line); border-radius: 4px; }
.bar { display: inline-block; width: 16rem; height: .8rem; border-radius: 2px; margin: 0 .6rem; vertical-align: middle; }
footer { margin-top: 4rem; padding-bottom: 3rem; color: var(--soft); font-size: .9rem; }
)";

}  // namespace wilt::detail
