// A user's program: what a calibration of the contact with the tire is asked for, by the installed experiments.
#include <compare/experiments/element_experiments.hpp>
#include <cstdio>

int main() {
  using namespace soilbin::compare;
  const auto names = target_names(ContactKind::grain_tire);
  const auto factors = usual_factors(ContactKind::grain_tire);
  for (const std::string& name : names) std::printf("%s [%s]\n", name.c_str(), unit_of_target(name).c_str());
  return !names.empty() && factors.size() >= 2 ? 0 : 1;
}
