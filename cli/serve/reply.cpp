#include "cli/serve/reply.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/report/json_fields.hpp"
#include "compare/report/page.hpp"
#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

/// The scripts, style and bodies of the pages, from cli/serve/browser; made by the build.
std::vector<compare::EmbeddedFile> live_files();

namespace {

constexpr const char* icon =
    R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><path d="M0 6h8v2H0z" fill="#c2500a"/>)"
    R"(<circle cx="4" cy="3.7" r="2.7" fill="none" stroke="#0b63a8" stroke-width="1.2"/></svg>)";

}  // namespace

Reply json_reply(const nlohmann::ordered_json& document, unsigned status) {
  return {status, "application/json", document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)};
}

Reply refusal(unsigned status, const std::string& what) {
  const auto [error, hint] = error_and_hint(what);
  return {status, "application/json", compare::json_text({{"error", error}, {"hint", hint}})};
}

Reply page_reply(const std::string& title, const std::string& subtitle, const PageFiles& files) {
  compare::Page page(title, subtitle);
  const std::vector<compare::EmbeddedFile> own = live_files();
  page.raw("<style>\n" + compare::embedded(own, "live.css") + "</style>\n");
  if (!page.libraries().d3)
    page.raw(
        "<p class=\"warning\" role=\"note\">d3 is not installed on this machine (package node-d3): numbers without "
        "curves.</p>\n");
  page.raw(compare::embedded(own, files.body));
  std::string scripts = compare::embedded(own, "live.js");
  for (const std::string& script : files.scripts) scripts += compare::embedded(own, script);
  page.script(scripts);
  return {200, "text/html; charset=utf-8", page.html()};
}

Reply answered(const Answers& answers, std::string_view target, const std::string& hint) {
  const std::size_t mark = std::min(target.find('?'), target.size());
  const std::string path(target.substr(0, mark)), query(target.substr(std::min(mark + 1, target.size())));
  try {
    if (path == "/favicon.ico") return {200, "image/svg+xml", icon};
    if (const auto answer = answers.find(path); answer != answers.end()) return answer->second(query);
  } catch (const InputError& error) {
    return refusal(400, error.what());
  }
  return refusal(404, fmt::format("there is no '{}' here\n  hint: {}", clipped(path), hint));
}

}  // namespace soilbin::cli
