// Time of one operating point, all four results: driven, yawed, braked, and driven with two effects switched on.
// 'operating_point --values' prints the results instead, for the peer to be compared with (see run).
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

struct Point {
  std::string kind;
  Tire tire;
  SoilValues soil;
  OperatingCondition at;
};

std::vector<Point> read_points() {
  std::ifstream file(SOILBIN_POINTS);
  std::string line;
  std::getline(file, line);  // kind, radius, width, n, k_c, k_phi, c, phi [deg], K, c1, c2, load, slip, yaw [deg]
  std::vector<Point> points;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    Point p;
    std::getline(row, p.kind, ',');
    const auto next = [&] {
      std::string cell;
      std::getline(row, cell, ',');
      return std::stod(cell);
    };
    p.tire.radius = next(), p.tire.width = next();
    p.soil.exponent = next(), p.soil.k_c = next(), p.soil.k_phi = next(), p.soil.cohesion = next();
    p.soil.friction_angle = next() * degree, p.soil.shear_modulus = next(), p.soil.c1 = next(), p.soil.c2 = next();
    p.at.load = next(), p.at.slip = next(), p.at.yaw = next() * degree;
    points.push_back(p);
  }
  return points;
}

void roll_points(benchmark::State& state, const std::string& kind, const EffectList& effects) {
  std::vector<RollingWheel> wheels;
  std::vector<OperatingCondition> conditions;
  for (const Point& p : read_points()) {
    if (p.kind != kind) continue;
    wheels.emplace_back(p.tire, p.soil, effects);
    conditions.push_back(p.at);
  }
  for (auto _ : state)
    for (std::size_t i = 0; i < wheels.size(); ++i) benchmark::DoNotOptimize(wheels[i].roll(conditions[i]).reading);
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(wheels.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

EffectList two_effects() {
  return make_effects({{"exit_angle", "rebound", {{"lambda", 0.3}}}, {"interface_limit", "", {}}});
}

BENCHMARK_CAPTURE(roll_points, driven, std::string("driven"), EffectList{});
BENCHMARK_CAPTURE(roll_points, yawed, std::string("yawed"), EffectList{});
BENCHMARK_CAPTURE(roll_points, braked, std::string("braked"), EffectList{});
BENCHMARK_CAPTURE(roll_points, driven_with_effects, std::string("driven"), two_effects());

void print_values() {
  fmt::print("kind,sinkage,drawbar_pull,torque,lateral_force\n");
  for (const Point& p : read_points()) {
    const Reading r = RollingWheel(p.tire, p.soil).roll(p.at).reading;
    fmt::print("{},{:.17g},{:.17g},{:.17g},{:.17g}\n", p.kind, r.sinkage, r.drawbar_pull, r.torque, r.lateral_force);
  }
}

}  // namespace
}  // namespace soilbin::bekker_wong

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--values") {
    soilbin::bekker_wong::print_values();
    return EXIT_SUCCESS;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
