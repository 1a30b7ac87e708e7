#include "cli/serve/live_page.hpp"

#include "cli/text_output.hpp"
#include "compare/report/page.hpp"

namespace soilbin::cli {
namespace {

constexpr const char* style = R"css(<style>
main{max-width:1640px}
.live-page{display:grid;grid-template-columns:minmax(290px,350px) minmax(0,1fr);gap:20px;align-items:start}
.live-page form{background:var(--paper);border:1px solid var(--edge);border-radius:8px;padding:12px 16px;
  position:sticky;top:12px;max-height:calc(100vh - 24px);overflow-y:auto}
.live-page fieldset{border:0;padding:0;margin:0 0 8px;min-width:0}
.live-page legend,.live-page summary{font-weight:600;padding:.4em 0 .2em}
.live-page details{margin:0 0 8px}
.number{display:grid;grid-template-columns:minmax(0,1fr) 6.2em 2.4em;gap:0 8px;align-items:center;margin:0 0 4px;
  font-size:.92rem}
.number input[type=range]{grid-column:1/-1;width:100%;margin:2px 0 6px;min-height:26px}
.number input[type=number]{font:inherit;color:inherit;background:var(--ground);border:1px solid var(--edge);
  border-radius:6px;padding:.15em .4em;width:100%;text-align:right}
.number[hidden]{display:none}
.number span{color:var(--quiet)}
.effect{display:flex;flex-wrap:wrap;gap:2px 8px;align-items:center;font-size:.92rem;min-height:30px}
.effect label{display:flex;gap:8px;align-items:center;cursor:pointer}
.effect select{min-height:26px;padding:0 .4em;max-width:100%}
.effect .parameters{flex-basis:100%;padding-left:26px}
.effect small{flex-basis:100%;color:var(--quiet);overflow-wrap:anywhere;padding-left:26px}
.chooser{font-size:.92rem}.chooser select{width:100%}
#say p{margin:.3em 0}
#now{margin:0 0 12px;grid-template-columns:repeat(auto-fit,minmax(140px,1fr))}
#command{white-space:pre-wrap;overflow-wrap:anywhere}
.chosen{color:var(--quiet);margin:0 0 10px;max-width:none}
.row{display:flex;flex-wrap:wrap;gap:8px;margin:10px 0}
h2{margin-top:1.2em}
.stale #now,.stale figure{opacity:.55}
@media(max-width:820px){
  .live-page{grid-template-columns:minmax(0,1fr);gap:10px}
  .live-page form{position:static;max-height:none}
  .results{display:contents}
  #now{order:-1;position:sticky;top:0;z-index:3;background:var(--ground);grid-template-columns:1fr 1fr;gap:4px;
    padding:4px 0;margin:0}
  #now div{padding:.2em .6em}#now b{font-size:.95rem}#now span{font-size:.76rem;display:block;line-height:1.2}
}
</style>
)css";

constexpr const char* body = R"html(<div class="live-page">
<form aria-label="What the wheel is asked to do" autocomplete="off"><p>Loading ...</p></form>
<div class="results">
<div id="say" class="warning" role="alert" hidden></div>
<p class="chosen" id="chosen"></p>
<div class="glance" id="now"></div>
<p class="for-ears" id="spoken" aria-live="polite"></p>
<div id="sentences"></div>
<div class="row"><button type="button" id="keep" aria-pressed="false">Keep these curves to compare</button>
<button type="button" id="reset">Back to the start</button></div>
<h2>Against slip</h2>
<figure><div class="panels" id="curves"></div><figcaption>Lines with one standard error, from the soil's standard
deviations; the dot is the present point. Arrow keys read a chart's values; plus and minus zoom.</figcaption></figure>
<h2>Along the contact, at the present point</h2>
<figure><div class="panels" id="stresses"></div><figcaption>From where soil lets go of the wheel (left) to where it meets it
(right).</figcaption></figure>
<h2>The same on the command line</h2>
<pre><code id="command"></code></pre>
<div class="row"><button type="button" id="copy">Copy the command</button></div>
</div>
</div>
<noscript><p class="warning">This page needs scripts, which this browser doesn't run.</p></noscript>
)html";

}  // namespace

std::string live_page(const Setup& setup) {
  compare::Page page(in_words(setup.ask({}).question.scenario.tire),
                     "By the analytic model of soilbin estimate: move a number, and everything follows.");
  compare::Libraries libraries = compare::find_libraries();
  page.raw(style);
  if (!libraries.d3)
    page.raw(
        "<p class=\"warning\" role=\"note\">d3 is not installed on this machine (package node-d3): numbers without "
        "curves.</p>\n");
  page.raw(body);
  page.enliven(std::move(libraries));
  for (const compare::Script& script : live_scripts()) page.script(script.text);
  return page.html();
}

}  // namespace soilbin::cli
