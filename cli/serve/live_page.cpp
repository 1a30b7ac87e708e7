#include "cli/serve/live_page.hpp"

#include "cli/text_output.hpp"
#include "compare/report/page.hpp"

namespace soilbin::cli {
std::string live_page(const Setup& setup) {
  compare::Page page(in_words(setup.ask({}).question.scenario.tire),
                     "By the analytic model of soilbin estimate: move a number, and everything follows.");
  const std::vector<compare::EmbeddedFile> own = live_files();
  page.raw("<style>\n" + compare::embedded(own, "live.css") + "</style>\n");
  if (!page.libraries().d3)
    page.raw(
        "<p class=\"warning\" role=\"note\">d3 is not installed on this machine (package node-d3): numbers without "
        "curves.</p>\n");
  page.raw(compare::embedded(own, "live.html"));
  page.script(compare::embedded(own, "wheel.js") + compare::embedded(own, "live.js"));
  return page.html();
}

}  // namespace soilbin::cli
