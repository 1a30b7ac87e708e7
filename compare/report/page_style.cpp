#include "compare/report/page_style.hpp"

#include <fmt/core.h>

#include "compare/report/plot.hpp"

namespace soilbin::compare {
namespace {

/// Colours of one scheme as custom properties.
std::string palette_properties(const char* Color::*scheme) {
  std::string css;
  for (const auto& [palette, letter] : {std::pair{Palette::named, 'c'}, std::pair{Palette::ordered, 'q'}}) {
    const std::vector<Color> all = colors(palette);
    for (std::size_t i = 0; i < all.size(); ++i) css += fmt::format("--{}{}:{};", letter, i, all[i].*scheme);
  }
  return css;
}

/// Rules that give the marks of the plots their scheme's colour.
std::string palette_rules() {
  std::string css;
  for (const auto& [palette, letter] : {std::pair{Palette::named, 'c'}, std::pair{Palette::ordered, 'q'}})
    for (std::size_t i = 0; i < colors(palette).size(); ++i)
      css += fmt::format(
          ".s.{0}{1}{{stroke:var(--{0}{1})}}.f.{0}{1}{{fill:var(--{0}{1})}}.dot.{0}{1}{{background:var(--{0}{1})}}\n",
          letter, i);
  return css;
}

constexpr const char* rules = R"css(
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--ground);color:var(--ink);
  font:16px/1.55 system-ui,-apple-system,'Segoe UI','DejaVu Sans',Helvetica,Arial,
  sans-serif}
main{max-width:1080px;margin:0 auto;padding:clamp(16px,4vw,48px) clamp(14px,4vw,40px) 64px}
h1{font-size:clamp(1.5rem,4.5vw,2.2rem);line-height:1.15;margin:0 0 .3em;letter-spacing:-.01em}
h2{font-size:1.35rem;line-height:1.25;margin:2.6em 0 .5em;padding-top:1.1em;border-top:1px solid var(--edge)}
h3{font-size:1.05rem;margin:1.8em 0 .4em}
p,li{max-width:72ch}
p{margin:.5em 0}
a{color:var(--link)}
.subtitle{color:var(--quiet);margin:0 0 1.4em}
nav{margin:1.4em 0 0;font-size:.92rem;color:var(--quiet)}
nav a{display:inline-block;text-decoration:none;margin:0 1.1em .3em 0}
.summary{background:var(--paper);border:1px solid var(--edge);border-left:4px solid var(--c0);
  border-radius:8px;padding:.9em 1.2em;margin:1em 0}
.summary p{margin:.45em 0;max-width:none}
.glance{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin:1.2em 0}
.glance div{background:var(--paper);border:1px solid var(--edge);border-radius:8px;padding:.7em .9em}
.glance b{display:block;font-size:1.35rem;line-height:1.25}
.glance span{color:var(--quiet);font-size:.88rem}
figure{margin:1.2em 0;background:var(--paper);border:1px solid var(--edge);border-radius:8px;
  padding:14px}
figcaption{color:var(--quiet);font-size:.92rem;margin-top:10px;max-width:72ch}
.legend{display:flex;flex-wrap:wrap;gap:4px 18px;font-size:.86rem;margin:0 0 10px;padding:0;list-style:none}
.legend li{display:flex;align-items:center;gap:7px}
.panels{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,330px),1fr));gap:12px}
svg.plot{display:block}
svg.plot:not(.heat){width:100%;height:auto;max-width:560px;margin:0 auto}
svg text{font-family:inherit}
.ink{fill:var(--ink)}.quiet{fill:var(--quiet)}.grid{stroke:var(--edge)}
.quiet-line{stroke:var(--line)}.paper{fill:var(--paper)}
.scroll{overflow-x:auto;margin:1em 0;background:var(--paper);border:1px solid var(--edge);border-radius:8px}
table{border-collapse:collapse;width:100%;font-size:.92rem;
  font-variant-numeric:tabular-nums}
caption{text-align:left;color:var(--quiet);padding:.7em .75em .2em}
th,td{padding:.42em .6em;text-align:right;white-space:nowrap;border-top:1px solid var(--edge)}
thead th{border-top:0;color:var(--quiet);font-weight:600;white-space:normal;vertical-align:bottom}
th.t,td.t{text-align:left;white-space:normal}
td.wide{white-space:normal;min-width:16em}
pre{overflow-x:auto;background:var(--paper);border:1px solid var(--edge);border-radius:8px;padding:.8em 1em;
  font-size:.88rem}
details{margin:1em 0}
summary{cursor:pointer;color:var(--link)}
footer{margin-top:3em;color:var(--quiet);font-size:.88rem}
a.evidence{font-size:.86rem;white-space:nowrap;margin-left:.3em}
button,select,input[type=range]{font:inherit;color:inherit}
button,select{background:var(--ground);border:1px solid var(--edge);border-radius:6px;padding:.3em .7em;cursor:pointer;
  min-height:34px}
button:hover,select:hover{border-color:var(--line)}
:focus-visible{outline:3px solid var(--link);outline-offset:2px}
.legend button{display:flex;align-items:center;gap:7px;padding:.1em .6em}
.legend button[aria-pressed=false]{opacity:.45;text-decoration:line-through}
.chart{min-width:0}
.chart-frame{position:relative}
svg.live{display:block;width:100%;touch-action:pan-y;font-size:12px}
svg.live .axis text{fill:var(--quiet);font-size:12px}
svg.live .axis path,svg.live .axis line{stroke:var(--line)}
svg.live .lines path{stroke:none}
svg.live .lines line{stroke:var(--edge)}
svg.live .title{font-size:13px;font-weight:600}
svg.live .line{fill:none;stroke-width:2}
svg.live .band{fill-opacity:.16;stroke:none}
svg.live .cursor{stroke:var(--line);stroke-dasharray:3 3}
.zoom{position:absolute;top:0;right:0;display:flex;gap:3px}
.zoom button{padding:0;width:26px;min-height:24px;line-height:1;font-size:.95rem}
.tip{position:absolute;top:34px;pointer-events:none;background:var(--paper);border:1px solid var(--line);
  border-radius:6px;padding:.3em .6em;font-size:.82rem;line-height:1.35;z-index:2;max-width:70%}
.dot{display:inline-block;width:9px;height:9px;border-radius:50%;margin-right:6px}
.for-ears{position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%);margin:0}
.take-along{font-size:.86rem;color:var(--quiet);margin:.6em 0 0}
.take-along button{padding:.05em .6em;min-height:26px}
.chooser{display:block;margin:1em 0 .4em}
.chooser select{max-width:100%}
.alive>.choice>h3{display:none}
.reading{min-height:1.6em;color:var(--quiet);font-size:.9rem;margin:.2em 0;grid-column:1/-1}
.cell:focus{outline:none}
.cell:focus rect,.cell:hover rect{stroke:var(--ink);stroke-width:2}
.maps{display:flex;flex-wrap:wrap;gap:12px}
.maps>div{min-width:0;max-width:100%;overflow-x:auto}
.maps .reading{width:0;min-width:100%}
.cell-empty{stroke:var(--edge)}
.warning{background:var(--paper);border:1px solid var(--edge);border-left:4px solid var(--c1);border-radius:8px;
  padding:.7em 1.1em;margin:1em 0}
.replay{position:relative}
.replay canvas{display:block;width:100%;height:min(62vh,560px);border-radius:6px;touch-action:pan-y}
.replay .bar{display:flex;flex-wrap:wrap;gap:8px 14px;align-items:center;margin-top:10px;font-size:.9rem}
.replay .bar label{display:flex;gap:6px;align-items:center}
.replay .bar input[type=range]{flex:1 1 160px;min-width:120px}
.scale{display:flex;align-items:center;gap:8px;font-size:.84rem;color:var(--quiet);margin-top:6px}
.scale i{flex:0 1 180px;height:10px;border-radius:5px}
@media print{
  :root{color-scheme:light}
  body{background:#fff;font-size:11pt}
  main{max-width:none;padding:0}
  figure,.scroll,.summary,tr{break-inside:avoid}
  h2,h3{break-after:avoid}
  nav,.zoom,.take-along,.chooser,.replay .bar,.reading{display:none}
  .alive>.choice>h3{display:block}
  .scroll{overflow:visible}
  table{font-size:8.5pt}
  th,td{white-space:normal}
  .maps>div{overflow:visible}
  .maps svg.heat{max-width:100%;height:auto}
}
)css";

}  // namespace

std::string page_style() {
  const std::string light =
      "--ground:#f6f7f9;--paper:#fff;--ink:#1a1d23;--quiet:#5a6270;--edge:#dfe3e8;--line:#8a919c;--link:#0b63a8;" +
      palette_properties(&Color::light);
  const std::string dark =
      "--ground:#111418;--paper:#191d23;--ink:#e8eaee;--quiet:#a2abb8;--edge:#2d333c;--line:#6d7683;--link:#6cb6ff;" +
      palette_properties(&Color::dark);
  return fmt::format(
      ":root{{color-scheme:light dark;{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}\n{}{}", light,
      dark, rules, palette_rules());
}

}  // namespace soilbin::compare
