// A driven wheel as a unit of FMI 2.0 as it is told; soilbin-fmu/1.
#include <fmt/core.h>

#include "compare/export/wheel_fmu.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/export_reports.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::compare {
namespace {

const char* role_in_words(FmuVariable::Role role) {
  return role == FmuVariable::Role::input ? "input" : role == FmuVariable::Role::parameter ? "parameter" : "output";
}

std::vector<BackedSentence> words_on(const WheelFmu& fmu, const CompiledC& compiled) {
  std::vector<BackedSentence> said;
  said.push_back({"Range",
                  "Outside the table the unit uses the nearest values, returns fmi2Warning and logs what was "
                  "left. Where the table has no answer it returns fmi2Error, and the wheel stays as it was."});
  said.push_back({"Motion", fmt::format("Steady, the wheel is the table. What is faster than {} rad/s is not in it: it "
                                        "takes what soil the contact has seen by its length alone.",
                                        number(fmu.rest_frequency, 2))});
  said.push_back(compiled.library
                     ? BackedSentence{"Compiled",
                                      "The unit holds a library for Linux of this machine's processor, and "
                                      "its source in C99 for others."}
                     : BackedSentence{"Not compiled", fmt::format("The unit holds its source alone: {}. Programs that "
                                                                  "compile units take it; else install a compiler "
                                                                  "(Debian: apt install gcc) and export again.",
                                                                  compiled.why_not)});
  return said;
}

Table fmu_variables(const WheelFmu& fmu) {
  Table table{"Variables", {"name", "", "unit", "start", "meaning"}};
  table.text_columns = {true, true, true, false, true};
  for (const FmuVariable& variable : fmu.variables)
    table.add({variable.name, role_in_words(variable.role), variable.unit,
               variable.start ? number(*variable.start) : "", variable.meaning});
  table.add(
      {"spin_is_given", "parameter", "", "false", "the wheel turns with given_spin, in place of by motor_torque"});
  table.add({"outside", "output", "", "", "0 where the last step stayed in the table"});
  return table;
}

Json fmu_json(const WheelFmu& fmu, const CompiledC& compiled, Json table) {
  Json variables = Json::array();
  for (const FmuVariable& variable : fmu.variables) {
    Json one = {{"name", variable.name}, {"role", role_in_words(variable.role)}, {"unit", variable.unit}};
    if (variable.start) one["start"] = *variable.start;
    variables.push_back(std::move(one));
  }
  Json document = {{"format", "soilbin-fmu/1"},
                   {"name", fmu.name},
                   {"guid", fmu.guid},
                   {"compiled", compiled.library.has_value()},
                   {"rest_frequency", fmu.rest_frequency},
                   {"variables", variables},
                   {"table", std::move(table)}};
  if (!compiled.library) document["why_not_compiled"] = compiled.why_not;
  return document;
}

}  // namespace

Report report_on(const WheelFmu& fmu, const CompiledC& compiled) {
  Report report = report_on(fmu.table);
  report.title = "FMI unit of " + fmu.table.question.scenario.tire.name;
  report.subtitle = "A driven wheel on soft soil for co-simulation by FMI 2.0.";
  report.add(Sentences(words_on(fmu, compiled)));
  report.add("Variables", fmu_variables(fmu));
  report.data = [&fmu, &compiled, table = report.data] { return fmu_json(fmu, compiled, table()); };
  return report;
}

}  // namespace soilbin::compare
