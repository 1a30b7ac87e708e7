// soilbin: what does this tire do on this soil?
#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command_words.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/standard_streams.hpp"
#include "cli/versions.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

/// What adds a command, and whether it may run grains.
struct Registration {
  void (*add)(CLI::App&, Session&);
  bool grains = false;
};
Registration with_grains(void (*add)(CLI::App&, Session&)) { return {add, true}; }

/// Commands under one heading of the help.
struct CommandGroup {
  const char* heading;
  std::vector<Registration> commands;
};

/// Every command, in the order of the help. Gives the names of those that may run grains.
std::vector<std::string> add_commands(CLI::App& app, Session& session) {
  const CommandGroup groups[] = {
      {"Ask about a wheel",
       {{add_estimate},
        {add_explain},
        {add_limits},
        {add_mobility},
        {add_vehicle},
        with_grains(add_run),
        with_grains(add_drive),
        {add_serve}}},
      {"Use measured data", {{add_design}, {add_runs}, {add_predict}, {add_loop}, {add_plates}, {add_shear}}},
      {"Set answers side by side",
       {with_grains(add_compare), {add_report}, with_grains(add_reproduce), with_grains(add_failure_map)}},
      {"Take answers to other programs", {{add_export}}},
      {"Work with grains",
       {with_grains(add_bed),
        {add_mesh},
        {add_sweep},
        {add_record},
        with_grains(add_campaign),
        with_grains(add_element_test),
        with_grains(add_bevameter),
        with_grains(add_calibrate),
        with_grains(add_verify)}},
      {"Files and this installation", {{add_init}, {add_check}, {add_list}, {add_schema}, {add_doctor}, {add_manual}}}};
  std::vector<std::string> grains;
  for (const CommandGroup& group : groups)
    for (const Registration& command : group.commands) {
      command.add(app, session);
      CLI::App* const added = app.get_subcommands({}).back();
      added->group(group.heading);
      if (command.grains) grains.push_back(added->get_name());
    }
  return grains;
}

/// The engine's threads wait for each other at every step. How long a thread that waits keeps its core is read by
/// libgomp before main() begins; by default so long that on busy cores it holds up those that it waits for (2.3 times
/// the clock beside two other programs, more beside more). So the program starts itself once more, with a short wait,
/// unless the environment says how to wait: before commands that may run grains, for it takes 20 ms. Where that fails
/// it goes on as it is.
void start_with_short_waits(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  ::setenv("GOMP_SPINCOUNT", "10000", 0);
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) ::execv(program.c_str(), argv);  // by its own name, as lists of processes show it
}

/// Why the program can't work with the stack that the shell leaves it, which a thread gets too; "" where it can. Beyond
/// the end of a stack the system ends a program without a word.
std::string too_small_a_stack() {
  constexpr ::rlim_t needed = 1 << 20;  // twice what a fit on several threads takes
  ::rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur == RLIM_INFINITY || stack.rlim_cur >= needed) return "";
  return fmt::format("the stack is limited to {} kB, and this needs {} kB\n  hint: ulimit -s 8192",
                     stack.rlim_cur / 1024, needed / 1024);
}

int refuse(const std::string& message) {
  fmt::print(stderr, "soilbin: {}\n", message);
  return bad_input;
}

/// Names the nearest right word for the first word that is no subcommand or flag; "" for none. `app`: the program, or a
/// command that has commands of its own; `words`: what stands behind it.
std::string misspelt(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) return "";
  const std::string& first = words.front();
  if (first.starts_with("-"))
    return first == "--help" || first == "-h" || first == "--version"
               ? ""
               : fmt::format("'{}' is where a command is expected\n  hint: soilbin --help lists them", clipped(first));
  const CLI::App* command = nullptr;
  std::vector<std::string> commands;
  for (const CLI::App* known : app.get_subcommands({})) {
    commands.push_back(known->get_name());
    if (known->get_name() == first) command = known;
  }
  if (command == nullptr)
    return fmt::format("unknown command '{}'{}\n  hint: commands are {}", clipped(first), did_you_mean(first, commands),
                       listed(commands));
  if (!command->get_subcommands({}).empty()) return misspelt(*command, {words.begin() + 1, words.end()});
  return unknown_flag(*command, words);
}

int run(int argc, char** argv) {
  CLI::App app{"soilbin - what does this tire do on this soil?", "soilbin"};
  app.set_version_flag("--version", version_line());
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  Session session{find_workplace(), command_line({argv + 1, argv + argc}), {}};
  if (const auto grains = add_commands(app, session); argc > 1 && std::ranges::find(grains, argv[1]) != grains.end())
    start_with_short_waits(argv);
  app.footer(
      "Begin with: soilbin estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 20%\n"
      "            soilbin estimate --soil dry-sand --tire rover-wheel --load 65N --slip 0%..60% --plot slip.svg\n"
      "            soilbin init mine, then soilbin run mine/case.yaml --plot curves.svg\n"
      "            soilbin serve, and move sliders in a browser\n"
      "soilbin COMMAND --help shows a command's flags and an example. Values carry their unit: 80N, 110mm, 20%, 5deg.");
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) return fmt::print("{}", app.help()), bad_input;
  if (const std::string hint = misspelt(app, words); !hint.empty()) return refuse(hint);
  if (const std::string hint = empty_text(words); !hint.empty()) return refuse(hint);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      std::ostringstream asked;  // help or version
      app.exit(error, asked, asked);
      return fmt::print("{}", asked.str()), done;
    }
    return refuse(refusal_of(error, words.front().starts_with("-") ? "" : words.front() + " ", example_of(app, words)));
  }
  return session.action();
}

}  // namespace
}  // namespace soilbin::cli

int main(int argc, char** argv) {
  using namespace soilbin;
  cli::guard_standard_streams();
  try {
    if (const std::string why = cli::too_small_a_stack(); !why.empty()) {
      fmt::print(stderr, "soilbin: {}\n", why);
      return cli::failed;
    }
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
