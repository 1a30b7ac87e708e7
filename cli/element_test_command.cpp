// soilbin element-test: what a soil's grains do in the laboratory's tests.
#include <fmt/core.h>

#include <functional>
#include <memory>

#include "cli/commands.hpp"
#include "cli/element_test_flags.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "compare/telling/reports.hpp"
#include "dem/element_tests/angle_of_repose.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

struct ElementTestOptions {
  std::string test, soil;
  OutputFlags outputs;
  std::vector<std::string> stresses;
  int packings = 0;  ///< 0: as many as the test usually has
  double inertial = 0;
  bool ledger = false;
  ElementTestFlags flags;
  PlateFlags plates;
  ConeFlags cone;
  MeasuredFlags measured;
};

struct AskedTest {
  const ElementTestOptions& options;
  const std::string& soil;  ///< its name
  const GranularSoil& grains;
  dem::SpecimenSettings specimen;
  dem::WorkOptions how;
  dem::BedStore& beds;
  int packings;
};

/// The stresses given, else those of the test.
std::vector<double> stresses_of(const ElementTestOptions& options, std::vector<double> otherwise) {
  if (options.stresses.empty()) return otherwise;
  std::vector<double> out;
  for (const std::string& text : options.stresses) out.push_back(read_flag("--stress", text, {"kPa", above_zero}));
  return out;
}

template <class Settings>
Settings strength_settings(const AskedTest& asked, std::initializer_list<double Settings::*> sides) {
  Settings s;
  s.specimen = asked.specimen, s.packings = asked.packings, s.ledger = asked.options.ledger;
  s.stresses = stresses_of(asked.options, s.stresses);
  for (double Settings::*side : sides) s.*side *= asked.options.flags.size;
  if (asked.options.inertial > 0) s.inertial = asked.options.inertial;
  return s;
}

compare::Report direct_shear(const AskedTest& asked) {
  using S = dem::DirectShearSettings;
  const S settings = strength_settings<S>(asked, {&S::length, &S::width, &S::height});
  return compare::report_on(dem::direct_shear(asked.grains, settings, asked.how, &asked.beds), asked.soil);
}

compare::Report triaxial(const AskedTest& asked) {
  using S = dem::TriaxialSettings;
  S settings = strength_settings<S>(asked, {&S::side, &S::height});
  std::vector<compare::CompressionCurve> measured;
  if (asked.options.measured.given()) measured = asked.options.measured.triaxial();
  if (!measured.empty()) settings = compare::pressed_as(measured, settings);
  const dem::TriaxialResult result = dem::triaxial(asked.grains, settings, asked.how, &asked.beds);
  return compare::report_on(result, asked.soil, compare::beside_measured(std::move(measured), result.runs));
}

template <class Result>
std::vector<Result> each_packing(const AskedTest& asked,
                                 const std::function<std::vector<Result>(const dem::SpecimenSettings&)>& run) {
  std::vector<Result> all;
  dem::SpecimenSettings specimen = asked.specimen;
  for (int k = 0; k < asked.packings; ++k, ++specimen.packing)
    for (Result& result : run(specimen)) all.push_back(std::move(result));
  return all;
}

compare::Report tilting_board(const AskedTest& asked) {
  dem::TiltingBoardSettings s;
  s.laws = asked.specimen.laws;
  s.across = static_cast<int>(std::lround(s.across * asked.options.flags.size));
  const auto run = [&](const dem::SpecimenSettings& specimen) {
    s.packing = specimen.packing;
    return std::vector{dem::tilting_board(asked.grains, s, asked.how)};
  };
  return compare::report_on(each_packing<dem::TiltingBoardResult>(asked, run), asked.soil);
}

compare::Report repose(const AskedTest& asked) {
  dem::AngleOfReposeSettings s;
  s.packing = asked.specimen.packing, s.laws = asked.specimen.laws;
  s.radius *= asked.options.flags.size, s.height *= asked.options.flags.size;
  if (asked.options.flags.size == 1) s.lowest = dem::lowest_heap;
  return compare::report_on(dem::heaps_of_repose(asked.grains, s, asked.packings, asked.how), asked.soil);
}

compare::Report plate(const AskedTest& asked) {
  dem::PlateSettings s = asked.options.plates.plates(asked.grains);
  std::vector<compare::MeasuredPlate> measured;
  std::vector<compare::PlatePoint> points;
  if (asked.options.measured.given()) {
    measured = asked.options.measured.plates();
    points = compare::points_of(measured, asked.options.plates.deepest());
    s = compare::pressed_as(points, asked.grains, s);
  }
  s.bed.width *= asked.options.flags.size, s.bed.depth *= asked.options.flags.size;
  const auto run = [&](const dem::SpecimenSettings& specimen) {
    s.bed.specimen = specimen;
    return dem::plate_sinkage(asked.grains, s, asked.how, &asked.beds);
  };
  const std::vector<dem::PlateRun> runs = each_packing<dem::PlateRun>(asked, run);
  return compare::report_on(runs, asked.soil, compare::beside_measured(std::move(measured), points, runs));
}

compare::Report cone(const AskedTest& asked) {
  dem::ConeSettings s = asked.options.cone.cone(asked.grains);
  s.bed.width *= asked.options.flags.size, s.bed.depth *= asked.options.flags.size;
  const auto run = [&](const dem::SpecimenSettings& specimen) {
    s.bed.specimen = specimen;
    return std::vector{dem::cone_penetration(asked.grains, s, asked.how, &asked.beds)};
  };
  return compare::report_on(each_packing<dem::ConeRun>(asked, run), asked.soil, mean_diameter(asked.grains));
}

compare::Report shear(const AskedTest& asked) {
  dem::AnnulusSettings s;
  s.stresses = stresses_of(asked.options, s.stresses);
  s.bed.width *= asked.options.flags.size, s.bed.depth *= asked.options.flags.size;
  const auto run = [&](const dem::SpecimenSettings& specimen) {
    s.bed.specimen = specimen;
    return dem::annular_shear(asked.grains, s, asked.how, &asked.beds);
  };
  return compare::report_on(each_packing<dem::AnnulusRun>(asked, run), asked.soil);
}

struct Test {
  const char* name;
  compare::Report (*run)(const AskedTest&);
  bool takes_specimens = false, takes_stresses = takes_specimens, takes_plates = false;
  bool takes_cone = false, takes_curves = false;
  bool takes_settling = takes_stresses || takes_plates || takes_cone;
  int packings = 1;  ///< where none are asked for: of quick tests enough to tell what they scatter
};
constexpr Test tests[] = {{.name = "direct-shear", .run = direct_shear, .takes_specimens = true},
                          {.name = "tilting-board", .run = tilting_board, .packings = 3},
                          {.name = "repose", .run = repose, .packings = 3},
                          {.name = "triaxial", .run = triaxial, .takes_specimens = true, .takes_curves = true},
                          {.name = "plate", .run = plate, .takes_plates = true, .takes_curves = true},
                          {.name = "cone", .run = cone, .takes_cone = true},
                          {.name = "shear", .run = shear, .takes_stresses = true}};

const Test& test_of(const std::string& name) {
  std::vector<std::string> names;
  for (const Test& test : tests) {
    if (name == test.name) return test;
    names.emplace_back(test.name);
  }
  throw InputError(fmt::format("unknown test '{}'{}\n  hint: tests are {}", clipped(name), did_you_mean(name, names),
                               listed(names)));
}

/// Throws InputError for a flag that would change nothing.
void check_flags(const ElementTestOptions& options, const Test& asked) {
  const auto only = [&](const char* flag, bool given, bool Test::*takes) {
    if (!given || asked.*takes) return;
    std::vector<std::string> names;
    for (const Test& test : tests)
      if (test.*takes) names.emplace_back(test.name);
    throw InputError(fmt::format("the test {} takes no {}\n  hint: {} {}", asked.name, flag, listed(names),
                                 names.size() > 1 ? "do" : "does"));
  };
  only("--stress", !options.stresses.empty(), &Test::takes_stresses);
  only("--curves", options.measured.given(), &Test::takes_curves);
  if (options.measured.given() && !options.stresses.empty())
    throw InputError("--stress has no effect beside --curves, whose tests tell it\n  hint: leave out one of the two");
  if (options.measured.given() && !options.plates.diameters.empty())
    throw InputError("--plate has no effect beside --curves, whose tests tell it\n  hint: leave out one of the two");
  only("--inertial", options.inertial != 0, &Test::takes_specimens);
  only("--ledger", options.ledger, &Test::takes_specimens);
  only("--settling-friction", !options.flags.settling_friction.empty(), &Test::takes_settling);
  only("--plate", !options.plates.diameters.empty(), &Test::takes_plates);
  only("--plate-sinkage", !options.plates.sinkage.empty(), &Test::takes_plates);
  only("--cone", !options.cone.diameter.empty(), &Test::takes_cone);
  only("--cone-depth", !options.cone.depth.empty(), &Test::takes_cone);
}

int element_test(const ElementTestOptions& options, const Session& session) {
  const Test& test = test_of(options.test);
  if (options.inertial < 0) throw InputError("--inertial: above 0");
  check_flags(options, test);
  const Soil soil = find_soil(options.soil, session.place.library);
  dem::BedStore beds(folder_of_beds());
  const compare::Report report =
      test.run({options, soil.name, grains_of(soil), options.flags.specimen(grains_of(soil)), options.flags.work(),
                beds, options.packings > 0 ? options.packings : test.packings});
  clear_progress_line();
  return publish(report, options.outputs, options.flags.doubts(grains_of(soil)), session).status(done);
}

}  // namespace

void add_element_test(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "element-test", "test a soil's grains as a laboratory does: shear box, triaxial cell, plates ...");
  const auto options = std::make_shared<ElementTestOptions>();
  add_value(*command, "test", options->test, "TEST",
            "direct-shear, tilting-board, repose, triaxial, plate, cone or shear")
      ->required();
  add_value(*command, "soil", options->soil, "SOIL", "a soil of the library, or a YAML file")->required();
  add_repeatable(*command, "--stress", options->stresses, "STRESS", "normal or confining stress; may be given again");
  add_value(*command, "--packings", options->packings, "N",
            "number of specimens, of the seeds from --packing on; 1, of tilting-board and repose 3")
      ->check(whole_number(1, compare::most_packings));
  add_value(*command, "--inertial", options->inertial, "I",
            "direct-shear, triaxial: inertial number of the rate, 0.001");
  command->add_flag("--ledger", options->ledger, "direct-shear, triaxial: check the balance of energy (in --json)");
  options->outputs.add_to(*command, {.json = "soilbin-element-test/1, in SI", .plot = "draw the curves"});
  options->flags.add_to(*command);
  options->plates.add_to(*command);
  options->cone.add_to(*command);
  options->measured.add_to(*command,
                           "triaxial, plate: measured tests, whose pressures the cell, or whose plates the bed gets; "
                           "told beside the grains");
  command->footer("Example: soilbin element-test direct-shear paper-sand --stress 10kPa --stress 40kPa --plot box.svg");
  command->callback([=, &session] { session.action = [=, &session] { return element_test(*options, session); }; });
}

}  // namespace soilbin::cli
