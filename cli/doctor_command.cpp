// soilbin doctor: what this program was built from, where its library is, and whether it still gets published numbers.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bekker_wong/rolling_wheel.hpp"
#include "cli/commands.hpp"
#include "cli/versions.hpp"
#include "compare/report/result_json.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cli {
namespace {

using bekker_wong::SoilValues;

/// A published operating point and what it gives.
struct Published {
  const char* name;
  SoilValues soil;
  double radius, width, load, slip;
  double sinkage, drawbar_pull, torque;  ///< [m], [N], [N m]
  double tolerance;                      ///< relative: half a unit of the digits published
};

const std::vector<Published>& published() {
  static const std::vector<Published> all = {
      {"a light wheel at 60 % slip, two public codes",
       {.exponent = 1,
        .k_c = 1.4e3,
        .k_phi = 8.2e5,
        .cohesion = 170,
        .friction_angle = 46 * degree,
        .shear_modulus = 0.018,
        .c1 = 0.4,
        .c2 = 0.2},
       0.1,
       0.1,
       40,
       0.6,
       17.789e-3,
       11.7861,
       2.3489,
       3e-5},
      {"Ishigami et al. 2007, its inputs",
       {.exponent = 1,
        .k_c = 1370,
        .k_phi = 8.14e5,
        .cohesion = 800,
        .friction_angle = 37.2 * degree,
        .shear_modulus = 0.036,
        .c1 = 0.4,
        .c2 = 0.15},
       0.09,
       0.11,
       64.68,
       0.2,
       23.7341e-3,
       -9.11318,
       1.275805,
       3e-6},
      {"Azimi et al. 2013, its inputs",
       {.exponent = 0.8,
        .k_c = 0,
        .k_phi = 4.1e5,
        .cohesion = 234,
        .friction_angle = 30 * degree,
        .shear_modulus = 0.013,
        .c1 = 0.18,
        .c2 = 0.32},
       0.15,
       0.1,
       165,
       0.2,
       31.7033e-3,
       15.6228,
       9.42284,
       5e-6},
  };
  return all;
}

/// Largest relative difference of the three results.
double difference(const Published& point) {
  Tire tire;
  tire.radius = point.radius, tire.width = point.width;
  OperatingCondition at;
  at.load = point.load, at.slip = point.slip;
  const bekker_wong::Reading r = bekker_wong::RollingWheel(tire, point.soil).roll(at).reading;
  const auto relative = [](double value, double expected) { return std::abs(value / expected - 1); };
  return std::max({relative(r.sinkage, point.sinkage), relative(r.drawbar_pull, point.drawbar_pull),
                   relative(r.torque, point.torque)});
}

int doctor(bool json, const Session& session) {
  const Library& library = session.place.library;
  nlohmann::ordered_json document = {{"format", "soilbin-doctor/1"}};
  for (const auto& [name, version] : versions()) document["versions"][name] = version;
  document["library"] = nlohmann::ordered_json::array();
  for (const auto& folder : session.place.folders) document["library"].push_back(folder.string());
  std::string text;
  for (const auto& [name, version] : versions()) text += fmt::format("  {:<14}{}\n", name, version);
  text += "\nLibrary of cases (searched in this order; $SOILBIN_CASES goes first)\n";
  for (const auto& folder : session.place.folders) text += "  " + folder.string() + "\n";
  bool well = !session.place.folders.empty();
  if (!well) text += "  not found: set SOILBIN_CASES to a folder with tires/, soils/ and studies/\n";
  for (const Shelf shelf : {Shelf::tires, Shelf::soils, Shelf::studies, Shelf::measured})
    text += fmt::format("  {} {}\n", library.names(shelf).size(), folder_of(shelf));
  text += "\nSelf-test against published numbers\n";
  for (const Published& point : published()) {
    const double off = difference(point);
    const bool pass = off <= point.tolerance;
    well = well && pass;
    text += fmt::format("  {}  {} (differs by {:.1e}, allowed {:.1e})\n", pass ? "pass" : "FAIL", point.name, off,
                        point.tolerance);
    document["self_test"].push_back({{"name", point.name}, {"difference", off}, {"pass", pass}});
  }
  document["well"] = well;
  if (json)
    fmt::print("{}", compare::json_text(document));
  else
    fmt::print("{}\n{}\n", text, well ? "All is well." : "Something is wrong: see above.");
  return well ? done : failed;
}

}  // namespace

void add_doctor(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("doctor", "versions, where the library is, and a self-test");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "as JSON");
  command->callback([=, &session] { session.action = [=, &session] { return doctor(*json, session); }; });
}

}  // namespace soilbin::cli
