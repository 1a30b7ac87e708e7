// The loop's answer as a case that other commands take.
#include <algorithm>
#include <cmath>
#include <set>

#include "bekker_wong/effect.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {

namespace {

/// The conditions of a campaign's runs, each once. When and where a run was made, and how fast, counts where an effect
/// hears of it; else all have the median speed.
std::vector<OperatingCondition> asked_of(const Campaign& campaign, const std::vector<EffectChoice>& effects) {
  const auto heard = [&](const char* key) {
    return std::ranges::any_of(
        effects, [&](const EffectChoice& effect) { return depends_on(bekker_wong::find_form(effect), key); });
  };
  std::vector<double> speeds;
  for (const Run& run : campaign.runs) speeds.push_back(run.at.speed);
  std::sort(speeds.begin(), speeds.end());
  std::vector<OperatingCondition> conditions;
  std::set<OperatingCondition> seen;
  for (const Run& run : campaign.runs) {
    OperatingCondition at = run.at;
    if (!heard("run")) at.run.reset();
    if (!heard("position")) at.position.reset();
    if (!heard("inflation_pressure")) at.inflation_pressure.reset();
    if (!heard("speed")) at.speed = speeds[speeds.size() / 2];
    if (seen.insert(at).second) conditions.push_back(at);
  }
  return conditions;
}

/// What the model missed of conditions left out, where that is more than noise of so many values explains.
Misfit misfit_of(const CrossValidation& held_out) {
  constexpr double standard_errors = 2.0;
  Misfit misfit{};
  for (std::size_t c = 0; c < misfit.size(); ++c) {
    const HeldOutErrors& e = held_out.channels[c];
    if (e.cells == 0) continue;
    const double noise = e.noise_floor * e.noise_floor, excess = e.after * e.after - noise;
    if (excess > standard_errors * std::sqrt(2.0 / e.cells) * noise) misfit[c] = std::sqrt(excess);
  }
  return misfit;
}

}  // namespace

std::string source_of_fit(const std::string& campaign) { return "fitted to campaign " + campaign; }

Case resolved_model(const Campaign& campaign, const LoopAnswer& answer) {
  Case model;
  model.name = campaign.name + "-model";
  model.source = source_of_fit(campaign.name);
  model.scenario = scenario_of(campaign);
  model.scenario.effects.clear();
  if (answer.judgement()) model.scenario.tire = answer.model().wheel();
  model.scenario.tire.name = campaign.name + "-wheel";
  model.scenario.soil.name = campaign.name + "-soil";
  model.scenario.soil.semi_empirical = answer.soil;
  std::erase_if(model.scenario.soil.semi_empirical->sources,  // a value that was fitted is no usual one any more
                [&](const auto& from) { return answer.judgement() && from.second == usual_stress_angle_source; });
  model.study.name = model.name;
  ModelChoice choice;
  choice.effects = campaign.effects;
  for (const AcceptedEffect& effect : answer.effects_in_model()) choice.effects.push_back(effect.choice);
  model.description = "Made by soilbin loop: " + verdict_sentence(answer);
  if (const std::string proxies = proxy_sentence(answer); !proxies.empty()) model.description += " " + proxies;
  for (const std::string& sentence : bekker_wong::presumptions(choice.effects, answer.wheel))
    model.description += " " + sentence;
  choice.label = "fitted";
  if (answer.judgement()) choice.errors = answer.model().errors(), choice.misfit = misfit_of(answer.validation);
  model.study.models = {choice};
  model.study.conditions = asked_of(campaign, choice.effects);
  return model;
}

}  // namespace soilbin::compare
