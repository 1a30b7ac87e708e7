// soilbin mobility: does a wheeled vehicle get through soft fine-grained soil, by cone indices.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/described_flags.hpp"
#include "cli/outputs.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/telling/reports.hpp"
#include "cone_index/vehicle.hpp"
#include "scenario/case.hpp"

namespace soilbin::cli {
namespace {

using cone_index::Vehicle;

constexpr const char* mobility_example =
    "soilbin mobility --weight 59.8kN --axles 2 --tires 4 --tire hmmwv --clearance 442mm --power 142kW "
    "--rating-cone-index '300+-30 kPa'";

struct MobilityOptions {
  std::string file, tire, soil, rating, remolding;
  DescribedFlags<Vehicle> vehicle;
  OutputFlags outputs;
};

/// Throws InputError that names the flags of what a vehicle without a file lacks.
void check_given(const MobilityOptions& options) {
  std::vector<std::string> missing;
  for (const char* key : {"weight", "axles", "tires", "tire_width", "tire_diameter", "clearance", "power"}) {
    const bool of_tire = std::string_view(key).starts_with("tire_");
    if (!options.vehicle.given(key) && !(of_tire && !options.tire.empty())) missing.push_back(flag_of("", key));
  }
  if (!missing.empty())
    throw InputError(fmt::format("a vehicle is its file, or its numbers as flags: {} {} missing", listed(missing),
                                 missing.size() == 1 ? "is" : "are"));
}

Vehicle vehicle_of(const MobilityOptions& options, const Session& session) {
  Vehicle vehicle;
  if (options.file.empty()) {
    check_given(options);
  } else {
    if (names_a_vehicle(session.place, options.file))
      throw InputError(fmt::format(
          "'{0}' is a vehicle on a soil, which tells no clearance: a vehicle cone index needs one\n  hint: soilbin "
          "vehicle {0} asks that; here a file of soilbin-vehicle/1 or flags, such as {1}",
          options.file, mobility_example));
    vehicle = cone_index::parse_vehicle(read_source_text(options.file, largest_yaml));
    if (vehicle.name.empty()) vehicle.name = std::filesystem::path(options.file).stem().string();
  }
  if (!options.tire.empty()) {
    const Tire tire = find_tire(options.tire, session.place.library);
    vehicle.tire_width = tire.width, vehicle.tire_diameter = 2 * outer_radius(tire);
    vehicle.section_height = tire.section_height;
  }
  options.vehicle.apply(vehicle);
  return vehicle;
}

/// A rating cone index [Pa], and the name of the soil that it is of.
struct Rating {
  std::optional<Estimate> value;
  std::string soil{};
  bool is_cone_index = false;
};

Rating rating_of(const MobilityOptions& options, const Session& session) {
  Rating rating;
  if (!options.rating.empty()) {
    rating.value = read_estimate_flag("--rating-cone-index", options.rating, {"kPa", above_zero}, std::nullopt);
  } else if (!options.soil.empty()) {
    const Soil soil = find_soil(options.soil, session.place.library);
    if (!soil.cone_index)
      throw InputError(fmt::format("soil '{}' has no 'cone_index'{}\n  hint: --rating-cone-index tells one", soil.name,
                                   soil.cone_index_gradient
                                       ? ": as a sand it has a gradient, and VCI1 and VCI50 are of fine-grained soil"
                                       : ""));
    rating = {soil.cone_index, soil.name, options.remolding.empty()};
    if (!options.remolding.empty()) {
      const Estimate index =
          read_estimate_flag("--remolding-index", options.remolding, {"-", above_zero}, std::nullopt);
      const Estimate cone = *soil.cone_index;
      rating.value =
          Estimate{cone.value * index.value, std::hypot(cone.std_error * index.value, cone.value * index.std_error)};
    }
  }
  return rating;
}

int mobility(const MobilityOptions& options, const Session& session) {
  const Rating rating = rating_of(options, session);
  cone_index::Mobility answer = cone_index::mobility_of(vehicle_of(options, session), rating.value);
  answer.rating_is_cone_index = rating.is_cone_index;
  return publish(compare::report_on(answer, rating.soil), options.outputs, compare::doubts(answer), session)
      .status(done);
}

}  // namespace

void add_mobility(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "mobility", "does a vehicle get through soft fine-grained soil: VCI1, VCI50, MMP, go or no go");
  const auto options = std::make_shared<MobilityOptions>();
  add_value(*command, "file", options->file, "FILE.yaml", "a vehicle (soilbin-vehicle/1); flags go before it");
  add_value(*command, "--rating-cone-index", options->rating, "kPa[+-SD]",
            "of the soil: its cone index times its remolding index");
  add_value(*command, "--soil", options->soil, "NAME|FILE", "a soil with a cone_index, in place of that")
      ->excludes("--rating-cone-index");
  add_value(*command, "--remolding-index", options->remolding, "NUMBER|%[+-SD]",
            "what is left of the soil's cone index under traffic; without it the cone index is the rating")
      ->needs("--soil");
  add_value(*command, "--tire", options->tire, "NAME|FILE", "width, diameter and section height are this tire's");
  options->vehicle.add_to(*command, "Vehicle");
  options->outputs.add_to(*command, {.json = "soilbin-mobility/1, in SI"});
  command->footer(fmt::format("Example: {}", mobility_example));
  command->callback([=, &session] { session.action = [=, &session] { return mobility(*options, session); }; });
}

}  // namespace soilbin::cli
