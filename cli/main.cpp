// soilbin: what does this tire do on this soil?
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "cli/command_words.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/versions.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

/// Every command, in the order of the help; one line each.
void add_commands(CLI::App& app, Session& session) {
  add_estimate(app, session);
  add_explain(app, session);
  add_run(app, session);
  add_sweep(app, session);
  add_bed(app, session);
  add_record(app, session);
  add_element_test(app, session);
  add_bevameter(app, session);
  add_plates(app, session);
  add_limits(app, session);
  add_drive(app, session);
  add_predict(app, session);
  add_calibrate(app, session);
  add_campaign(app, session);
  add_loop(app, session);
  add_compare(app, session);
  add_failure_map(app, session);
  add_report(app, session);
  add_reproduce(app, session);
  add_serve(app, session);
  add_check(app, session);
  add_init(app, session);
  add_list(app, session);
  add_schema(app, session);
  add_verify(app, session);
  add_doctor(app, session);
  add_manual(app, session);
}

int refuse(const std::string& message) {
  fmt::print(stderr, "soilbin: {}\n", message);
  return bad_input;
}

/// Names the nearest right word for the first word on the command line that is no subcommand or flag; "" for none.
std::string misspelt(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) return "";
  const std::string& first = words.front();
  if (first.starts_with("-"))
    return first == "--help" || first == "-h" || first == "--version"
               ? ""
               : fmt::format("'{}' stands where a command is to be\n  hint: soilbin --help lists them", clipped(first));
  const CLI::App* command = nullptr;
  std::vector<std::string> commands;
  for (const CLI::App* known : app.get_subcommands({})) {
    commands.push_back(known->get_name());
    if (known->get_name() == first) command = known;
  }
  if (command == nullptr)
    return fmt::format("unknown command '{}'{}\n  hint: commands are {}", clipped(first), did_you_mean(first, commands),
                       listed(commands));
  return unknown_flag(*command, words);
}

int run(int argc, char** argv) {
  CLI::App app{"soilbin - what does this tire do on this soil?", "soilbin"};
  app.set_version_flag("--version", version_line());
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  Session session{find_workplace(), command_line({argv + 1, argv + argc}), {}};
  add_commands(app, session);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) return fmt::print("{}", app.help()), bad_input;
  if (const std::string hint = misspelt(app, words); !hint.empty()) return refuse(hint);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return refuse(refusal_of(error, words.front().starts_with("-") ? "" : words.front() + " "));
  }
  return session.action();
}

}  // namespace
}  // namespace soilbin::cli

int main(int argc, char** argv) {
  using namespace soilbin;
  try {
    cli::catch_interrupts();
    const int status = cli::run(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    fmt::print(stderr, "soilbin: the answer can't be written to standard output\n");
    return cli::failed;
  } catch (const InputError& error) {
    return cli::refuse(error.what());
  } catch (const cli::Interrupted&) {
    fmt::print(stderr, "\nsoilbin: stopped\n");
    return cli::interrupted;
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "soilbin: {}: {}\n", error.path1().string(), error.code().message());
    return cli::failed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "soilbin: this needs more memory than there is\n");
    return cli::failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "soilbin: {}\n", error.what());
    return cli::failed;
  }
}
