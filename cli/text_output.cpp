#include "cli/text_output.hpp"

#include <fmt/core.h>

#include "compare/report/json_fields.hpp"

namespace soilbin::cli {

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

void print_json(nlohmann::ordered_json document, const std::vector<std::string>& doubts) {
  compare::add_warnings(document, doubts);
  fmt::print("{}", compare::json_text(document));
}

}  // namespace soilbin::cli
