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
  for (const Doubt& doubt : doubts(question, study)) {
    if (doubt.kind != DoubtKind::coarse_grains) {
      add(name, Doubts{doubt});
      continue;
    }
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) {
      return one.grains && same_wheel_on_grains(one.grains->scenario, question.scenario);
    });
    if (known == entries_.end()) {
      entries_.push_back({doubt, OnGrains{question.scenario, study}});
      entries_.back().doubt.of = name;
    } else {
      known->doubt.of += ", " + name;
      known->grains->study.insert(known->grains->study.end(), study.begin(), study.end());
    }
  }
}

void NamedDoubts::add(const std::string& name, const Doubts& doubts) {
  for (Doubt doubt : doubts) {
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) {
      doubt.of = one.doubt.of;
      return one.doubt == doubt;
    });
    if (known != entries_.end()) {
      known->doubt.of += ", " + name;
      continue;
    }
    doubt.of = name;
    entries_.push_back({doubt, {}});
  }
}

Doubts NamedDoubts::all() const {
  Doubts all;
  for (const Entry& one : entries_) {
    all.push_back(one.grains ? coarse_grain_doubts(one.grains->scenario, one.grains->study).front() : one.doubt);
    all.back().of = one.doubt.of;
  }
  return all;
}

}  // namespace soilbin::compare
