#include "cli/element_test_flags.hpp"

#include <fmt/core.h>

#include "cli/flag_values.hpp"
#include "cli/soil_bin.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/quantity.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

void ElementTestFlags::add_to(CLI::App& command) {
  command.add_option("--packing", packing, "seed of the first specimen, 1")->type_name("SEED");
  command
      .add_option("--settling-friction", settling_friction,
                  "share of friction while the specimen settles, 1; 0: densest")
      ->type_name("SHARE");
  command
      .add_option("--rolling", rolling, "law of rolling resistance: directional, elastic_plastic, none; the soil's own")
      ->type_name("LAW");
  command.add_option("--size", size, "of specimens and beds, times the default; tools keep theirs")
      ->type_name("FACTOR");
  command.add_option("--threads", threads, "0, one a core")->type_name("N");
}

dem::SpecimenSettings ElementTestFlags::specimen(const GranularSoil& soil) const {
  dem::SpecimenSettings out;
  out.laws.rolling = dem::rolling_law(soil.rolling_resistance);
  if (packing < 0) throw InputError("--packing: a seed is 0 or more");
  if (!(size >= 0.4 && size <= 10)) throw InputError("--size: a factor from 0.4 to 10");
  out.packing = static_cast<std::uint64_t>(packing);
  set_where_given("--settling-friction", settling_friction, {"-", fractions}, out.settling_friction);
  if (rolling == "elastic_plastic") {
    out.laws.rolling = dem::RollingLaw::elastic_plastic;
  } else if (rolling == "none") {
    out.laws.rolling = dem::RollingLaw::none;
  } else if (rolling == "directional") {
    out.laws.rolling = dem::RollingLaw::directional;
  } else if (!rolling.empty()) {
    throw InputError(fmt::format("--rolling: unknown law '{}'{}", clipped(rolling),
                                 did_you_mean(rolling, {"directional", "elastic_plastic", "none"})));
  }
  return out;
}

dem::WorkOptions ElementTestFlags::work() const {
  check_threads(threads);
  dem::WorkOptions how;
  how.threads = threads;
  how.progress = show_dem_progress;
  how.tell = tell_beside_progress;
  return how;
}

const GranularSoil& grains_of(const Soil& soil) {
  if (!soil.granular)
    throw InputError(
        fmt::format("soil '{}' has no grains: an element test needs its section 'granular'"
                    "\n  hint: paper-sand has one",
                    soil.name));
  return *soil.granular;
}

}  // namespace soilbin::cli
