// What the server says of a wheel to a target such as "/estimate?slip=20%25". Knows nothing of sockets.
#pragma once

#include <string_view>

#include "cli/serve/reply.hpp"
#include "cli/serve/setup.hpp"

namespace soilbin::cli {

/// "/": the page. "/case": Setup::document(). "/estimate": soilbin-estimate/1 of the start with the query's flags, and
/// for the page: command, readings, numbers, curves and budget (over slips=LOW..HIGH, 0%..100%) and stresses as sheets,
/// wheels to draw; with beside-soil=NAME or beside-tire=NAME those of a second soil or tire too. "/case.yaml": the
/// curves' question; "/curves.csv": their answers, as `soilbin run` of that case saves them. Never throws for what a
/// query says.
Reply reply_to(const Setup& setup, std::string_view target, const StillWanted& wanted);

}  // namespace soilbin::cli
