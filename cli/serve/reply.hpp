// A reply to a target such as "/estimate?slip=20%25", and what every served page has: its HTML, its refusals. Knows
// nothing of sockets.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace soilbin::cli {

/// An HTTP status (200, 400: the query is wrong, 404, 422: no solution there), a media type, and the text.
struct Reply {
  unsigned status = 200;
  std::string type, body;
};

/// Whether somebody still waits for the answer; an answer that takes long asks now and then.
using StillWanted = std::function<bool()>;

/// Thrown by an answer that nobody waits for.
struct GivenUp : std::runtime_error {
  GivenUp() : std::runtime_error("nobody waits for this answer") {}
};

/// {"error", "hint"} of an error's text, whose hint stands on a line of its own ("\n  hint: ..."); "" for none.
Reply refusal(unsigned status, const std::string& what);

Reply json_reply(const nlohmann::ordered_json& document, unsigned status = 200);

/// Files of cli/serve/browser that one page alone has: its body, and its scripts after that of all pages (live.js).
struct PageFiles {
  std::string body;
  std::vector<std::string> scripts;
};

/// Self-contained HTML with the reports' style, charts and d3; where d3 isn't installed the page says so, and shows
/// numbers without curves.
Reply page_reply(const std::string& title, const std::string& subtitle, const PageFiles& files);

/// What answers a query, by its path: "/estimate".
using Answers = std::map<std::string, std::function<Reply(const std::string& query)>, std::less<>>;

/// The answer to a target. Never throws for what a query says: an InputError is a status 400. `hint`: which paths there
/// are.
Reply answered(const Answers& answers, std::string_view target, const std::string& hint);

}  // namespace soilbin::cli
