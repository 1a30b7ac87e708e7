// What the server says to a target such as "/estimate?slip=20%25". Knows nothing of sockets.
#pragma once

#include <string>
#include <string_view>

#include "cli/serve/setup.hpp"

namespace soilbin::cli {

/// An HTTP status (200, 400: the query is wrong, 404, 422: no solution there), a media type, and the text.
struct Reply {
  unsigned status = 200;
  std::string type, body;
};

/// {"error", "hint"} of an error's text, whose hint stands on a line of its own ("\n  hint: ..."); "" for none.
Reply refusal(unsigned status, const std::string& what);

/// "/": the page. "/case": Setup::document(). "/estimate": soilbin-estimate/1 of the start with the query's flags, and
/// for the page: command, readings, numbers, curves and budget (over slips=LOW..HIGH, 0%..100%) and stresses as sheets,
/// wheels to draw; with beside-soil=NAME or beside-tire=NAME those of a second soil or tire too. "/case.yaml": the
/// curves' question; "/curves.csv": their answers, as `soilbin run` of that case saves them. Never throws for what a
/// query says.
Reply reply_to(const Setup& setup, std::string_view target);

}  // namespace soilbin::cli
