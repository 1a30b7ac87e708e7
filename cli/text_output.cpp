#include "cli/text_output.hpp"

#include <fmt/core.h>

#include "compare/report/json_fields.hpp"

namespace soilbin::cli {

void print_warnings(const compare::Doubts& doubts) {
  for (const std::string& line : in_words(doubts)) fmt::print(stderr, "warning: {}\n", line);
}

void print_json(nlohmann::ordered_json document, const compare::Doubts& doubts) {
  compare::add_warnings(document, doubts);
  fmt::print("{}", compare::json_text(document));
}

}  // namespace soilbin::cli
