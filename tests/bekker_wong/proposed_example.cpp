// drawbar_pull_by_slip_and_load: a proposal, learned from runs. Nobody has derived it.
//
// An example, of the tests.
//
// To make it an effect of the catalogue: give it a name and its cause; put this file beside the others, a line into
// forms.hpp, catalogue.cpp and titles.cpp, one into docs/reference/effects.md, and a test of its trace, of its limit
// (a = 0 is the base model) and of its derivative there.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {
namespace {

class Proposed_drawbar_pull_by_slip_and_load final : public Effect {
 public:
  explicit Proposed_drawbar_pull_by_slip_and_load(const std::vector<double>& p) : p_(p) {}
  void added_forces(ForceLedger& ledger, const Rolling& rolling) const override {
    ledger.add({.name = "proposed", .forward = rolling.around.normal_load * g(rolling.around.at)});
  }

 private:
  double g(const OperatingCondition& at) const {
    return p_[0] * (p_[1] * std::pow(at.slip, 2) + p_[2] * std::max(0.0, at.slip) * std::log((at.load / 1000)));
  }
  std::vector<double> p_;
};

}  // namespace

std::vector<EffectForm> drawbar_pull_by_slip_and_load_forms() {
  return {
      {.id = "drawbar_pull_by_slip_and_load",
       .form = "learned",
       .equation = "force W_n a g along the wheel's plane, g = c0 slip^2 + c1 max(0, slip) ln(load/1000 N)",
       .source = "learned from a campaign: see above",
       .parameters = {{"a", "-", 1.0, -3.0, 3.0, "1: as learned"},
                      {"c0", "-", 0.125, -1.25, 1.25, "weight of slip^2"},
                      {"c1", "-", -0.25, -2.5, 2.5, "weight of max(0, slip) ln(load/1000 N)"}},
       .make = maker<Proposed_drawbar_pull_by_slip_and_load>()},
  };
}

}  // namespace soilbin::bekker_wong
