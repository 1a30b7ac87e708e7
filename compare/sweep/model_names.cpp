#include "compare/sweep/model_names.hpp"

#include <algorithm>
#include <stdexcept>

#include "bekker_wong/effects/titles.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {
namespace {

std::string name_of_effect(const std::string& id) {
  try {
    return std::string(bekker_wong::effect_title(id).name);
  } catch (const std::out_of_range&) {
    return spaced(id);  // of a label that somebody chose
  }
}

/// "sidewall_bulldozing:passive_wedge" as "side-wall bulldozing (passive wedge)".
std::string effect_in_words(const std::string& id) {
  const std::size_t colon = id.find(':');
  return name_of_effect(id.substr(0, colon)) +
         (colon == std::string::npos ? "" : " (" + spaced(id.substr(colon + 1)) + ")");
}

std::vector<std::string> parts_of(const std::string& label) {
  const std::string plus = " + ";
  std::vector<std::string> parts;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + plus.size()) {
    end = label.find(plus, begin);
    parts.push_back(label.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

}  // namespace

std::string model_in_words(const std::string& label) {
  if (label == "dem") return "grains";
  if (label == "rft") return "resistive force theory";
  if (label == "cone_index") return "cone index";
  if (label == "dem-lammps") return "grains (LAMMPS)";
  if (const std::string packing = "dem packing "; label.starts_with(packing))
    return "grains, bed sample " + label.substr(packing.size());
  const std::vector<std::string> parts = parts_of(label);
  if (parts.front() != "bekker_wong") return label;
  std::string words = "analytic wheel";
  for (std::size_t i = 1; i < parts.size(); ++i)
    words += (i == 1 ? " with " : i + 1 == parts.size() ? " and " : ", ") + effect_in_words(parts[i]);
  return words;
}

std::vector<std::pair<std::string, std::string>> names_and_ids(const std::vector<std::string>& labels) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& label : labels)
    if (std::pair one{model_in_words(label), label}; one.first != label && std::ranges::find(names, one) == names.end())
      names.push_back(std::move(one));
  return names;
}

}  // namespace soilbin::compare
