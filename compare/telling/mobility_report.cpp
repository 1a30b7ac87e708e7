// What a vehicle needs of a soft soil and what a soil leaves beyond it, as it is told; soilbin-mobility/1.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "cone_index/vehicle.hpp"

namespace soilbin::compare {
namespace {

using cone_index::Mobility;
using cone_index::MobilityFactors;
using cone_index::Passage;

std::string kilopascals(const Estimate& pressure) { return number(pressure, 1e-3) + " kPa"; }

std::string passes_in_words(const Passage& passage) { return passage.passes == 1 ? "1 pass" : "50 passes"; }

/// "go; the rating cone index is 108 ± 30 kPa above the 191.6 kPa that the vehicle needs".
std::vector<BackedSentence> verdicts_on(const Mobility& mobility) {
  std::vector<BackedSentence> verdicts;
  if (!mobility.passages) return verdicts;
  for (const Passage& one : *mobility.passages)
    verdicts.push_back(
        {passes_in_words(one),
         fmt::format("{}; the rating cone index is {} {} the {} that the vehicle needs", one.go ? "go" : "no go",
                     kilopascals({std::abs(one.excess.value), one.excess.std_error}), one.go ? "above" : "below",
                     kilopascals({one.needed, 0}))});
  return verdicts;
}

Table needs_table(const Mobility& mobility) {
  constexpr double psi = 6894.757293168361;
  Table table{"", {"value", "kPa", "psi"}};
  const auto add = [&](const char* name, double pressure) {
    table.add({name, number(pressure / 1e3), number(pressure / psi)});
  };
  add("VCI1: rating cone index that 1 pass needs", mobility.index.one_pass);
  add("VCI50: that 50 passes need", mobility.index.fifty_passes);
  if (mobility.pressure) add("MMP: mean maximum pressure", mobility.pressure->value);
  if (mobility.rating) add("RCI: rating cone index of the soil", mobility.rating->value);
  return table;
}

/// A factor of the mobility index: its key in documents, and its name for people.
struct ToldFactor {
  const char *key, *name;
  double MobilityFactors::*value;
};
constexpr ToldFactor told_factors[] = {
    {"contact_pressure", "CPF, contact pressure", &MobilityFactors::contact_pressure},
    {"weight", "WF, weight", &MobilityFactors::weight},
    {"tire", "TF, tire", &MobilityFactors::tire},
    {"grouser", "GF, chains", &MobilityFactors::grouser},
    {"wheel_load", "WLF, load a wheel", &MobilityFactors::wheel_load},
    {"clearance", "CF, clearance", &MobilityFactors::clearance},
    {"engine", "EF, engine", &MobilityFactors::engine},
    {"transmission", "TrF, transmission", &MobilityFactors::transmission}};

Table factors_table(const cone_index::VehicleConeIndex& index) {
  Table table{"", {"part", "value"}};
  for (const ToldFactor& factor : told_factors) table.add({factor.name, number(index.factors.*factor.value)});
  table.add({"MI = (CPF WF/(TF GF) + WLF - CF) EF TrF", number(index.mobility_index)});
  table.add({"DCF, deflection, on VCI1 alone", number(index.deflection_factor)});
  return table;
}

/// Where public sources disagree, or none could be read.
std::vector<std::string> sources_in_words(const Mobility& mobility) {
  std::vector<std::string> lines = {
      "MI after FM 5-430-00-1 (1994), chapter 7, with WLF - CF added and TF below the line; some public codes "
      "multiply, or invert TF.",
      "VCI1 with 3.74 in its last term, as Priddy and Willoughby (2006) print it; some codes have 2.14, which changes "
      "it by 0.1 psi at MI = 20 and less above."};
  if (mobility.pressure)
    lines.push_back(
        mobility.pressure->declared
            ? fmt::format("MMP over deflection by diameter (Larminie 1992), with the K of {} that was given.",
                          number(mobility.pressure->factor))
            : fmt::format("MMP with Rowland's K for the driven axles, which belongs to deflection over section height; "
                          "over the diameter it is {}. Both as commonly quoted.",
                          number(mobility.pressure->factor)));
  return lines;
}

Json mobility_json(const Mobility& mobility) {
  const cone_index::VehicleConeIndex& index = mobility.index;
  Json factors = Json::object();
  for (const ToldFactor& factor : told_factors) factors[factor.key] = index.factors.*factor.value;
  factors["deflection"] = index.deflection_factor;
  Json document = {{"format", "soilbin-mobility/1"},
                   {"vehicle", mobility.vehicle.name},
                   {"mobility_index", index.mobility_index},
                   {"factors", std::move(factors)},
                   {"vci1", index.one_pass},
                   {"vci50", index.fifty_passes},
                   {"mean_maximum_pressure", mobility.pressure ? Json(mobility.pressure->value) : Json()},
                   {"mmp_factor", mobility.pressure ? Json(mobility.pressure->factor) : Json()},
                   {"rating_cone_index", or_null(mobility.rating)}};
  document["passages"] = Json::array();
  if (mobility.passages)
    for (const Passage& one : *mobility.passages)
      document["passages"].push_back({{"passes", one.passes},
                                      {"needed", one.needed},
                                      {"excess", estimate_json(one.excess)},
                                      {"go", one.go},
                                      {"close", one.is_close()}});
  return document;
}

}  // namespace

Report report_on(const Mobility& mobility, const std::string& soil) {
  const std::string name = mobility.vehicle.name.empty() ? "vehicle" : mobility.vehicle.name;
  Report report{"Mobility: " + name, "Does the vehicle get through soft fine-grained soil?",
                name + (soil.empty() ? "" : " on " + soil)};
  report.add(Sentences(verdicts_on(mobility)));
  report.add(WarningsHere());
  report.add("Cone indices", needs_table(mobility));
  report.add("Mobility index", factors_table(mobility.index));
  report.add("Which source was taken", Items{sources_in_words(mobility)});
  report.data = [&mobility] { return mobility_json(mobility); };
  return report;
}

}  // namespace soilbin::compare
