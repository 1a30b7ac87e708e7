// soilbin reproduce: whether the models show what a publication found.

#include <filesystem>
#include <memory>
#include <set>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "compare/reproduction/reproduction.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions {
  std::string findings = "paper";
  OutputFlags outputs;
  std::vector<std::string> recorded;
};

fs::path findings_file(const Workplace& place, const std::string& name) {
  std::set<std::string> all;
  for (const fs::path& folder : place.folders) {
    const fs::path file = folder / "findings" / (name + ".yaml");
    if (fs::exists(file)) return file;
    if (!fs::is_directory(folder / "findings")) continue;
    for (const auto& entry : fs::directory_iterator(folder / "findings")) all.insert(entry.path().stem().string());
  }
  if (name.find('/') != std::string::npos || name.ends_with(".yaml")) return name;
  const std::vector<std::string> names(all.begin(), all.end());
  throw InputError("no findings '" + clipped(name) + "'" + did_you_mean(name, names) + "\n  hint: there are " +
                   listed(names));
}

/// Records of the library that answer a study of the findings.
std::vector<std::string> library_records(const compare::Findings& findings, const Workplace& place) {
  std::set<std::string> files;
  for (const std::string& study : compare::studies_of(findings))
    if (const fs::path file = place_of_record(place, study); fs::exists(file)) files.insert(file.string());
  return {files.begin(), files.end()};
}

std::vector<compare::StudyRecord> records_of(std::vector<std::string> files, const compare::Findings& findings,
                                             const Workplace& place) {
  std::vector<compare::StudyRecord> records;
  if (files.empty()) files = library_records(findings, place);
  for (const std::string& file : files) {
    compare::Record record = read_record_with_notes(file);
    const Case asked = parse_case(make_source_text(record.question, file + " (case)"), place.library, place.effects);
    compare::add_record(records, {asked.study.name, file, std::move(record)}, findings);
  }
  return records;
}

int reproduce(const ReproduceOptions& options, const Session& session) {
  const compare::Findings findings = compare::read_findings(findings_file(session.place, options.findings));
  const compare::AnsweredStudies answered = compare::answer_studies(
      findings, records_of(options.recorded, findings, session.place),
      [&](const std::string& study) { return find_case(session.place, study); }, shown_progress);
  compare::Reproduction reproduction = compare::reproduce(findings, answered.answers);
  reproduction.remarks = answered.remarks;
  return publish(compare::report_on(reproduction), options.outputs, answered.doubts.all(), session).status(done);
}

}  // namespace

void add_reproduce(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("reproduce", "whether the models show what a publication found");
  const auto options = std::make_shared<ReproduceOptions>();
  add_value(*command, "findings", options->findings, "FINDINGS",
            "findings of the library, or a YAML file; by default those of the paper");
  add_value(*command, "--recorded", options->recorded, "FILE.json...",
            "records of dem, one a study; by default the library's");
  options->outputs.add_to(*command, {.json = "the verdicts as JSON, in SI"});
  command->footer("Example: soilbin reproduce --report reproduction.html");
  command->callback([=, &session] { session.action = [=, &session] { return reproduce(*options, session); }; });
}

}  // namespace soilbin::cli
