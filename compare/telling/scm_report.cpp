// A soil for Chrono's SCM terrain, and what that terrain does not have of our wheel.
#include <fmt/core.h>

#include <array>
#include <iterator>
#include <string>
#include <vector>

#include "bekker_wong/effects/titles.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/scm_soil.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

/// What SCM has of one of our effects of wheel and soil: read in SCMTerrain.cpp of projectchrono/chrono.
struct InScm {
  const char* effect;
  bool lacks;
  const char* words;
};

constexpr std::array<InScm, 14> in_scm = {{
    {"slip_sinkage", true, "the sinkage follows from the normal stress alone, at every slip"},
    {"lug_thrust", true, "lugs of the wheel's mesh press deeper; their faces push no soil"},
    {"sidewall_bulldozing", true, "a side wall pushes no soil: stresses act on the ground's own surface"},
    {"shear_hump", true, "the shear stress rises to c + p tan phi and stays there"},
    {"pressure_dependent_shear_modulus", true, "one K for every normal stress"},
    {"hard_layer", true, "nothing changes with depth"},
    {"moisture", true, "only as other values, by place: RegisterSoilParametersCallback"},
    {"slope_weakening", true, "the soil's own weight on a slope takes none of its strength"},
    {"bulldozing", false,
     "EnableBulldozing moves soil to the rut's sides; its resistance is that of what piles up ahead"},
    {"exit_angle", false, "the soil springs back by the elastic stiffness, which is chosen here"},
    {"multipass", false, "the rut stays, with the pressure that it has carried; c, phi and K stay those of fresh soil"},
    {"tire_flexibility", false, "by a deformable tire of Chrono"},
    {"rate_dependence", false, "a damping by the vertical speed, which is chosen here"},
    {"interface_limit", false, "SCMContactableData: c, phi and K between wheel and soil"},
}};

constexpr const char* scm_differences[] = {
    "SCM has no angle of maximum stress (c1, c2): each point's pressure follows from its own depth, so that it is "
    "largest where the wheel is deepest.",
    "b is that of the contact patch, 1/b = perimeter/(2 area); here it is the wheel's width.",
    "SCM has no standard errors: those of the soil stand in the file's section 'soilbin', which Chrono does not read.",
};

const Estimate& scm_value(const SemiEmpiricalSoil& soil, const ScmParameter& p) {
  return soil.*soil_parameter(p.name).value;
}

Json scm_document(const Soil& soil, const std::string& version) {
  const SemiEmpiricalSoil& semi = *soil.semi_empirical;
  const ScmChoices chosen = scm_choices(semi);
  Json document = {{"Type", "SCM"},
                   {"Patch dimensions", {{"Length", chosen.length}, {"Width", chosen.width}}},
                   {"Grid spacing", chosen.grid_spacing},
                   {"Soil parameters", Json::object()},
                   {"Simulation settings", {{"Proxy contact radius", 0.002}, {"Fix proxies", true}}}};
  Json sd = Json::object(), beside = Json::object(), units = Json::object(), lacks = Json::array();
  for (const ScmParameter& p : scm_parameters) {
    document["Soil parameters"][p.key] = scm_value(semi, p).value * p.per_si;
    sd[p.key] = scm_value(semi, p).std_error * p.per_si;
    units[p.key] = p.unit;
  }
  document["Soil parameters"]["Elastic stiffness"] = chosen.elastic_stiffness;
  document["Soil parameters"]["Damping"] = chosen.damping;
  units["Elastic stiffness"] = "Pa/m", units["Damping"] = "Pa s/m";
  for (const char* name : {"stress_angle_c1", "stress_angle_c2"}) {
    const Estimate& value = semi.*soil_parameter(name).value;
    beside[name] = value.value, sd[name] = value.std_error;
  }
  for (const ExactSoilValue& exact : exact_soil_values)
    if (const std::optional<double>& value = semi.*exact.value) beside[exact.name] = *value;
  if (semi.assumed_sd) sd["assumed share"] = *semi.assumed_sd;
  for (const InScm& one : in_scm)
    if (one.lacks) lacks.push_back(one.effect);
  document["soilbin"] = {
      {"version", version},
      {"soil", soil.name},
      {"source", soil.source},
      {"sources", semi.sources},
      {"units", units},
      {"sd", sd},
      {"beside SCM", beside},
      {"chosen", {"Elastic stiffness", "Damping", "Grid spacing", "Patch dimensions", "Simulation settings"}},
      {"lacks", lacks}};
  return document;
}

Table values_in_scm(const Soil& soil) {
  Table table{"Soil parameters", {"in the file", "of SetSoilParameters", "value", "unit"}};
  table.text_columns = {true, true, false, true};
  for (const ScmParameter& p : scm_parameters)
    table.add({p.key, p.argument, number(scm_value(*soil.semi_empirical, p), p.per_si), p.unit});
  const ScmChoices chosen = scm_choices(*soil.semi_empirical);
  table.add({"Elastic stiffness", "elastic_K", number(chosen.elastic_stiffness), "Pa/m"});
  table.add({"Damping", "damping_R", number(chosen.damping), "Pa s/m"});
  table.legend =
      "In the order of the arguments. The last two are chosen, not measured: 20 times the number of Kphi and at least "
      "5e7 Pa/m, and the damping of Chrono's example.";
  return table;
}

Table effects_in_scm(bool lacks) {
  Table table{lacks ? "What SCM lacks of our effects" : "What SCM has in another way", {"effect", "in SCM"}};
  table.text_columns = {true, true};
  for (const InScm& one : in_scm)
    if (one.lacks == lacks)
      table.add({{std::string(bekker_wong::effect_title(one.effect).name), one.effect}, one.words});
  return table;
}

}  // namespace

Report report_on_scm(const Soil& soil, const std::string& version) {
  Report report{"SCM terrain: " + soil.name, "A soil as Chrono's SCM terrain reads it.", soil.name + " as SCM terrain"};
  report.add("Values", values_in_scm(soil));
  report.add(WarningsHere());
  report.add(Items{std::vector<std::string>(std::begin(scm_differences), std::end(scm_differences))});
  report.add("Effects", effects_in_scm(true));
  report.add(effects_in_scm(false));
  if (!soil.source.empty()) report.add(NamedValues{{{"Source", soil.source}}});
  report.add(Prose{{"The values hold for pressures and plates like those that found them."}});
  report.data = [&soil, version] { return scm_document(soil, version); };
  return report;
}

}  // namespace soilbin::compare
