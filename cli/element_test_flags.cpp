#include "cli/element_test_flags.hpp"

#include <fmt/core.h>

#include "cli/flag_values.hpp"
#include "cli/soil_bin.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {

RollingResistance rolling_named(const std::string& text, std::vector<std::string> words) {
  for (const auto& [word, law] : words_of(std::type_identity<RollingResistance>{})) {
    if (law == RollingResistance::torsion_spring) continue;  // its stiffness is no flag's
    if (word == text) return law;
    words.emplace_back(word);
  }
  throw InputError("--rolling: " + none_of(text, words));
}

void ElementTestFlags::add_to(CLI::App& command) {
  add_value(command, "--packing", packing, "SEED", "seed of the first specimen; 1");
  add_value(command, "--settling-friction", settling_friction, settling_type,
            "how dense the specimen settles: loose (the default), medium, dense, or the share of the friction that "
            "acts meanwhile: 1 loose .. 0 densest");
  add_value(command, "--rolling", rolling, "LAW",
            "law of rolling resistance: elastic_plastic, directional, directional_with_twist, none; the soil's own");
  add_value(command, "--size", size, "FACTOR",
            "size of specimens and beds, as a multiple of the default; tools keep theirs");
  add_value(command, "--threads", threads, "N", "number of threads; 0: one for each core, fewer for few grains");
}

dem::SpecimenSettings ElementTestFlags::specimen(const GranularSoil& soil) const {
  dem::SpecimenSettings out;
  static_cast<dem::LawFlags&>(out.laws) = dem::laws_of(soil);
  if (packing < 0) throw InputError("--packing: a seed is 0 or more");
  if (!(size >= 0.4 && size <= 10)) throw InputError("--size: a factor from 0.4 to 10");
  out.packing = static_cast<std::uint64_t>(packing);
  out.settling_friction = read_settling_friction(settling_friction, out.settling_friction);
  if (rolling == "none")
    out.laws.rolling = dem::RollingLaw::none;
  else if (!rolling.empty())
    out.laws.rolling = dem::rolling_law(rolling_named(rolling, {"none"}));
  return out;
}

compare::Doubts ElementTestFlags::doubts(GranularSoil soil) const {
  if (rolling == "none")
    soil.grain_grain.rolling_friction = soil.grain_tire.rolling_friction = 0.0;
  else if (!rolling.empty())
    soil.rolling_resistance = rolling_named(rolling, {"none"});
  return compare::grain_value_doubts(soil);
}

void MeasuredFlags::add_to(CLI::App& command, const char* meaning) {
  add_value(command, "--curves", file, "FILE.csv", meaning);
  add_value(command, "--tests", tests, "NAME,NAME,...", "--curves: only these triaxial tests of the file")
      ->needs("--curves");
  add_repeatable(command, "--only", only, "COLUMN=VALUE", "--curves: only plates of this value; may be given again")
      ->needs("--curves");
}

std::vector<compare::MeasuredPlate> MeasuredFlags::plates() const {
  if (!tests.empty())
    throw InputError("--tests is of triaxial tests\n  hint: plates are chosen by --only COLUMN=VALUE");
  return compare::read_plates(read_source_text(file, compare::largest_plate_csv), column_values("--only", only));
}

std::vector<compare::CompressionCurve> MeasuredFlags::triaxial() const {
  if (!only.empty()) throw InputError("--only is of plates\n  hint: triaxial tests are chosen by --tests NAME,NAME");
  std::vector<std::string> names = split(tests, ",");
  std::erase(names, "");
  return compare::read_compression(read_source_text(file, largest_csv), names);
}

void PlateFlags::add_to(CLI::App& command) {
  add_repeatable(command, "--plate", diameters, "DIAMETER",
                 "plates: the diameter of one, or several, 60mm,100mm; 5, 7 and 9 mean diameters of the grains");
  add_value(command, "--plate-sinkage", sinkage, "DEPTH",
            "plates: how deep they are pressed; 2 mean diameters of the grains");
}

namespace {

/// The diameter of a tool in mean diameters of the grains. Throws InputError for one narrower than narrowest_tool.
double tool_in_grains(const char* flag, const std::string& text, const GranularSoil& soil) {
  const double grain = mean_diameter(soil), tool = read_flag(flag, text, {"mm", above_zero}) / grain;
  if (tool < dem::narrowest_tool)
    throw InputError(
        fmt::format("{} {} is narrower than {:.3g} grains, of {} mm on average: single grains would carry it", flag,
                    text, dem::narrowest_tool, compare::number(1e3 * grain)));
  return tool;
}

}  // namespace

dem::PlateSettings PlateFlags::plates(const GranularSoil& soil) const {
  dem::PlateSettings out;
  if (!diameters.empty()) out.diameters.clear();
  for (const std::string& flag : diameters)
    for (const std::string& text : several_values("--plate", flag, {"mm", above_zero}))
      out.diameters.push_back(tool_in_grains("--plate", text, soil));
  if (const auto depth = deepest()) out.sinkage = *depth / mean_diameter(soil);
  return out;
}

std::optional<double> PlateFlags::deepest() const {
  if (sinkage.empty()) return std::nullopt;
  return read_flag("--plate-sinkage", sinkage, {"mm", above_zero});
}

void ConeFlags::add_to(CLI::App& command) {
  add_value(command, "--cone", diameter, "DIAMETER", "cone: of its base; 6 mean diameters of the grains");
  add_value(command, "--cone-depth", depth, "DEPTH", "cone: how deep its base is pressed; 3 of its diameters");
}

dem::ConeSettings ConeFlags::cone(const GranularSoil& soil) const {
  dem::ConeSettings out;
  if (!diameter.empty()) out.diameter = tool_in_grains("--cone", diameter, soil);
  const double usual = out.depth;
  if (!depth.empty())
    out.depth = read_flag("--cone-depth", depth, {"mm", above_zero}) / (out.diameter * mean_diameter(soil));
  out.bed.depth += out.depth - usual;
  return out;
}

dem::WorkOptions ElementTestFlags::work() const {
  check_threads(threads);
  dem::WorkOptions how;
  how.threads = threads;
  how.progress = show_dem_progress;
  how.tell = print_beside_progress;
  return how;
}

}  // namespace soilbin::cli
