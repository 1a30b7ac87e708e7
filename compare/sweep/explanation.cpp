#include "compare/sweep/explanation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <type_traits>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/presumption.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/result_json.hpp"
#include "scenario/deflection_table.hpp"
#include "scenario/description.hpp"
#include "scenario/errors.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/quantity.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::EffectForm;
using bekker_wong::EffectParameter;
using bekker_wong::RolledWheel;
using bekker_wong::SoilValues;

/// Everything that the equations take.
struct Facts {
  const Scenario& scenario;
  const OperatingCondition& at;
  SoilValues declared, soil;  ///< before and after the effects that change the soil's values
  RolledWheel wheel;
  bekker_wong::Outline outline;  ///< as the effects leave it
  double r, b, k, normal_load, theta_1, theta_m;

  bool settled() const { return wheel.stress_share != 1.0; }
};

Facts gather(const Scenario& scenario, const OperatingCondition& at) {
  if (!scenario.soil.semi_empirical)
    throw InputError("soil '" + scenario.soil.name + "' has no semi_empirical values, which bekker_wong needs");
  const SoilValues declared = bekker_wong::values_of(*scenario.soil.semi_empirical);
  const bekker_wong::EffectList effects = bekker_wong::make_effects(scenario.effects);
  const bekker_wong::RollingWheel model(scenario.tire, declared, effects, scenario.bin);
  Facts f{.scenario = scenario,
          .at = at,
          .declared = declared,
          .soil = declared,
          .wheel = model.roll(at),
          .outline = model.outline(at),
          .r = scenario.tire.radius,
          .b = scenario.tire.width,
          .k = 0.0,
          .normal_load = at.load * std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline),
          .theta_1 = 0.0,
          .theta_m = 0.0};
  for (const auto& effect : effects)
    effect->soil(f.soil, {scenario.tire, declared, at, f.wheel.motion, scenario.bin, f.normal_load});
  f.k = f.soil.pressure_modulus(f.b);
  f.theta_1 = f.wheel.patch.angles.entry;
  f.theta_m = f.wheel.patch.angles.max_stress;
  return f;
}

std::vector<Step> contact_steps(const Facts& f) {
  const SoilValues& s = f.soil;
  const char* modulus_unit = soil_parameter("k_phi").unit;
  std::vector<Step> steps;
  steps.push_back({"soil's stiffness", "k = k_c/b + k_phi",
                   fmt::format("{:.5g} {} / {:.4g} m + {:.5g} {}", s.k_c / 1000, soil_parameter("k_c").unit, f.b,
                               s.k_phi / 1000, modulus_unit),
                   f.k / 1000, modulus_unit});
  steps.push_back({"load on the ground", "W_n = W cos(alpha) cos(beta_t)",
                   fmt::format("{:.5g} N cos({:.3g} deg) cos({:.3g} deg)", f.at.load,
                               f.at.longitudinal_incline / degree, f.at.transverse_incline / degree),
                   f.normal_load, "N"});
  const std::string carried = fmt::format("{:.6g} N are then carried", f.wheel.forces.vertical);
  const double yields = f.wheel.patch.deflection;
  steps.push_back({"entry angle", "W_n = r b Int (sigma cos + tau sin) d theta", "solved for theta_1",
                   f.wheel.balance_angle / degree, "deg", f.settled() ? "" : carried});
  if (f.settled()) {
    steps.push_back({"entry angle after settling",
                     yields == 0.0 ? "theta_1 = arccos(1 - z/r)" : "theta_1 = arccos(1 - (z + deflection)/r)",
                     "where the effects below move the wheel", f.theta_1 / degree, "deg",
                     "what follows is at this angle"});
    steps.push_back({"share of the soil's stresses there", "W_n = a r b Int (sigma cos + tau sin) d theta",
                     "solved for a", f.wheel.stress_share, "-", carried});
  }
  steps.push_back({"sinkage", yields == 0.0 ? "z = r (1 - cos theta_1)" : "z = r (1 - cos theta_1) - deflection",
                   fmt::format("{:.4g} m (1 - cos {:.4g} deg)", f.outline.radius, f.theta_1 / degree) +
                       (yields == 0.0 ? "" : fmt::format(" - {:.4g} mm", 1000 * yields)),
                   1000 * f.wheel.sinkage, "mm",
                   f.outline.radius == f.r ? "" : "r: of the circle that presses, which the effects below change"});
  if (const double apart = f.wheel.reading.sinkage - f.wheel.sinkage; apart != 0.0)
    steps.push_back(
        {"sinkage as it is told", "z + what the effects below add",
         fmt::format("{:.4g} {} {:.4g} mm", 1000 * f.wheel.sinkage, apart < 0.0 ? "-" : "+", 1000 * std::abs(apart)),
         1000 * f.wheel.reading.sinkage, "mm"});
  steps.push_back({"angle of largest stress", "theta_m = (c1 + c2 |s|) theta_1",
                   fmt::format("({:.4g} + {:.4g} * {:.4g}) {:.4g} deg", s.c1, s.c2, std::abs(f.wheel.motion.slip),
                               f.theta_1 / degree),
                   f.theta_m / degree, "deg"});
  return steps;
}

double largest_stress(const Facts& f) {
  return *std::ranges::max_element(f.wheel.patch.of(&bekker_wong::ContactPatch::sigma));
}

std::vector<Step> stress_steps(const Facts& f) {
  const SoilValues& s = f.soil;
  const double drop = std::cos(f.theta_m) - std::cos(f.theta_1);
  const double share = f.wheel.stress_share, sigma = share * f.k * std::pow(f.outline.radius * drop, s.exponent);
  const std::string scaled = f.settled() ? fmt::format("{:.4g} * ", share) : "";
  const auto& motion = f.wheel.motion;
  const double turned = f.theta_1 - f.theta_m, rim = motion.rim();
  const double turned_sine = std::sin(f.theta_1) - std::sin(f.theta_m);
  const double shears = f.outline.shear_radius, slips = f.outline.slip_radius;
  const bool one_radius = shears == slips;
  const double j_x = one_radius ? shears * (rim * turned - motion.forward * turned_sine)
                                : shears * rim * turned - slips * motion.forward * turned_sine;
  const double j_y = slips * motion.lateral * turned, j = motion.lateral == 0.0 ? j_x : std::hypot(j_x, j_y);
  const double mobilised = motion.locked ? 1.0 : 1 - std::exp(-std::abs(j) / s.shear_modulus);
  const double tau = std::copysign((share * s.cohesion + sigma * std::tan(s.friction_angle)) * mobilised, j);
  const std::string strength = fmt::format("({}{:.4g} kPa + {:.4g} kPa tan {:.4g} deg) * {:.4g}", scaled,
                                           s.cohesion / 1000, sigma / 1000, s.friction_angle / degree, mobilised);
  const std::string a = f.settled() ? "a " : "";
  std::vector<Step> steps = {
      {"normal stress there", "sigma_m = " + a + "k r^n (cos theta_m - cos theta_1)^n",
       fmt::format("{}k ({:.4g} m * {:.4g})^{:.4g}", scaled, f.outline.radius, drop, s.exponent), sigma / 1000, "kPa",
       f.wheel.patch.deflection == 0.0
           ? ""
           : fmt::format("of the circle at this angle; the flattened tread presses with {:.4g} kPa at the most",
                         largest_stress(f) / 1000)}};
  const char* along = motion.locked ? " = -r cos(psi) (sin theta_1 - sin theta_m)"
                      : one_radius  ? " = r [(theta_1 - theta_m) - v_x/(r w) (sin theta_1 - sin theta_m)]"
                                    : " = R_s (theta_1 - theta_m) - v_x/w (sin theta_1 - sin theta_m)";
  const char* locked = motion.locked ? "the wheel is locked: only the direction of j counts, shear is saturated" : "";
  const std::string by_x =
      motion.locked ? fmt::format("{:.4g} m * {:.4g}", motion.forward * slips, -turned_sine)
      : one_radius
          ? fmt::format("{:.4g} m ({:.4g} - {:.4g} * {:.4g})", shears, turned, motion.forward, turned_sine)
          : fmt::format("{:.4g} m * {:.4g} - {:.4g} m * {:.4g}", shears, turned, motion.forward * slips, turned_sine);
  const std::string by_y = fmt::format("{:.4g} m * {:.4g} * {:.4g}", slips, turned, motion.lateral);
  if (motion.lateral == 0.0) {
    steps.push_back({"shear displacement there", std::string("j") + along, by_x, 1000 * j_x, "mm", locked});
    steps.push_back({"shear stress there", "tau = (" + a + "c + sigma_m tan phi) (1 - exp(-|j|/K)) sign(j)", strength,
                     tau / 1000, "kPa"});
    return steps;
  }
  steps.push_back(
      {"shear displacement in the wheel's plane", std::string("j_x") + along, by_x, 1000 * j_x, "mm", locked});
  steps.push_back({"shear displacement across it",
                   motion.locked ? "j_y = r sin(psi) (theta_1 - theta_m)" : "j_y = r (theta_1 - theta_m) v_y/(r w)",
                   by_y, 1000 * j_y, "mm"});
  steps.push_back({"shear displacement there", "j = sqrt(j_x^2 + j_y^2)",
                   fmt::format("sqrt(({:.4g} mm)^2 + ({:.4g} mm)^2)", 1000 * j_x, 1000 * j_y), 1000 * j, "mm"});
  steps.push_back({"shear stress there", "tau = (" + a + "c + sigma_m tan phi) (1 - exp(-j/K))", strength, tau / 1000,
                   "kPa",
                   fmt::format("of it tau j_x/j = {:.4g} kPa in the wheel's plane, tau j_y/j = {:.4g} kPa across",
                               tau * j_x / j / 1000, tau * j_y / j / 1000)});
  return steps;
}

/// "12.3 - 4.5 + 0.6"
std::string sum_in_words(const std::vector<double>& parts) {
  std::string sum;
  for (const double part : parts) {
    const char* sign = sum.empty() ? (part < 0 ? "-" : "") : part < 0 ? " - " : " + ";
    sum += fmt::format("{}{:.6g}", sign, std::abs(part));
  }
  return sum;
}

Step torque_step(const Facts& f, const TractionResult& result) {
  double shear = f.wheel.forces.torque;
  std::vector<double> parts;
  std::string names;
  const auto add = [&](const std::string& name, double torque) {
    if (torque != 0.0) parts.push_back(torque), names += " + " + name;
  };
  for (const auto& added : f.wheel.forces.added.rows())
    shear -= added.torque, add("that of " + spaced(added.name), added.torque);
  add("what the instruments add", f.wheel.reading.torque - f.wheel.unmeasured.torque);
  parts.insert(parts.begin(), shear);
  const bool on_the_rim =
      std::ranges::all_of(f.wheel.patch.of(&bekker_wong::ContactPatch::arm), [&](double arm) { return arm == f.r; });
  return {"torque",
          (on_the_rim ? "M = r^2 b Int tau d theta" : "M = r b Int R_s tau d theta") + names,
          parts.size() > 1 ? sum_in_words(parts) + " N m" : "over the contact",
          result.torque.value,
          "N m",
          on_the_rim ? "" : "R_s: the arm of the shear, which the effects below change"};
}

std::vector<Step> result_steps(const Facts& f, const TractionResult& result) {
  std::vector<double> parts;
  for (const Contribution& part : result.budget) parts.push_back(part.force);
  std::vector<Step> steps;
  steps.push_back(
      {"drawbar pull", "F_DP = the sum of the budget", sum_in_words(parts) + " N", result.drawbar_pull.value, "N"});
  steps.push_back(torque_step(f, result));
  if (result.lateral_force.value != 0.0) {
    const bool travel = f.at.force_frame == ForceFrame::travel;
    double in_plane = f.wheel.forces.thrust + f.wheel.forces.compaction, across = f.wheel.forces.side;
    for (const auto& added : f.wheel.forces.added.rows()) in_plane += added.forward, across += added.lateral;
    const double slope = f.at.load * std::sin(f.at.longitudinal_incline);
    const double cross = f.at.load * std::cos(f.at.longitudinal_incline) * std::sin(f.at.transverse_incline);
    const double sine = std::sin(f.at.yaw), cosine = std::cos(f.at.yaw);
    steps.push_back(
        {"lateral force",
         travel ? "F_y = F_x sin(psi) + S cos(psi) - W cos(alpha) sin(beta_t)"
                : "F_y = S + W sin(alpha) sin(psi) - W cos(alpha) sin(beta_t) cos(psi)",
         travel ? fmt::format("{:.4g} N * {:.4g} + {:.4g} N * {:.4g} - {:.4g} N", in_plane, sine, across, cosine, cross)
                : fmt::format("{:.4g} N + {:.4g} N - {:.4g} N", across, slope * sine, cross * cosine),
         result.lateral_force.value, "N",
         travel ? "F_x: the soil's force in the wheel's plane; S: across it, b Int tau_y ds"
                : "S: the soil's force across the wheel's plane, b Int tau_y ds"});
  }
  if (has_efficiency(result)) {
    const double advance = f.r * f.wheel.motion.travel_ratio;
    const bool downhill = f.at.longitudinal_incline < 0.0;
    const std::string slope =
        downhill ? fmt::format(" + {:.5g} N * {:.4g} m", -f.at.load * std::sin(f.at.longitudinal_incline), advance)
                 : "";
    steps.push_back({"tractive efficiency", downhill ? "TE = F_DP v/(M w + W sin(-alpha) v)" : "TE = F_DP v/(M w)",
                     fmt::format("{:.5g} N * {:.4g} m / {}{:.5g} N m{}{}", pull_along_travel(result), advance,
                                 downhill ? "(" : "", result.torque.value, slope, downhill ? ")" : ""),
                     100 * result.tractive_efficiency, "%", "F_DP along travel"});
  }
  return steps;
}

/// What the maker's table says of this load and pressure.
std::string deflection_remark(const Tire& tire, const OperatingCondition& at) {
  const double load = at.load * std::cos(at.longitudinal_incline) * std::cos(at.transverse_incline);
  if (!tire.inflation_pressure) return fmt::format("reads the load-deflection table ({})", in_words(*tire.deflection));
  return fmt::format("by the load-deflection table ({}) {:.4g} mm on firm ground under {} at {:.4g} kPa",
                     in_words(*tire.deflection), 1000 * deflection_of(*tire.deflection, load, *tire.inflation_pressure),
                     newtons(load), *tire.inflation_pressure / 1000);
}

std::vector<Step> effect_steps(const Scenario& scenario, const OperatingCondition& at) {
  std::vector<Step> steps;
  for (const EffectChoice& choice : scenario.effects) {
    const EffectForm& form = bekker_wong::find_form(choice);
    Step step{choice.id + " (" + form.form + ")", form.equation, "", 0.0, "", form.source};
    for (const std::string& sentence : bekker_wong::presumptions({choice}, tire_at(scenario.tire, at)))
      step.remark += "; " + sentence.substr(0, sentence.size() - 1);
    const Tire tire = tire_at(scenario.tire, at);
    if (tire.deflection && depends_on(form, deflection_key)) step.remark += "; " + deflection_remark(tire, at);
    for (const EffectParameter& p : form.parameters) {
      const auto given = choice.parameters.find(p.name);
      const double value = given == choice.parameters.end() ? p.fallback : given->second;
      step.numbers += (step.numbers.empty() ? "" : ", ") + p.name + " = " +
                      write_quantity(value, p.unit, scenario.soil.semi_empirical->exponent.value);
      if (&p == &form.parameters.front()) step.value = value, step.unit = "SI";
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

/// What inflation and carcass make of the pressure under the rigid wheel; `most`: the largest one of this answer.
std::string pressure_remark(const Scenario& scenario, const OperatingCondition& at, double critical, double most) {
  const Tire tire = tire_at(scenario.tire, at);
  if (!tire.inflation_pressure) return "the wheel is declared rigid";
  const double carried = *declared_ground_pressure(tire);
  const std::string given =
      fmt::format("inflation {:.4g} kPa and carcass {:.4g} kPa give {:.4g} kPa", *tire.inflation_pressure / 1000,
                  (carried - *tire.inflation_pressure) / 1000, carried / 1000);
  if (bekker_wong::is_flexible(scenario.effects))
    return fmt::format("of the rigid wheel; {}, and the flexible tire presses with {:.4g} kPa at the most", given,
                       most / 1000);
  return fmt::format(
      "{}: the tire {}", given,
      carried > std::max(critical, most) ? "rolls as if rigid" : "flattens; add --effect tire_flexibility");
}

/// What this soil bears forward at the most under the contact that acts, on the surface through the tips of the lugs
/// where the model has them: the bound that the lugs' forms keep.
Step largest_thrust(const Facts& f) {
  using Patch = bekker_wong::ContactPatch;
  double lugs = 0.0;
  for (const EffectChoice& effect : f.scenario.effects) {
    const EffectForm& form = bekker_wong::find_form(effect);
    if (!depends_on(form, "lugs")) continue;
    lugs = f.scenario.tire.lugs.height;
    for (const bekker_wong::Presumed& one : bekker_wong::presumed(form, f.scenario.tire))
      if (one.key == "lugs.height") lugs = one.value;
  }
  lugs = std::min(lugs, std::max(f.wheel.sinkage, 0.0));  // those in the soil
  const Patch& patch = f.wheel.patch;
  double length = 0.0, pressing = 0.0, faces = 0.0;
  for (int i = 0; i < patch.count; ++i) {
    length += patch.arc[i];
    pressing +=
        patch.arc[i] * (patch.sigma[i] * patch.normal_cosine[i] + std::max(0.0, patch.tau_x[i] * patch.normal_sine[i]));
  }
  pressing *= f.b;
  for (const auto& added : f.wheel.forces.added.rows())
    if (added.name == "lug_thrust") faces += added.forward;
  const double area = f.b * length * (1 + lugs / f.r), thrust = f.wheel.forces.thrust + faces;
  const double most = f.soil.cohesion * area + pressing * std::tan(f.soil.friction_angle);
  std::string remark = fmt::format("the model's thrust is {:.4g} N", thrust);
  if (faces != 0.0) remark += fmt::format(", {:.4g} N of it by the faces of the lugs", faces);
  constexpr double rounding = 1e-9;
  if (thrust > most * (1 + rounding)) remark += ": more, as an effect raises the soil's strength";
  return {"largest thrust of this soil",
          lugs > 0.0
              ? "c A + N tan phi, A = b L (r + h)/r over the contact's length L, h of a lug in the soil, N on the "
                "contact"
              : "c A + N tan phi, A = b L over the contact's length L, N on the contact",
          fmt::format("{:.4g} kPa * {:.4g} m^2 + {:.4g} N tan {:.4g} deg", f.soil.cohesion / 1000, area, pressing,
                      f.soil.friction_angle / degree),
          most,
          "N",
          remark};
}

/// Whether the wheel or the soil is of Zhou, Gao, Li, Hu: others have nothing to ask of their Eq. 5.
bool is_the_papers(const Scenario& scenario) {
  return scenario.tire.name.starts_with("paper-") || scenario.soil.name.starts_with("paper-");
}

std::vector<Step> closed_forms(const Facts& f, const TractionResult& result) {
  const SoilValues& soil = f.declared;
  const double z0 = bekker_wong::bekker_static_sinkage(soil, f.r, f.b, f.at.load), n = soil.exponent;
  const double rolling = bekker_wong::rolling_resistance(soil, f.r, f.b, f.at.load);
  const double critical = bekker_wong::critical_ground_pressure(soil, f.r, f.b, f.at.load);
  const double eq5 = bekker_wong::paper::sinkage(soil, f.r, f.b, f.at.load, f.at.slip, f.theta_m);
  std::vector<Step> steps = {
      {"Bekker's static sinkage", "z_0 = [3 W/((3 - n) b k sqrt(D))]^(2/(2n + 1))",
       fmt::format("[3 * {:.4g} N / ({:.4g} * {:.4g} m * k * sqrt({:.4g} m))]^{:.4g}", f.at.load, 3 - n, f.b, 2 * f.r,
                   2 / (2 * n + 1)),
       1000 * z0, "mm", fmt::format("a towed wheel; the model's wheel sinks {:.4g} mm", 1000 * result.sinkage.value)},
      {"Bekker's rolling resistance", "R = b k z_0^(n+1)/(n + 1)",
       fmt::format("{:.4g} m * k ({:.4g} m)^{:.4g} / {:.4g}", f.b, z0, n + 1, n + 1), rolling, "N",
       fmt::format("the model's compaction resistance is {:.4g} N", -f.wheel.forces.compaction)},
      {"critical ground pressure", "p_gcr = k z_0^n", fmt::format("k ({:.4g} m)^{:.4g}", z0, n), critical / 1000, "kPa",
       pressure_remark(f.scenario, f.at, critical, largest_stress(f))},
      largest_thrust(f)};
  if (is_the_papers(f.scenario))
    steps.push_back(
        {"Eq. 5 of Zhou, Gao, Li, Hu as it stands", "z = z_0 + (D/2) (1 - i) theta_m",
         fmt::format("{:.4g} mm + {:.4g} mm * {:.4g} * {:.4g} rad", 1000 * z0, 1000 * f.r, 1 - f.at.slip, f.theta_m),
         1000 * eq5, "mm",
         "faulty: its second term is an arc length, not a depth, and falls with slip where measured sinkage rises"});
  return steps;
}

void append(std::vector<Step>& all, std::vector<Step> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

Explanation explain(const Scenario& scenario, const OperatingCondition& at) {
  const Facts facts = gather(scenario, at);
  Explanation explanation;
  explanation.result = bekker_wong::BekkerWong().evaluate(scenario, at);
  append(explanation.steps, contact_steps(facts));
  append(explanation.steps, stress_steps(facts));
  append(explanation.steps, result_steps(facts, explanation.result));
  explanation.effects = effect_steps(scenario, at);
  explanation.cross_checks = closed_forms(facts, explanation.result);
  return explanation;
}

namespace {

Json steps_json(const std::vector<Step>& steps) {
  Json all = Json::array();
  for (const Step& step : steps) {
    Json one = {{"name", step.name},
                {"equation", step.equation},
                {"numbers", step.numbers},
                {"value", step.value},
                {"unit", step.unit}};
    if (!step.remark.empty()) one["remark"] = step.remark;
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

std::vector<Explained> explain(const Case& question) {
  std::vector<Explained> all;
  for (const ModelChoice& choice : question.study.models) {
    if (choice.model == ModelKind::dem) make_model(choice.model);  // says how grains are asked
    if (choice.model != ModelKind::bekker_wong)
      throw InputError(
          fmt::format("explain shows the equations of bekker_wong alone: leave '{}' out here\n  hint: 'soilbin run' "
                      "answers by it, with the parts of its pull in --json",
                      word_of(choice.model)));
    const Scenario scenario = seen_by(choice, question.scenario);
    for (const OperatingCondition& at : question.study.conditions) all.push_back({choice, at, explain(scenario, at)});
  }
  return all;
}

Json rows_json(const std::vector<Explained>& explained) {
  Json rows = Json::array();
  for (const Explained& one : explained) {
    Json row = {{"model", "bekker_wong"}, {"label", one.choice.label}};
    row.update(to_json(Answer{one.at, one.why.result, ""}));
    row["steps"] = steps_json(one.why.steps);
    row["effects"] = steps_json(one.why.effects);
    row["cross_checks"] = steps_json(one.why.cross_checks);
    rows.push_back(std::move(row));
  }
  return rows;
}

Table forces_table(const TractionResult& result) {
  Table table{"", {"part", "force [N]"}};
  double sum = 0.0;
  for (const Contribution& part : result.budget) {
    table.add({"  " + spaced(part.name), fmt::format("{:.4f}", part.force)});
    sum += part.force;
  }
  table.add({"  sum", fmt::format("{:.4f}", sum)});
  table.add({"  drawbar pull", fmt::format("{:.4f}", result.drawbar_pull.value)});
  return table;
}

namespace {

/// A source of a value's own, else that of the whole.
std::string source_of(const std::string& key, const std::map<std::string, std::string>& own, const std::string& whole) {
  if (const auto found = own.find(key); found != own.end() && !found->second.empty()) return found->second;
  return whole.empty() ? "not stated" : whole;
}

Estimate estimate_of(double exact) { return {exact, 0.0}; }
Estimate estimate_of(const Estimate& estimate) { return estimate; }

/// The numbers of a wheel, or of its lugs, that are declared.
template <class Part>
void add_numbers(const Part& part, const std::string& prefix, const Tire& tire, std::vector<SourcedValue>& all) {
  each_member<Part>([&](const std::string& key, auto member, const auto& limits, const char*) {
    const std::optional number(part.*member);
    using Number = typename decltype(number)::value_type;
    if constexpr (std::is_arithmetic_v<Number> || std::is_same_v<Number, Estimate>) {
      std::string unit = "-";
      if constexpr (std::is_same_v<std::decay_t<decltype(limits)>, Measure>) unit = limits.unit;
      if (number)
        all.push_back({.of = "tire",
                       .key = prefix + key,
                       .name = (prefix.empty() ? "" : "lug ") + spaced(key),
                       .unit = unit,
                       .per_si = per_unit(unit),
                       .value = estimate_of(*number),
                       .source = source_of(prefix + key, tire.sources, tire.source)});
    }
  });
}

}  // namespace

std::vector<SourcedValue> sourced_values(const Scenario& scenario) {
  std::vector<SourcedValue> all;
  add_numbers(scenario.tire, "", scenario.tire, all);
  if (const std::optional<DeflectionTable>& table = scenario.tire.deflection)
    all.push_back(
        {.of = "tire",
         .key = deflection_key,
         .name = "load-deflection table",
         .unit = "rows",
         .per_si = 1.0,
         .value = {static_cast<double>(table->rows.size()), 0.0},
         .source = table->source.empty() ? source_of(deflection_key, {}, scenario.tire.source) : table->source});
  if (is_lugged(scenario.tire)) add_numbers(scenario.tire.lugs, "lugs.", scenario.tire, all);
  if (!scenario.soil.semi_empirical) return all;
  const SemiEmpiricalSoil& soil = *scenario.soil.semi_empirical;
  for (const SoilParameter& p : soil_parameters)
    all.push_back({"soil", p.name, p.title, p.unit, p.per_si, soil.*p.value, has_assumed_sd(soil, soil.*p.value),
                   source_of(p.name, soil.sources, scenario.soil.source)});
  for (const ExactSoilValue& exact : exact_soil_values)
    if (const std::optional<double>& value = soil.*exact.value)
      all.push_back({"soil",
                     exact.name,
                     exact.name,
                     exact.unit,
                     1.0,
                     {*value, 0.0},
                     false,
                     source_of(exact.name, soil.sources, scenario.soil.source)});
  return all;
}

std::string in_words(const SourcedValue& value) {
  const bool exact = value.value.std_error == 0.0;
  return (exact ? fmt::format("{:.6g}", value.value.value * value.per_si) : number(value.value, value.per_si)) +
         unit_behind(value.unit) + (value.assumed_sd ? " (± assumed)" : "");
}

Json sources_json(const Scenario& scenario) {
  Json all = Json::array();
  for (const SourcedValue& value : sourced_values(scenario))
    all.push_back({{"of", value.of},
                   {"name", value.key},
                   {"value", value.value.value},
                   {"std_error", value.value.std_error},
                   {"assumed_sd", value.assumed_sd},
                   {"source", value.source}});
  return all;
}

Table sources_table(const Scenario& scenario) {
  Table table{"", {"", "value", "source"}, {true, true, true}};
  for (const SourcedValue& value : sourced_values(scenario))
    table.add({fmt::format("  {}: {}", value.of, value.name), in_words(value), value.source});
  return table;
}

}  // namespace soilbin::compare
