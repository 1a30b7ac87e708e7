#include "scenario/case.hpp"
#include "scenario/effect_choices.hpp"
#include "scenario/fitted_errors.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin {
namespace {

void write_misfit(const Misfit& misfit, YamlLines& lines) {
  if (misfit == Misfit{}) return;
  lines.open("misfit");
  for (std::size_t i = 0; i < misfit.size(); ++i)
    if (misfit[i] > 0.0)
      lines.value(std::string(traction_channels[i].name),
                  write_quantity(misfit[i], std::string(traction_channels[i].si_unit)));
  lines.close();
}

void write_models(const Study& study, const EffectVocabulary& effects, std::optional<double> n, YamlLines& lines) {
  lines.open("models");
  for (const ModelChoice& choice : study.models) {
    lines.open_item();
    lines.value("model", word_of(choice.model));
    write_effects(choice.effects, effects, n, lines);
    if (!choice.label.empty()) lines.value("label", yaml_scalar(choice.label));
    write_fitted_errors(choice.errors, choice.effects, effects, n, lines);
    write_misfit(choice.misfit, lines);
    lines.close();
  }
  lines.close();
}

void write_conditions(const Study& study, YamlLines& lines) {
  lines.open("conditions");
  for (const OperatingCondition& at : study.conditions) {
    lines.open_item();
    Writing writing{&lines, std::nullopt, nullptr, ""};
    write_members(at, writing);
    lines.close();
  }
  lines.close();
}

std::string write_document(const char* format, const auto& value) {
  YamlLines lines;
  lines.value("format", format);
  Writing writing{&lines, std::nullopt, nullptr, ""};
  write_members(value, writing);
  return lines.text();
}

}  // namespace

std::string write_case(const Case& value, const EffectVocabulary& effects) {
  YamlLines lines;
  lines.value("format", case_format);
  Writing writing{&lines, std::nullopt, nullptr, ""};
  write_members(value, writing);
  write_group("tire", value.scenario.tire, lines);
  write_group("soil", value.scenario.soil, lines);
  if (value.scenario.bin) write_group("bin", *value.scenario.bin, lines);
  std::optional<double> n;
  if (value.scenario.soil.semi_empirical) n = value.scenario.soil.semi_empirical->exponent.value;
  if (value.drive) {
    lines.open("drive");
    Writing drive{&lines, std::nullopt, nullptr, ""};
    write_members(*value.drive, drive);
    write_effects(value.drive->effects, effects, n, lines);
    write_fitted_errors(value.drive->errors, value.drive->effects, effects, n, lines);
    lines.close();
  }
  if (value.study.conditions.empty()) return lines.text();
  lines.open("study");
  lines.value("name", yaml_scalar(value.study.name));
  write_models(value.study, effects, n, lines);
  write_conditions(value.study, lines);
  lines.close();
  return lines.text();
}

std::string write_tire(const Tire& tire) { return write_document(tire_format, tire); }
std::string write_soil(const Soil& soil) { return write_document(soil_format, soil); }

}  // namespace soilbin
