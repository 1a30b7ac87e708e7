// A user's program: a published point by the analytic model, two independent codes agree on it
// (docs/lab/verification.md).
#include <bekker_wong/effect.hpp>
#include <bekker_wong/model.hpp>
#include <bekker_wong/rolling_wheel.hpp>
#include <cmath>
#include <cstdio>
#include <scenario/scenario.hpp>

int main() {
  soilbin::Scenario scenario;
  scenario.tire.radius = 0.1;
  scenario.tire.width = 0.1;
  scenario.soil.semi_empirical = soilbin::SemiEmpiricalSoil{.exponent = {1, 0},
                                                            .k_c = {1.4e3, 0},
                                                            .k_phi = {8.2e5, 0},
                                                            .cohesion = {170, 0},
                                                            .friction_angle = {46 * 3.14159265358979323846 / 180, 0},
                                                            .shear_modulus = {0.018, 0},
                                                            .stress_angle_c1 = {0.4, 0},
                                                            .stress_angle_c2 = {0.2, 0}};
  soilbin::OperatingCondition at;
  at.load = 40;
  at.slip = 0.6;
  const soilbin::TractionResult result = soilbin::bekker_wong::BekkerWong().evaluate(scenario, at);
  std::printf("drawbar pull %.4f N\n", result.drawbar_pull.value);

  using namespace soilbin::bekker_wong;
  const RollingWheel wheel(scenario.tire, values_of(*scenario.soil.semi_empirical), make_effects(scenario.effects));
  const RolledWheel now = wheel.roll(at);  // at each step
  std::printf("%.4f N, %.4f N m, %.4f m\n", now.reading.drawbar_pull, now.reading.torque, now.reading.sinkage);
  return std::abs(result.drawbar_pull.value - 11.7861) < 5e-5 && now.reading.drawbar_pull == result.drawbar_pull.value
             ? 0
             : 1;
}
