#include "compare/experiments/run_plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "compare/experiments/run_costs.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/text_table.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// The packings whose beds are not in the folder of beds.
std::vector<std::uint64_t> without_file(const std::set<std::uint64_t>& packings, dem::DemSettings settings,
                                        const Scenario& scenario) {
  std::vector<std::uint64_t> missing;
  for (const std::uint64_t packing : packings) {
    settings.packing = packing;
    const fs::path file = dem::BedStore(settings.beds).file(dem::DemModel(settings).recipe(scenario));
    if (settings.beds.empty() || !fs::exists(file)) missing.push_back(packing);
  }
  return missing;
}

}  // namespace

std::size_t RunPlan::recorded() const {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.recorded; }));
}

double RunPlan::seconds_left() const {
  double sum = 0;
  for (const PlannedRun& run : runs) sum += run.recorded ? 0.0 : run.seconds;
  return sum;
}

double RunPlan::core_hours_left() const {
  return (seconds_left() + static_cast<double>(unsettled.size()) * bed_seconds) * threads / 3600;
}

RunPlan plan_of(const Case& question, const dem::DemSettings& settings, const std::vector<AskedRun>& list,
                const RunKeeping& keeping) {
  std::vector<fs::path> files = keeping.known;
  if (fs::exists(keeping.record)) files.push_back(keeping.record);
  const std::vector<Record> records = read_records(files, inputs_of(settings, question.scenario));
  const RunCosts costs(question.scenario, settings, records);
  RunPlan plan{.study = question.study.name, .runs = {}};
  std::set<std::uint64_t> packings;
  for (const AskedRun& run : list) {
    packings.insert(run.packing);
    plan.runs.push_back({run, missing_runs({run}, records).empty(), costs.seconds(run)});
  }
  plan.beds = packings.size(), plan.unsettled = without_file(packings, settings, question.scenario);
  plan.threads = costs.threads();
  plan.from_runs = costs.from_runs(), plan.speed = costs.speed(), plan.grains = costs.grains();
  plan.bed_seconds = costs.bed_seconds(), plan.memory = costs.memory();
  plan.bed_bytes = costs.bed_bytes(), plan.record_bytes = costs.record_bytes();
  return plan;
}

std::string plan_text(const RunPlan& plan) {
  TextTable table({"run", "packing", "condition", "time"});
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const PlannedRun& planned = plan.runs[k];
    table.add({std::to_string(k + 1), std::to_string(planned.run.packing),
               in_words(planned.run.at) + (planned.run.half_step ? ", half the time step" : ""),
               planned.recorded ? "recorded" : duration_text(planned.seconds)});
  }
  const std::size_t recorded = plan.recorded(), left = plan.runs.size() - recorded;
  std::string text = fmt::format("{}: {} of grains on {}\n\n{}\n", plan.study, counted(plan.runs.size(), "run"),
                                 counted(plan.beds, "bed"), table.text());
  text += fmt::format("recorded  {}\nto make   {}\n", recorded, left);
  text += fmt::format("beds      {} to settle, {} each\n", plan.unsettled.size(), duration_text(plan.bed_seconds));
  text += fmt::format(
      "time      about {:.2g} core-hours, {} a process ({}: {:.2g} million grain-steps a second, "
      "{:.0f} grains)\n",
      plan.core_hours_left(), counted(static_cast<std::size_t>(plan.threads), "thread"),
      plan.from_runs > 0 ? "from " + counted(plan.from_runs, "recorded run") : "from a trial on this machine",
      plan.speed / 1e6, plan.grains);
  text +=
      fmt::format("memory    about {} a process\ndisk      about {} a bed, {} for the record\n", size_text(plan.memory),
                  size_text(plan.bed_bytes), size_text(plan.record_bytes * static_cast<double>(plan.runs.size())));
  return text;
}

Json plan_json(const RunPlan& plan) {
  Json runs = Json::array();
  for (const PlannedRun& planned : plan.runs) {
    Json row = to_json(planned.run.at);
    row["packing"] = planned.run.packing, row["half_step"] = planned.run.half_step;
    row["recorded"] = planned.recorded, row["seconds"] = planned.seconds;
    runs.push_back(row);
  }
  return {{"format", "soilbin-plan/1"},
          {"study", plan.study},
          {"recorded", plan.recorded()},
          {"beds", plan.beds},
          {"beds_to_settle", plan.unsettled},
          {"threads", plan.threads},
          {"core_hours_left", plan.core_hours_left()},
          {"seconds_a_bed", plan.bed_seconds},
          {"grain_steps_a_second", plan.speed},
          {"from_recorded_runs", plan.from_runs},
          {"bytes_a_process", plan.memory},
          {"bytes_a_bed", plan.bed_bytes},
          {"runs", runs}};
}

}  // namespace soilbin::compare
