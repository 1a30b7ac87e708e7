// soilbin reproduce: whether the models show what a publication found.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "cli/text_output.hpp"
#include "cli/versions.hpp"
#include "compare/doubts/named_doubts.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/reproduction/reproduction_report.hpp"
#include "compare/sweep/result_json.hpp"
#include "scenario/errors.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions {
  std::string findings = "paper", report;
  std::vector<std::string> recorded;
  bool json = false;
};

/// A name of the library's findings, or a path.
fs::path findings_file(const Workplace& place, const std::string& name) {
  std::vector<std::string> names;
  for (const fs::path& folder : place.folders) {
    const fs::path file = folder / "findings" / (name + ".yaml");
    if (fs::exists(file)) return file;
    if (!fs::is_directory(folder / "findings")) continue;
    for (const auto& entry : fs::directory_iterator(folder / "findings")) names.push_back(entry.path().stem().string());
  }
  if (name.find('/') != std::string::npos || name.ends_with(".yaml")) return name;
  throw InputError("no findings '" + clipped(name) + "'" + did_you_mean(name, names) + "\n  hint: there are " +
                   listed(names));
}

/// Which study a record answers: its case's name.
std::string study_of(const compare::Record& record, const std::string& file, const Workplace& place) {
  return parse_case(make_source_text(record.question, file + " (case)"), place.library, place.effects).study.name;
}

struct Recorded {
  std::string study, file;
  compare::Record record;
};

/// What is to be known of the answers beside them.
struct Notes {
  std::vector<std::string> remarks;  ///< on errors
  compare::NamedDoubts doubts;       ///< each with the studies that it is of
};

/// Those of the analytic models and of grains that a record answers by.
void add_doubts(Notes& notes, Case question, std::vector<compare::ModelAnswers> study,
                const std::vector<compare::Answer>& grains) {
  if (!grains.empty()) {
    question.study.models.push_back({ModelKind::dem, {}, "dem"});
    study.push_back({question.study.models.back(), grains});
  }
  notes.doubts.add(question.study.name, question, study);
}

/// Answers of every model to every study that the findings speak of.
std::vector<compare::StudyAnswers> answers_of(const compare::Findings& findings, const std::vector<Recorded>& records,
                                              const Workplace& place, Notes& notes) {
  std::set<std::string> names;
  for (const compare::Finding& finding : findings.all) names.insert(finding.study);
  std::vector<compare::StudyAnswers> all;
  for (const std::string& name : names) {
    Case question = find_case(place, name);
    std::erase_if(question.study.models, [](const ModelChoice& c) { return c.model == ModelKind::dem; });
    const std::vector<compare::ModelAnswers> study = compare::run_study(question, shown_progress());
    for (const compare::ModelAnswers& model : study)
      all.push_back({name, model.choice.label, compare::taken_as_exact(model.answers)});
    std::string remark;
    compare::StudyAnswers dem{name, "dem", {}};
    for (const Recorded& one : records) {
      if (one.study != name) continue;
      dem.answers = compare::recorded_answers(one.record, question.study.conditions, remark);
      const std::string file = fs::path(one.file).filename().string() + ": ";
      notes.remarks.push_back(file + remark);
      for (const std::string& doubt : compare::step_doubts(one.record)) notes.remarks.push_back(file + doubt);
    }
    add_doubts(notes, question, study, dem.answers);
    if (dem.answers.empty())
      for (const OperatingCondition& at : question.study.conditions)
        dem.answers.push_back({at, std::nullopt, "not run"});
    all.push_back(std::move(dem));
  }
  return all;
}

/// Records of the library that answer a study of the findings.
std::vector<std::string> library_records(const compare::Findings& findings, const Workplace& place) {
  std::set<std::string> files;
  for (const compare::Finding& finding : findings.all) {
    const fs::path file = place_of_record(place, finding.study);
    if (fs::exists(file)) files.insert(file.string());
  }
  return {files.begin(), files.end()};
}

std::vector<Recorded> records_of(std::vector<std::string> files, const compare::Findings& findings,
                                 const Workplace& place) {
  std::vector<Recorded> records;
  if (files.empty()) files = library_records(findings, place);
  for (const std::string& file : files) {
    compare::Record record = read_record_with_notes(file);
    const std::string study = study_of(record, file, place);
    const bool asked =
        std::ranges::any_of(findings.all, [&](const compare::Finding& finding) { return finding.study == study; });
    if (!asked) throw InputError(fmt::format("{}: no finding speaks of its study '{}'", file, study));
    for (const Recorded& other : records)
      if (other.study == study)
        throw InputError(
            fmt::format("{} and {} answer the same study '{}'\n  hint: one record a study", other.file, file, study));
    records.push_back({study, file, std::move(record)});
  }
  return records;
}

void print_text(const compare::Reproduction& reproduction) {
  fmt::print("{}\n\n", reproduction.findings.source);
  for (const auto& [about, text] : compare::opening(reproduction)) fmt::print("{}: {}\n", about, text);
  fmt::print("\n{}\n", as_text(compare::findings_matrix(reproduction)));
  for (const std::string& remark : reproduction.remarks) fmt::print("{}\n", remark);
}

int reproduce(const ReproduceOptions& options, const Session& session) {
  const compare::Findings findings = compare::read_findings(findings_file(session.place, options.findings));
  const std::vector<Recorded> records = records_of(options.recorded, findings, session.place);
  Notes notes;
  compare::Reproduction reproduction =
      compare::reproduce(findings, answers_of(findings, records, session.place, notes));
  reproduction.remarks = notes.remarks;
  const std::vector<std::string> doubts = notes.doubts.lines();
  print_warnings(doubts);
  Outputs outputs;
  outputs.file(options.report, [&] {
    return compare::reproduction_page(
        reproduction, {"What of " + findings.name + " is reproduced", session.command, versions(), doubts});
  });
  if (options.json)
    print_json(compare::to_json(reproduction), doubts);
  else
    print_text(reproduction);
  return outputs.status(done);
}

}  // namespace

void add_reproduce(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("reproduce", "whether the models show what a publication found");
  const auto options = std::make_shared<ReproduceOptions>();
  add_value(*command, "findings", options->findings, "FINDINGS",
            "findings of the library, or a YAML file; by default those of the paper");
  add_value(*command, "--recorded", options->recorded, "FILE.json...",
            "records of dem, one a study; by default the library's");
  add_file(*command, "--report", options->report, "FILE.html", "save a page to open");
  command->add_flag("--json", options->json, "the verdicts as JSON, in SI");
  command->footer("Example: soilbin reproduce --report reproduction.html");
  command->callback([=, &session] { session.action = [=, &session] { return reproduce(*options, session); }; });
}

}  // namespace soilbin::cli
