// soilbin loop: residual, cause, effect added, error before and after, on a measured campaign.
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/rig_flags.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::cli {
namespace {

struct LoopFlags {
  OutputFlags outputs;
  std::string campaign, model;
  std::vector<std::string> limits;
  bool details = false, next = false;
  int folds = 5;
  unsigned seed = 1;
};

/// On a terminal what to measure next, and no more.
void tell_only_next(compare::Report& report, const compare::LoopAnswer& answer) {
  using compare::Told;
  report.heading.clear();
  for (compare::ReportPart& part : report.parts)
    part.told = static_cast<Told>(static_cast<unsigned>(part.told) & static_cast<unsigned>(Told::to_look_at));
  std::vector<std::string> next = compare::what_next(answer);
  if (next.empty()) next = {"No condition within the limits would decide more."};
  report.add(compare::Sentences(next), Told::on_terminals);
}

int loop(const LoopFlags& asked, const Session& session) {
  const compare::Campaign campaign = find_campaign(session.place, asked.campaign, compare::CampaignUse::fit);
  const compare::Doubts doubts = compare::doubts_before_fit(campaign);
  compare::LoopOptions options;
  options.folds = asked.folds;
  options.attribution.seed = asked.seed;
  options.threads = all_cores();
  options.limits = read_limits(asked.limits);
  options.progress = shown_progress();
  const compare::LoopAnswer answer = compare::run_loop(campaign, options);
  compare::Report report = compare::report_on(campaign, answer, doubts);
  if (asked.next) tell_only_next(report, answer);
  if (asked.details)
    report.data = [data = report.data, &answer] {
      nlohmann::ordered_json document = data();
      document["details"] = compare::details_json(answer);
      return document;
    };
  Outputs outputs = publish(report, asked.outputs, doubts, session);
  outputs.file(asked.model,
               [&] { return write_case(compare::resolved_model(campaign, answer), session.place.effects); });
  return outputs.status(done);
}

}  // namespace

void add_loop(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("loop", "find what the model lacks beside measured runs, and what to measure next");
  const auto asked = std::make_shared<LoopFlags>();
  add_value(*command, "campaign", asked->campaign, "CAMPAIGN", "a campaign of the library, or its folder")->required();
  asked->outputs.add_to(*command, {.json = "the answer as JSON, soilbin-loop/1"});
  add_file(*command, "--save-model", asked->model, "FILE.yaml",
           "write soil and effects as a case that other commands take");
  CLI::Option* const next = command->add_flag("--next", asked->next, "say only what to measure next");
  add_limits_of_the_rig(
      *command, asked->limits,
      "for what to measure next: range that the rig can reach, where it is not the campaign's own; repeatable");
  add_value(*command, "--folds", asked->folds, "N",
            "parts into which the conditions are divided; each is predicted from the others; 5")
      ->check(whole_number(2, 50));
  add_value(*command, "--seed", asked->seed, "N", "seed of the simulations and the folds");
  CLI::Option* const json = command->get_option("--json");
  json->excludes(next);  // it says all, and what is next under next_test
  command->add_flag("--details", asked->details, "with --json: the intermediate results")->needs(json);
  command->footer("Example: soilbin loop cmu-smooth --report loop.html --save-model fitted.yaml");
  command->callback([=, &session] { session.action = [=, &session] { return loop(*asked, session); }; });
}

}  // namespace soilbin::cli
