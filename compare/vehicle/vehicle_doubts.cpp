#include "compare/vehicle/vehicle_doubts.hpp"

#include <set>
#include <utility>

#include "compare/doubts/doubts.hpp"

namespace soilbin::compare {

Doubts doubts_about(const VehicleAnswers& answers, Doubts notes) {
  std::set<std::size_t> axles;
  for (std::size_t i = 0; i < answers.wheels.size(); ++i) {
    const VehicleWheel& wheel = answers.wheels[i];
    if (!answers.steady || answers.steady->wheels[i].lifted || !axles.insert(wheel.axle).second) continue;
    const TractionResult& result = answers.steady->wheels[i].result;
    Case question;
    question.name = wheel.name, question.scenario = wheel.scenario;
    question.scenario.effects.clear();
    question.study.models.emplace_back().effects = wheel.scenario.effects;
    label_models(question.study.models);
    question.study.conditions = {result.at};
    append(notes, doubts(question, {{question.study.models.front(), {{result.at, result, ""}}}}));
  }
  std::erase_if(notes, [](const Doubt& doubt) {  // wheels in front have no rut, and the speed makes the power
    return doubt.kind == DoubtKind::effect_without_pass || doubt.kind == DoubtKind::speed_ignored;
  });
  return once_each(notes);
}

}  // namespace soilbin::compare
