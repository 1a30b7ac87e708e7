// soilbin loop: residual, cause, effect added, error before and after, on a measured campaign.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/rig_flags.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/loop/answer_words.hpp"
#include "compare/sweep/result_json.hpp"

namespace soilbin::cli {
namespace {

struct LoopOptions {
  std::string campaign, report, model;
  std::vector<std::string> limits;
  bool json = false, details = false, next = false;
  int folds = 5;
  unsigned seed = 1;
};

void print_table(const compare::Table& table) {
  if (!table.rows.empty()) fmt::print("\n{}", as_text(table));
}

/// The page's sentences and tables, in its order.
void print_answer(const compare::LoopAnswer& answer, const std::vector<std::string>& column_doubts, bool only_next) {
  if (!only_next) {
    fmt::print("{}\n", answer.campaign);
    for (const compare::BackedSentence& said : compare::headline(answer, column_doubts))
      fmt::print("\n{}. {}\n{}{}", said.about, said.text, said.detail, said.detail.empty() ? "" : "\n");
    print_table(compare::next_run_table(answer));
    print_table(compare::error_table(answer));
    print_table(compare::parameters_table(answer));
    if (answer.has_candidates()) {
      print_table(compare::candidates_table(answer));
      fmt::print("{}\n", compare::candidates_columns_in_words());
    }
    const std::vector<std::string> notes = compare::notes(answer);
    if (!notes.empty()) fmt::print("\n");
    for (const std::string& note : notes) fmt::print("{}\n", note);
    return;
  }
  const std::vector<std::string> sentences = compare::what_next(answer);
  for (const std::string& sentence : sentences) fmt::print("{}\n", sentence);
  if (sentences.empty()) fmt::print("No condition within the limits would decide more.\n");
}

int loop(const LoopOptions& asked, const Session& session) {
  const compare::Campaign campaign = find_campaign(session.place, asked.campaign, compare::CampaignUse::fit);
  const compare::Doubts doubts = compare::doubts_before_fit(campaign);
  const std::vector<std::string> of_columns = in_words(of_mistaken_columns(doubts));
  print_warnings(doubts);
  compare::LoopOptions options;
  options.folds = asked.folds;
  options.attribution.seed = asked.seed;
  options.threads = all_cores();
  options.limits = read_limits(asked.limits);
  options.progress = shown_progress();
  const compare::LoopAnswer answer = compare::run_loop(campaign, options);
  Outputs outputs;
  outputs.file(asked.report,
               [&] { return compare::loop_page(campaign, answer, in_words(doubts), of_columns, session.command); });
  outputs.file(asked.model,
               [&] { return write_case(compare::resolved_model(campaign, answer), session.place.effects); });
  if (asked.json) {
    nlohmann::ordered_json document = compare::to_json(answer);
    if (!of_columns.empty()) document["column_doubts"] = of_columns;
    if (asked.details) document["details"] = compare::details_json(answer);
    print_json(std::move(document), doubts);
  } else {
    print_answer(answer, of_columns, asked.next);
  }
  return outputs.status(done);
}

}  // namespace

void add_loop(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("loop", "find what the model lacks beside measured runs, and what to measure next");
  const auto asked = std::make_shared<LoopOptions>();
  add_value(*command, "campaign", asked->campaign, "CAMPAIGN", "a campaign of the library, or its folder")->required();
  add_file(*command, "--report", asked->report, "FILE.html", "write the report as one page");
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
  CLI::Option* const json = command->add_flag("--json", asked->json, "the answer as JSON, soilbin-loop/1");
  json->excludes(next);  // it says all, and what is next under next_test
  command->add_flag("--details", asked->details, "with --json: what stands behind the answer")->needs(json);
  command->footer("Example: soilbin loop cmu-smooth --report loop.html --save-model fitted.yaml");
  command->callback([=, &session] { session.action = [=, &session] { return loop(*asked, session); }; });
}

}  // namespace soilbin::cli
