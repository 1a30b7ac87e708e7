#include "compare/doubts/named_doubts.hpp"

#include <algorithm>

#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_doubts.hpp"

namespace soilbin::compare {
namespace {

/// Whether grains are as coarse for the one wheel as for the other.
bool same_wheel_on_grains(const Scenario& a, const Scenario& b) {
  return a.tire.name == b.tire.name && a.soil.name == b.soil.name && a.tire.radius == b.tire.radius &&
         a.tire.width == b.tire.width && a.tire.lugs.height == b.tire.lugs.height &&
         mean_diameter(*a.soil.granular) == mean_diameter(*b.soil.granular);
}

}  // namespace

void NamedDoubts::add(const std::string& name, const Case& question, const std::vector<ModelAnswers>& study) {
  const std::string coarse_grains = coarse_grain_doubt(question.scenario, study);
  for (const std::string& doubt : doubts(question, study)) {
    if (doubt != coarse_grains) {
      add(name, std::vector{doubt});
      continue;
    }
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) {
      return one.grains && same_wheel_on_grains(one.grains->scenario, question.scenario);
    });
    if (known == entries_.end()) {
      entries_.push_back({name, "", OnGrains{question.scenario, study}});
    } else {
      known->names += ", " + name;
      known->grains->study.insert(known->grains->study.end(), study.begin(), study.end());
    }
  }
}

void NamedDoubts::add(const std::string& name, const std::vector<std::string>& doubts) {
  for (const std::string& doubt : doubts) {
    const auto known =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) { return one.doubt == doubt; });
    if (known == entries_.end())
      entries_.push_back({name, doubt, {}});
    else
      known->names += ", " + name;
  }
}

std::vector<std::string> NamedDoubts::lines() const {
  std::vector<std::string> lines;
  for (const Entry& one : entries_)
    lines.push_back(one.names + ": " +
                    (one.grains ? coarse_grain_doubt(one.grains->scenario, one.grains->study) : one.doubt));
  return lines;
}

}  // namespace soilbin::compare
