#include "compare/measured/condition_views.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace soilbin::compare {

const ConditionView& condition_view(std::string_view name) {
  const auto found = std::find_if(condition_views.begin(), condition_views.end(),
                                  [&](const ConditionView& view) { return view.name == name; });
  if (found == condition_views.end()) throw std::out_of_range("a condition of no such name: " + std::string(name));
  return *found;
}

std::string heading(const ConditionView& view) {
  return std::string(view.title) + (view.unit.empty() ? "" : " [" + std::string(view.unit) + "]");
}

}  // namespace soilbin::compare
