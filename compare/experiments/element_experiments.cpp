#include "compare/experiments/element_experiments.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using Eigen::VectorXd;

GranularSoil with_values(const ElementExperiment& experiment, ContactKind kind, const VectorXd& values) {
  GranularSoil soil = experiment.soil;
  put_values(soil, kind, experiment.factors, values);
  return soil;
}

/// A text of everything that an experiment follows from, a line a value, in full precision.
class Identity {
 public:
  explicit Identity(const std::string& kind) : text_(kind) {}
  Identity& add(const char* name, double value) {
    text_ += fmt::format("\n{} {}", name, value);
    return *this;
  }
  Identity& add(const char* name, const char* word) {
    text_ += fmt::format("\n{} {}", name, word);
    return *this;
  }
  Identity& add(const char* name, const ContactPair& pair) {
    add(name, pair.restitution).add("", pair.sliding_friction).add("", pair.rolling_friction).add("", pair.cohesion);
    add("rolling_damping", pair.rolling_damping);
    if (pair.rolling_stiffness > 0) add("rolling_stiffness", pair.rolling_stiffness);
    return pair.work_of_adhesion > 0 ? add("work_of_adhesion", pair.work_of_adhesion) : *this;
  }
  Identity& add(const dem::ContactLaws& laws) {
    return add("laws", static_cast<int>(laws.normal))
        .add("", static_cast<int>(laws.rolling))
        .add("", static_cast<int>(laws.cohesion))
        .add("", laws.tangential_damping)
        .add("twisting", static_cast<int>(laws.twisting));
  }
  /// The soil of an experiment; its varied numbers are set to 0.
  Identity& add(const ElementExperiment& experiment, ContactKind kind) {
    const VectorXd none = VectorXd::Zero(static_cast<Eigen::Index>(experiment.factors.size()));
    const GranularSoil soil = with_values(experiment, kind, none);
    add("radius_min", soil.radius_min).add("radius_max", soil.radius_max).add("density", soil.grain_density);
    for (const GrainFraction& fraction : soil.sizes) add("size", fraction.radius).add("share", fraction.share);
    if (soil.shape != GrainShape::sphere)
      add("shape", static_cast<int>(soil.shape)).add("sphere_spacing", soil.sphere_spacing);
    add("young", soil.youngs_modulus).add("poisson", soil.poisson_ratio).add("grain_grain", soil.grain_grain);
    return kind == ContactKind::grain_tire ? add("grain_tire", soil.grain_tire) : *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

VirtualTest test_of(const ElementExperiment& experiment, std::string identity) {
  VirtualTest test;
  test.identity = std::move(identity);
  test.factors = experiment.factors;
  test.targets = experiment.targets;
  return test;
}

/// Each seed of an experiment has packings of its own.
std::uint64_t first_packing(std::uint64_t seed, int packings) {
  return 1 + (seed - 1) * static_cast<std::uint64_t>(packings);
}

/// A run that the engine had to stop is an experiment without an answer.
std::vector<Estimate> answered(const auto& run) {
  try {
    return run();
  } catch (const dem::RunStopped& stopped) {
    throw NoSolution(stopped.what());
  }
}

/// The directional rolling couple lets a grain creep down the board at a speed that goes with the step, since it stops
/// its rotation a step late. With sliding and rolling friction of 0.75 (atan: 36.9 deg) the onset comes at 30.3 deg
/// with a quarter of the longest step, 37.1 with an eighth and 37.4 with a sixteenth; elastic_plastic: 37.5 with a
/// quarter (paper-sand).
double board_step(const GranularSoil& soil) {
  const bool directional = soil.rolling_resistance == RollingResistance::directional ||
                           soil.rolling_resistance == RollingResistance::directional_with_twist;
  return dem::longest_step(soil) / (directional ? 8 : 4);
}

/// What makes a specimen of sand on sand, and what is asked of it.
Identity identity_of(const char* name, const ElementExperiment& experiment, const auto& settings, Strength strength) {
  Identity identity(fmt::format("{}, {}", name, strength == Strength::peak ? "peak" : "residual"));
  identity.add(experiment, ContactKind::grain_grain).add(settings.specimen.laws);
  identity.add("settling_friction", settings.specimen.settling_friction).add("dt", settings.specimen.dt);
  identity.add("packings", settings.packings).add("inertial", settings.inertial);
  identity.add("residual_share", settings.residual_share).add("peak_window", settings.peak_window);
  for (const double stress : settings.stresses) identity.add("stress", stress);
  if (experiment.soil.gravity) identity.add("gravity", *experiment.soil.gravity);
  return identity;
}

/// The sides of a specimen.
void add_sides(Identity& identity, const dem::DirectShearSettings& box) {
  identity.add("length", box.length).add("width", box.width).add("height", box.height);
  identity.add("travel", box.travel).add("normal stress", "held on the plane that is left");
}
void add_sides(Identity& identity, const dem::TriaxialSettings& cell) {
  identity.add("side", cell.side).add("height", cell.height).add("strain", cell.strain);
}

dem::DirectShearResult answer_of(const GranularSoil& soil, const dem::DirectShearSettings& box,
                                 const dem::WorkOptions& how) {
  return dem::direct_shear(soil, box, how);
}
dem::TriaxialResult answer_of(const GranularSoil& soil, const dem::TriaxialSettings& cell,
                              const dem::WorkOptions& how) {
  return dem::triaxial(soil, cell, how);
}

/// Sand on sand: a test of strength under several stresses; knows the targets friction_angle and cohesion. A seed gives
/// packings of its own.
template <class Settings>
VirtualTest strength_test(const char* name, const ElementExperiment& experiment, const Settings& settings,
                          Strength strength) {
  Identity identity = identity_of(name, experiment, settings, strength);
  add_sides(identity, settings);
  VirtualTest test = test_of(experiment, identity.text());
  test.run = [=](const VectorXd& values, std::uint64_t seed) {
    return answered([&] {
      Settings own = settings;
      own.specimen.packing = first_packing(seed, settings.packings);
      const auto result = answer_of(with_values(experiment, ContactKind::grain_grain, values), own, experiment.how);
      const dem::StrengthLine& line = strength == Strength::peak ? result.peak : result.residual;
      std::vector<Estimate> answer;
      for (const Target& target : experiment.targets)
        answer.push_back(target.name == "cohesion" ? line.cohesion : line.friction_angle);
      return answer;
    });
  };
  return test;
}

/// "settling_friction" where all tests are of one density; else with the first test of these.
std::string settling_factor_of(const std::vector<CompressionCurve>& all, const std::vector<CompressionCurve>& alike) {
  const std::string name = settling_friction_factor;
  return alike.size() == all.size() ? name : name + "." + alike.front().test;
}

template <class Settings>
Settings specimen_settings(const GranularSoil& granular, const ContactQuestion& question) {
  Settings settings;
  settings.packings = question.packings > 0 ? question.packings : 1;
  settings.specimen.settling_friction = question.settling_friction;
  static_cast<dem::LawFlags&>(settings.specimen.laws) = dem::laws_of(granular);
  settings.stresses = question.stresses;
  return settings;
}

/// Tire on sand: the tilting board; knows the target board_angle. Mean and standard error over `packings` boards, at
/// least two.
VirtualTest tilting_board_test(const ElementExperiment& experiment, const dem::TiltingBoardSettings& settings,
                               int packings) {
  if (packings < 2) throw InputError("packings: an angle with an error needs at least two boards");
  Identity identity("tilting board");
  identity.add(experiment, ContactKind::grain_tire).add(settings.laws).add("packings", packings);
  identity.add("across", settings.across).add("layers", settings.layers).add("rate", settings.rate);
  identity.add("onset", settings.onset).add("gone", settings.gone).add("steepest", settings.steepest);
  identity.add("dt", settings.dt).add("gravity", dem::gravity_on(experiment.soil));
  VirtualTest test = test_of(experiment, identity.text());
  test.run = [=](const VectorXd& values, std::uint64_t seed) {
    return answered([&] {
      std::vector<double> angles;
      for (int k = 0; k < packings; ++k) {
        dem::TiltingBoardSettings own = settings;
        own.packing = first_packing(seed, packings) + static_cast<std::uint64_t>(k);
        const dem::TiltingBoardResult result =
            dem::tilting_board(with_values(experiment, ContactKind::grain_tire, values), own, experiment.how);
        if (!result.slid) throw NoSolution("the sand holds up to the steepest tilt");
        angles.push_back(result.onset);
      }
      return std::vector<Estimate>{mean_of(angles)};
    });
  };
  return test;
}

/// Measured specimens of one density, and how grains are pressed as they were.
struct AlikeSpecimens {
  std::vector<CompressionCurve> tests;
  dem::TriaxialSettings settings;
  std::string settling;  ///< name of the factor by which they settle
};

/// Each target that is a feature of these specimens.
void add_answers(std::vector<Estimate>& answers, const std::vector<Target>& targets, const AlikeSpecimens& specimens,
                 const std::vector<dem::TriaxialRun>& runs) {
  for (const CompressionCurve& test : specimens.tests)
    for (int k = 0; k < curve_features; ++k) {
      const auto feature = static_cast<CurveFeature>(k);
      const auto target = std::ranges::find(targets, target_name(feature, test), &Target::name);
      if (target != targets.end()) answers[target - targets.begin()] = simulated(feature, test, runs);
    }
}

/// What follows from the measured tests alone. Those of one density are told in their file's order.
void add_tests(Identity& identity, const std::vector<AlikeSpecimens>& densities) {
  for (const AlikeSpecimens& specimens : densities) {
    if (densities.size() > 1) identity.add(specimens.settling.c_str(), "settled apart");
    for (const CompressionCurve& test : specimens.tests)
      identity.add(test.test.c_str(), test.confining).add("until", test.strain.back());
  }
}

/// Sand on sand: the cell at the pressures of measured tests, as far as they go, the specimens of each density settled
/// apart. A target is a feature of one of the tests.
VirtualTest curve_test(const ElementExperiment& experiment, const ContactQuestion& question) {
  const auto usual = specimen_settings<dem::TriaxialSettings>(experiment.soil, question);
  std::vector<AlikeSpecimens> densities;
  for (const auto& tests : by_density(question.curves))
    densities.push_back({tests, pressed_as(tests, usual), settling_factor_of(question.curves, tests)});
  const dem::TriaxialSettings all = pressed_as(question.curves, usual);
  Identity identity = identity_of("triaxial curves", experiment, all, Strength::peak);
  add_sides(identity, all);
  identity.add("samples", all.samples);
  add_tests(identity, densities);
  VirtualTest test = test_of(experiment, identity.text());
  test.run = [=](const VectorXd& values, std::uint64_t seed) {
    return answered([&] {
      const GranularSoil soil = with_values(experiment, ContactKind::grain_grain, values);
      std::vector<Estimate> answers(experiment.targets.size());
      for (const AlikeSpecimens& specimens : densities) {
        dem::TriaxialSettings own = specimens.settings;
        own.specimen.packing = first_packing(seed, own.packings);
        const auto settling = std::ranges::find(experiment.factors, specimens.settling, &Factor::name);
        if (settling != experiment.factors.end())
          own.specimen.settling_friction = values[settling - experiment.factors.begin()];
        add_answers(answers, experiment.targets, specimens, dem::triaxial(soil, own, experiment.how).runs);
      }
      return answers;
    });
  };
  return test;
}

/// Sand on sand: plates on a bed, pressed as measured ones were. The targets are pressures at points of these.
VirtualTest plate_test(const ElementExperiment& experiment, const ContactQuestion& question) {
  const std::vector<PlatePoint> points = points_of(question.plates);
  const std::vector<Target> all = targets_of(question.plates, points);
  dem::PlateSettings settings = pressed_as(points, experiment.soil, {});
  settings.bed.specimen.settling_friction = question.settling_friction;
  static_cast<dem::LawFlags&>(settings.bed.specimen.laws) = dem::laws_of(experiment.soil);
  const int packings = question.packings > 0 ? question.packings : 1;
  Identity identity("plates");
  identity.add(experiment, ContactKind::grain_grain).add(settings.bed.specimen.laws);
  identity.add("settling_friction", question.settling_friction).add("packings", packings);
  identity.add("width", settings.bed.width).add("depth", settings.bed.depth).add("speed", settings.speed);
  for (const double diameter : settings.diameters) identity.add("plate", diameter);
  identity.add("sinkage", settings.sinkage).add("samples", settings.samples);
  identity.add("gravity", dem::gravity_on(experiment.soil));
  VirtualTest test = test_of(experiment, identity.text());
  test.run = [=](const VectorXd& values, std::uint64_t seed) {
    return answered([&] {
      const GranularSoil soil = with_values(experiment, ContactKind::grain_grain, values);
      const auto settling = std::ranges::find(experiment.factors, settling_friction_factor, &Factor::name);
      std::vector<dem::PlateRun> runs;
      for (int k = 0; k < packings; ++k) {
        dem::PlateSettings own = settings;
        own.bed.specimen.packing = first_packing(seed, packings) + static_cast<std::uint64_t>(k);
        if (settling != experiment.factors.end())
          own.bed.specimen.settling_friction = values[settling - experiment.factors.begin()];
        for (dem::PlateRun& run : dem::plate_sinkage(soil, own, experiment.how)) runs.push_back(std::move(run));
      }
      std::vector<Estimate> answers;
      for (const Target& target : experiment.targets)
        answers.push_back(simulated(points[std::ranges::find(all, target.name, &Target::name) - all.begin()], runs));
      return answers;
    });
  };
  return test;
}

}  // namespace

VirtualTest contact_test(const Soil& soil, const ContactQuestion& question) {
  const GranularSoil& granular = grains_of(soil);
  const ElementExperiment experiment{granular, question.factors, question.targets, question.how};
  if (question.kind == ContactKind::grain_tire) {
    dem::TiltingBoardSettings settings;
    settings.across = question.across;
    static_cast<dem::LawFlags&>(settings.laws) = dem::laws_of(granular);
    settings.dt = board_step(granular);
    return tilting_board_test(experiment, settings, question.packings > 0 ? question.packings : 4);
  }
  if (!question.curves.empty()) return curve_test(experiment, question);
  if (question.test == SandTest::plate) return plate_test(experiment, question);
  if (question.test == SandTest::triaxial)
    return strength_test("triaxial", experiment, specimen_settings<dem::TriaxialSettings>(granular, question),
                         question.strength);
  return strength_test("direct shear", experiment, specimen_settings<dem::DirectShearSettings>(granular, question),
                       question.strength);
}

std::vector<Target> targets_of(const Soil& soil, ContactKind kind) {
  if (kind == ContactKind::grain_tire)
    throw InputError(
        "what did the board measure?\n  hint: --target board_angle=31.47deg, or with its error --target "
        "board_angle=31.47deg,0.5deg");
  if (!soil.semi_empirical)
    throw InputError("the soil gives no friction angle and cohesion to reach\n  hint: --target friction_angle=31deg");
  std::vector<Target> targets;
  if (soil.semi_empirical->friction_angle.value > 0)
    targets.push_back({"friction_angle", soil.semi_empirical->friction_angle, "deg"});
  if (soil.semi_empirical->cohesion.value > 0) targets.push_back({"cohesion", soil.semi_empirical->cohesion, "kPa"});
  return targets;
}

std::vector<std::string> target_names(ContactKind kind) {
  if (kind == ContactKind::grain_tire) return {"board_angle"};
  return {"friction_angle", "cohesion"};
}

std::string unit_of_target(const std::string& name) { return name == "cohesion" ? "kPa" : "deg"; }

std::vector<Factor> usual_factors(ContactKind kind) {
  if (kind == ContactKind::grain_tire)
    return {{"restitution", 0.3, 0.7, "-"}, {"sliding_friction", 0.3, 0.9, "-"}, {"rolling_friction", 0.1, 0.7, "-"}};
  return {{"sliding_friction", 0.1, 0.9, "-"}, {"rolling_friction", 0.0, 0.5, "-"}, {"cohesion", 0.0, 1e6, "kJ/m^3"}};
}

std::vector<Factor> usual_factors(ContactKind kind, const GranularSoil& soil) {
  std::vector<Factor> factors = usual_factors(kind);
  // A contact of mean grains then bears (3/2) pi w R* = 1.2 w d at most, so a layer of them some 1.2 w/d (chosen).
  constexpr double most_strength = 10e3;  // [Pa]
  if (soil.cohesion_law == GrainCohesion::jkr)
    for (Factor& factor : factors)
      if (factor.name == "cohesion") factor = {"work_of_adhesion", 0.0, most_strength * mean_diameter(soil), "J/m^2"};
  return factors;
}

std::vector<Factor> usual_factors_of_curves(const std::vector<CompressionCurve>& tests) {
  std::vector<Factor> factors{
      {"sliding_friction", 0.2, 0.9, "-"}, {"rolling_friction", 0.0, 0.6, "-"}, {"youngs_modulus", 2e9, 40e9, "GPa"}};
  for (const auto& alike : by_density(tests)) factors.push_back({settling_factor_of(tests, alike), 0.0, 1.0, "-"});
  return factors;
}

std::vector<Factor> usual_factors_of_plates(const GranularSoil& soil) {
  std::vector<Factor> factors = usual_factors(ContactKind::grain_grain, soil);
  factors.push_back({settling_friction_factor, 0.0, 1.0, "-"});
  return factors;
}

}  // namespace soilbin::compare
