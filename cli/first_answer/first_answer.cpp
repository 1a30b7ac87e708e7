// The first answer of ./demo, before the rest is compiled: the paper's tire on its sand at 4 kN and 20 % slip, by the
// analytic wheel. Needs scenario/ and bekker_wong/ alone, a twelfth of the compiling. `soilbin estimate` says the same.
#include <fmt/format.h>

#include "bekker_wong/model.hpp"
#include "scenario/case.hpp"
#include "scenario/library.hpp"
#include "scenario/scenario.hpp"

int main() {
  using namespace soilbin;
  const Library library({SOILBIN_SOURCE_CASES});
  Scenario scenario;
  scenario.tire = read_tire(find_file(library, Shelf::tires, "paper-lugged"));
  scenario.soil = read_soil(find_file(library, Shelf::soils, "paper-sand"));
  OperatingCondition at;
  at.load = 4000;  // N
  at.slip = 0.2;
  const TractionResult answer = bekker_wong::BekkerWong().evaluate(scenario, at);
  fmt::print("{} on {}, load 4 kN, slip 20 %, by the analytic wheel without effects\n", scenario.tire.name,
             scenario.soil.name);
  fmt::print("  Drawbar pull  {:.0f} ± {:.0f} N\n", answer.drawbar_pull.value, answer.drawbar_pull.std_error);
  fmt::print("  Torque        {:.0f} ± {:.0f} N m\n", answer.torque.value, answer.torque.std_error);
  fmt::print("  Sinkage       {:.0f} ± {:.0f} mm\n", 1000 * answer.sinkage.value, 1000 * answer.sinkage.std_error);
}
