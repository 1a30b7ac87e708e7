// soilbin report: studies and measured campaigns as one HTML page that needs nothing but a browser.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/studies_report.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

constexpr int smooth_points = 41;

struct ReportOptions {
  std::vector<std::string> studies, campaigns, links;
  std::string title = "soilbin report";
  OutputFlags outputs;
};

/// Whether a name is a campaign's, on the disk or in the library.
bool is_campaign(const std::string& name, const Workplace& place) {
  const std::filesystem::path path = name;
  if (path.filename() == "campaign.yaml" || std::filesystem::exists(path / "campaign.yaml")) return true;
  return place.library.find(Shelf::measured, name) && !place.library.find(Shelf::studies, name);
}

/// Throws InputError for a name that nothing has, with the nearest of studies and campaigns.
void refuse_unknown_part(const std::string& name, const Workplace& place) {
  const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml");
  const auto has_it = [&](Shelf shelf) { return place.library.find(shelf, name).has_value(); };
  if (is_path || is_there(name) || std::ranges::any_of(all_shelves, has_it)) return;
  const std::vector<std::string> studies = place.library.names(Shelf::studies),
                                 campaigns = place.library.names(Shelf::measured);
  std::vector<std::string> names = studies;
  names.insert(names.end(), campaigns.begin(), campaigns.end());
  throw InputError(
      fmt::format("no study or campaign '{}' in the library, and no such file{}\n  hint: {}; of campaigns {}",
                  clipped(name), did_you_mean_name(name, names), what_there_is(Shelf::studies, studies),
                  what_there_is(Shelf::measured, campaigns)));
}

/// Campaigns that were named among the studies as campaigns, and each name once.
ReportOptions sorted(ReportOptions options, const Workplace& place) {
  const auto add = [](std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  std::vector<std::string> studies, campaigns;
  for (const std::string& name : options.studies) add(is_campaign(name, place) ? campaigns : studies, name);
  for (const std::string& name : options.campaigns) add(campaigns, name);
  options.studies = studies, options.campaigns = campaigns;
  return options;
}

/// Leaves out the grains that a study asks for, which take hours, and says where they are shown. Throws InputError for
/// a study that asks nothing else.
void leave_out_grains(Case& question, const std::string& name, const Workplace& place, compare::NamedDoubts& named) {
  if (!asks(question.study, ModelKind::dem)) return;
  const bool recorded = is_there(place_of_record(place, name));
  const char* model = recorded ? "--recorded" : "--model dem";
  if (!asks(question.study, ModelKind::bekker_wong))
    throw InputError(fmt::format(
        "{0} asks grains alone, which this page does not run\n  hint: soilbin compare {0} {1} --report FILE.html", name,
        model));
  compare::keep_models(question.study, ModelKind::bekker_wong);
  named.add(name, compare::Doubts{{compare::DoubtKind::grains_left_out, {name, model}}});
}

int report(const ReportOptions& asked, const Session& session) {
  const ReportOptions options = sorted(asked, session.place);
  if (options.studies.empty() && options.campaigns.empty())
    throw InputError("name a study or a campaign: soilbin report paper-straight --measured cmu-smooth");
  OutputFlags outputs = options.outputs;
  if (outputs.report.empty() && outputs.markdown.empty() && !outputs.json) {
    outputs.report = "report.html";
    if (const std::string why = why_not_writable(outputs.report); !why.empty()) throw InputError("--output: " + why);
    announce_output(outputs.report, "--output");
  }
  std::vector<compare::StudyPart> studies;
  std::vector<compare::PageCard> links;
  for (const std::string& link : options.links) links.push_back(compare::page_card(link, outputs.report));
  compare::NamedDoubts named;
  for (const std::string& name : options.studies) refuse_unknown_part(name, session.place);
  for (const std::string& name : options.studies) {
    compare::StudyPart part{find_study(session.place, name), {}, {}, {}, name};
    leave_out_grains(part.question, name, session.place, named);
    part.study = compare::run_study(part.question, shown_progress());
    part.curves = compare::with_smooth_curves(part.question, smooth_points);
    part.along_curves = compare::run_study(part.curves, shown_progress());
    named.add(name, part.question, part.study);
    studies.push_back(std::move(part));
  }
  const auto model = compare::make_model(ModelKind::bekker_wong);
  std::vector<compare::CampaignPart> campaigns;
  for (const std::string& name : options.campaigns) {
    compare::CampaignPart part{find_campaign(session.place, name), {}};
    const Scenario declared = compare::scenario_of(part.campaign);
    part.prediction = compare::predict(*model, declared, part.campaign, shown_progress());
    named.add(name, compare::doubts(part.campaign, declared, part.prediction));
    campaigns.push_back(std::move(part));
  }
  compare::Report page = compare::report_on(studies, campaigns, links);
  page.title = options.title;
  return publish(std::move(page), outputs, named.all(), session).status(done);
}

}  // namespace

void add_report(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("report", "studies and campaigns as one HTML page to open");
  const auto options = std::make_shared<ReportOptions>();
  add_value(*command, "studies", options->studies, "STUDY|CAMPAIGN...",
            "studies and campaigns of the library, case files, or campaigns' folders");
  add_value(*command, "--measured", options->campaigns, "CAMPAIGN...", "campaigns to predict and compare");
  add_value(*command, "--link", options->links, "FILE.html...",
            "other pages of soilbin, shown with their first drawing and sentence");
  options->outputs.add_to(*command, {.json = "soilbin-report/1, in SI", .page = "--output"});
  add_value(*command, "--title", options->title, "TEXT", "title of the page");
  command->footer(
      "The page is report.html where neither --output, --markdown nor --json is given.\n"
      "Example: soilbin report paper-straight --measured cmu-smooth --output report.html");
  command->callback([=, &session] { session.action = [=, &session] { return report(*options, session); }; });
}

}  // namespace soilbin::cli
