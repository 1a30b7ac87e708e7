#include "cli/run_plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/flag_values.hpp"
#include "cli/text_output.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

std::vector<compare::Record> records_of(const SoilBinFlags& flags, const compare::Inputs& inputs) {
  std::vector<std::string> files = flags.known;
  if (!flags.record.empty() && fs::exists(flags.record)) files.push_back(flags.record);
  std::vector<compare::Record> records;
  for (const std::string& file : files) {
    records.push_back(compare::read_record(file));
    compare::refuse_other_inputs(records.back(), inputs, file);
  }
  return records;
}

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

RunPlan plan_of(const Case& question, const SoilBinFlags& flags, compare::TestStep test) {
  const dem::DemSettings settings = settings_of(flags);
  std::vector<compare::AskedRun> list = compare::runs_of(question, settings, flags.packings, test);
  if (!flags.shard.empty()) list = compare::shard_of(list, compare::parse_shard(flags.shard));
  const std::vector<compare::Record> records = records_of(flags, compare::inputs_of(settings, question.scenario));
  const compare::RunCosts costs(question.scenario, settings, records);
  RunPlan plan{.study = question.study.name, .runs = {}};
  std::set<std::uint64_t> packings;
  for (const compare::AskedRun& run : list) {
    packings.insert(run.packing);
    plan.runs.push_back({run, compare::missing_runs({run}, records).empty(), costs.seconds(run)});
  }
  plan.beds = packings.size(), plan.unsettled = without_file(packings, settings, question.scenario);
  plan.threads = settings.how.threads > 0 ? settings.how.threads : all_cores();
  plan.from_runs = costs.from_runs(), plan.speed = costs.speed(), plan.grains = costs.grains();
  plan.bed_seconds = costs.bed_seconds(), plan.memory = costs.memory();
  plan.bed_bytes = costs.bed_bytes(), plan.record_bytes = costs.record_bytes();
  return plan;
}

std::string duration_text(double seconds) {
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", std::max(1.0, bytes / 1e3));
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string plan_text(const RunPlan& plan) {
  TextTable table({"run", "packing", "condition", "time"});
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const PlannedRun& planned = plan.runs[k];
    table.add({std::to_string(k + 1), std::to_string(planned.run.packing),
               compare::in_words(planned.run.at) + (planned.run.half_step ? ", half the time step" : ""),
               planned.recorded ? "recorded" : duration_text(planned.seconds)});
  }
  const std::size_t recorded = plan.recorded(), left = plan.runs.size() - recorded;
  std::string text =
      fmt::format("{}: {} of grains on {}\n\n{}\n", plan.study, compare::counted(plan.runs.size(), "run"),
                  compare::counted(plan.beds, "bed"), table.text());
  text += fmt::format("recorded  {}\nto make   {}\n", recorded, left);
  text += fmt::format("beds      {} to settle, {} each\n", plan.unsettled.size(), duration_text(plan.bed_seconds));
  text += fmt::format(
      "time      about {:.2g} core-hours, {} a process ({}: {:.2g} million grain-steps a second, "
      "{:.0f} grains)\n",
      plan.core_hours_left(), compare::counted(static_cast<std::size_t>(plan.threads), "thread"),
      plan.from_runs > 0 ? "from " + compare::counted(plan.from_runs, "recorded run") : "from a trial on this machine",
      plan.speed / 1e6, plan.grains);
  text +=
      fmt::format("memory    about {} a process\ndisk      about {} a bed, {} for the record\n", size_text(plan.memory),
                  size_text(plan.bed_bytes), size_text(plan.record_bytes * static_cast<double>(plan.runs.size())));
  return text;
}

nlohmann::ordered_json plan_json(const RunPlan& plan) {
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  for (const PlannedRun& planned : plan.runs) {
    nlohmann::ordered_json row = compare::to_json(planned.run.at);
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

}  // namespace soilbin::cli
