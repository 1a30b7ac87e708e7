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
      css += fmt::format(".s.{0}{1}{{stroke:var(--{0}{1})}}.f.{0}{1}{{fill:var(--{0}{1})}}\n", letter, i);
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
svg.plot{display:block;width:100%;height:auto;max-width:560px;margin:0 auto}
svg text{font-family:inherit}
.ink{fill:var(--ink)}.quiet{fill:var(--quiet)}.grid{stroke:var(--edge)}
.quiet-line{stroke:var(--line)}.paper{fill:var(--paper)}
.scroll{overflow-x:auto;margin:1em 0;background:var(--paper);border:1px solid var(--edge);border-radius:8px}
table{border-collapse:collapse;width:100%;font-size:.92rem;
  font-variant-numeric:tabular-nums}
caption{text-align:left;color:var(--quiet);padding:.7em .75em .2em}
th,td{padding:.42em .75em;text-align:right;white-space:nowrap;border-top:1px solid var(--edge)}
thead th{border-top:0;color:var(--quiet);font-weight:600}
th.t,td.t{text-align:left}
td.wide{white-space:normal;min-width:16em}
pre{overflow-x:auto;background:var(--paper);border:1px solid var(--edge);border-radius:8px;padding:.8em 1em;
  font-size:.88rem}
details{margin:1em 0}
summary{cursor:pointer;color:var(--link)}
footer{margin-top:3em;color:var(--quiet);font-size:.88rem}
@media print{body{background:#fff}figure,.scroll,.summary{break-inside:avoid}}
)css";

}  // namespace

std::string page_style() {
  const std::string light =
      "--ground:#f6f7f9;--paper:#fff;--ink:#1a1d23;--quiet:#5a6270;--edge:#dfe3e8;--line:#8a919c;--link:#0b63a8;" +
      palette_properties(&Color::light);
  const std::string dark =
      "--ground:#111418;--paper:#191d23;--ink:#e8eaee;--quiet:#a2abb8;--edge:#2d333c;--line:#6d7683;--link:#6cb6ff;" +
      palette_properties(&Color::dark);
  return fmt::format(":root{{color-scheme:light dark;{}}}\n@media (prefers-color-scheme:dark){{:root{{{}}}}}\n{}{}",
                     light, dark, rules, palette_rules());
}

}  // namespace soilbin::compare
