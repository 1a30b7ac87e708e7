// soilbin calibrate: contact parameters of grains from virtual element tests.
#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "cli/batch_flags.hpp"
#include "cli/calibrate_flags.hpp"
#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "compare/calibrate/published_sets.hpp"
#include "compare/telling/calibration_report.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/csv.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;
using compare::ContactKind;

struct CalibrateOptions {
  ContactTestFlags contact_test;
  std::string store, output, beside, near = "5%", within = "3%", probability = "90%";
  DecisionFlags decision;
  BatchFlags batch;
  compare::CalibrationOptions options;
  OutputFlags outputs;
  bool runs = false;
};

/// One line on a terminal: which run, what goes on inside it, the time left if all runs are needed.
struct Shown {
  std::string run;
  double seconds_left = 0;

  compare::Watch of_runs() {
    return [this](const dem::Progress& at) { run = at.stage, seconds_left = at.seconds_left, show(""); };
  }
  compare::Watch inside() {
    return [this](const dem::Progress& at) { show(fmt::format(", {} {:.0f} %", at.stage, 100 * at.done)); };
  }
  void show(const std::string& doing) const {
    if (interrupt_asked()) throw Interrupted();
    show_progress_line(run + doing + (seconds_left > 0 ? fmt::format(", {:.0f} s left", seconds_left) : ""));
  }
};

fs::path store_of(const CalibrateOptions& asked, const Soil& soil) {
  if (!asked.store.empty()) return asked.store;
  const fs::path cache = user_cache();
  if (cache.empty()) return {};
  const fs::path file = cache / "experiments" / fmt::format("{}-{}.json", soil.name, asked.contact_test.contact);
  const std::string why = why_not_writable(file);
  if (why.empty()) return file;
  fmt::print(stderr, "warning: {}\n  experiments aren't kept\n", why);
  return {};
}

/// Where the soil bin's runs are kept: a folder beside the store, named after it.
fs::path records_beside(const fs::path& store) {
  return store.empty() ? store : store.parent_path() / (store.stem().string() + "-runs");
}

/// The published sets of a file by our virtual test.
int set_beside(const CalibrateOptions& asked, const compare::VirtualTest& test, compare::ExperimentStore& store,
               Shown& shown) {
  std::vector<compare::PublishedSet> sets =
      compare::parse_published_sets(read_source_text(asked.beside, largest_csv), test);
  compare::run_sets(sets, test, asked.options.seed, store, shown.of_runs());
  clear_progress_line();
  fmt::print("{}", as_text(compare::beside_table(test, sets)));
  return done;
}

void read_shares(CalibrateOptions& asked) {
  asked.options.near = read_flag("--near", asked.near, {"-", {.lower = 0, .upper = 1, .lower_open = true}});
  asked.options.within = read_flag("--within", asked.within, {"-", {.lower = 0, .upper = 1, .lower_open = true}});
  asked.options.probability = read_flag("--probability", asked.probability,
                                        {"-", {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true}});
}

struct Calibrated {
  const Soil& soil;
  ContactKind kind;
  const compare::VirtualTest& test;
};

/// Lets the soil bin decide, where that is asked for; refuses what it couldn't run before any work is done.
void add_decision(CalibrateOptions& asked, const Calibrated& what, fs::path records, const Workplace& place,
                  Shown& shown) {
  if (!asked.decision.given()) return;
  asked.decision.bin.texts["--settling-friction"] = asked.contact_test.settling_friction;
  asked.decision.bin.threads = asked.contact_test.threads;
  compare::TrialQuestion question = asked.decision.question(place);
  question.soil = what.soil, question.kind = what.kind, question.factors = what.test.factors;
  compare::TrialSettings settings = asked.decision.settings(asked.options.seed, std::move(records));
  settings.bin.how.progress = shown.inside(), settings.watch = shown.of_runs();
  compare::check(question, settings);
  asked.options.decide = [=, &place](const std::vector<compare::Candidate>& candidates) {
    return compare::decide_in_soil_bin(question, settings, candidates, place.effects);
  };
}

int tell(const CalibrateOptions& asked, const Soil& soil, ContactKind kind, const compare::VirtualTest& test,
         const compare::Calibration& calibration, const Session& session) {
  Outputs outputs =
      publish(compare::report_on(test, asked.options, calibration, asked.runs), asked.outputs, {}, session);
  outputs.file(asked.output,
               [&] { return write_soil(compare::calibrated_soil(soil, kind, test, asked.options, calibration)); });
  return outputs.status(calibration.reached ? done : failed);
}

/// Throws InputError for flags that the contact's test, or a table of sets, doesn't read.
void check_flags(const CalibrateOptions& asked, const CLI::App& command, ContactKind kind) {
  const auto refuse = [&](std::initializer_list<const char*> flags, const std::string& why) {
    for (const char* flag : flags)
      if (command.count(flag) > 0) throw InputError(fmt::format("{} has no effect {}", flag, why));
  };
  if (kind == ContactKind::grain_grain) {
    refuse({"--across"}, "on sand on sand\n  hint: it is the tilting board's, --contact tire");
  } else {
    const std::string hint = "on the tilting board\n  hint: it is a test's of sand on sand, --contact sand";
    refuse({"--test", "--strength", "--stresses"}, hint);
    if (!asked.decision.given()) refuse({"--settling-friction"}, hint);
  }
  if (asked.contact_test.measured.given()) {
    if (kind == ContactKind::grain_tire || asked.contact_test.strength_test == "direct-shear")
      throw InputError(
          "--curves: the tests are triaxial ones or plates, of sand on sand\n  hint: leave out --contact and --test, "
          "or --test plate");
    refuse({"--strength", "--stresses"}, "beside --curves, whose tests tell both");
    refuse({"--decide"}, "beside --curves\n  hint: calibrate the sand first, then --contact tire --decide");
  }
  if (asked.contact_test.strength_test == "plate") {
    refuse({"--features"}, "on plates\n  hint: it is the triaxial cell's");
    if (!asked.contact_test.measured.given())
      throw InputError("--test plate: which plates?\n  hint: --curves plates.csv, a file as soilbin plates reads it");
  }
  if (!asked.beside.empty())
    refuse({"--design", "--runs", "--near", "--within", "--probability", "--output", "--json", "--report", "--markdown",
            "--show-runs"},
           "beside --beside, which only runs the sets of a table\n  hint: leave out one of the two");
}

int calibrate(CalibrateOptions asked, const CLI::App& command, const Session& session) {
  const Soil soil = asked.contact_test.soil_with_grains(session.place);
  const ContactKind kind = asked.contact_test.kind();
  check_flags(asked, command, kind);
  read_shares(asked);
  Shown shown;
  asked.options.watch = shown.of_runs();
  compare::VirtualTest test = asked.contact_test.test(soil, shown.inside());
  const fs::path file = store_of(asked, soil);
  add_decision(asked, {soil, kind, test}, records_beside(file), session.place, shown);
  asked.batch.check(asked.store);
  compare::ExperimentStore store(file, asked.batch.writers());
  tell_unsealed(store, file);
  asked.batch.learn(store);
  if (asked.batch.answers()) return asked.batch.answer(test, store);
  compare::Calibration calibration;
  try {
    if (!asked.beside.empty()) return set_beside(asked, test, store, shown);
    if (asked.batch.asks()) test.asked = std::make_shared<std::vector<compare::ExperimentSpec>>();
    calibration = compare::calibrate(test, asked.options, store);
    if (test.waits()) return asked.batch.write(test);
  } catch (const Interrupted&) {
    clear_progress_line();
    if (!file.empty())
      fmt::print(stderr, "{} finished experiments are in {}{}; the same command goes on from there", store.size(),
                 file.string(), asked.decision.given() ? ", runs of the soil bin beside it" : "");
    throw;
  }
  clear_progress_line();
  return tell(asked, soil, kind, test, calibration, session);
}

void add_options(CLI::App& command, CalibrateOptions& asked) {
  asked.contact_test.add_to(command);
  add_value(command, "--design", asked.options.design, "L9|L16|L25", "orthogonal array to begin with, L9");
  add_value(command, "--runs", asked.options.most_runs, "N", "experiments at most, 30");
  add_value(command, "--near", asked.near, "SHARE", "candidates lie within this share of every target; 5 %");
  add_value(command, "--within", asked.within, "SHARE", "the search ends within this share of every target; 3 %");
  add_value(command, "--probability", asked.probability, "SHARE", "probability with which --within must hold; 90 %");
  add_value(command, "--seed", asked.options.seed, "N", "seed of packings and search; 1")->check(whole_number(1));
  add_kept_file(command, "--store", asked.store, "FILE.json", "where finished experiments are kept; the user's cache");
  add_file(command, "--output", asked.output, "FILE.yaml", "write the soil with the calibrated contact");
  add_value(command, "--beside", asked.beside, "FILE.csv",
            "only run the sets of this table and show them beside its results");
  asked.decision.add_to(command);
  asked.batch.add_to(command);
  command.get_option("--beside")->excludes("--decide");
  command.add_flag("--show-runs", asked.runs, "the table of all experiments");
  asked.outputs.add_to(command, {.json = "soilbin-calibration/1, in SI"});
}

}  // namespace

void add_calibrate(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("calibrate", "find the contacts of grains that give a measured strength");
  const auto asked = std::make_shared<CalibrateOptions>();
  add_options(*command, *asked);
  command->footer(
      "Finished experiments are kept: after Ctrl-C the same command goes on. Exit status 1: targets not reached.\n"
      "Example: soilbin calibrate paper-sand --contact tire --target board_angle=31.47deg --output calibrated.yaml\n"
      "         soilbin calibrate paper-sand --contact tire --target board_angle=31.47deg --decide CAMPAIGN");
  command->callback([=, &session] { session.action = [=, &session] { return calibrate(*asked, *command, session); }; });
}

}  // namespace soilbin::cli
