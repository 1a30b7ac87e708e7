// soilbin serve: a page in the browser whose curves follow its controls, answered by this process.
#include <fmt/core.h>

#include <memory>
#include <utility>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/question.hpp"
#include "cli/serve/server.hpp"

namespace soilbin::cli {
namespace {

constexpr const char* port_flag = "--port";

/// What a person gave of the flags that `estimate` has too.
std::vector<Flag> given_flags(const CLI::App& command) {
  std::vector<Flag> flags;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty() && option != command.get_option(port_flag) && option != command.get_help_ptr())
      for (const std::string& value : option->results()) flags.emplace_back(option->get_lnames().front(), value);
  return flags;
}

int serve(const CLI::App& command, unsigned short port, const Session& session) {
  std::string case_name = command.count("case") > 0 ? command["case"]->as<std::string>() : "";
  std::vector<Flag> flags = given_flags(command);
  if (case_name.empty() && flags.empty()) {
    case_name = "paper-straight";
    flags = {{"load", "4kN"}};
  }
  const Setup setup(session.place, case_name, flags);
  const auto listening = [](const std::string& address) {
    fmt::print("{}\nopen it in a browser; Ctrl-C stops\n", address);
    std::fflush(stdout);
  };
  serve_http(port, listening, [&](std::string_view target) { return reply_to(setup, target); });
  return done;
}

}  // namespace

void add_serve(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("serve", "a live page on this machine: move load, slip and soil, and the curves follow");
  const auto inputs = std::make_shared<Question>(*command);
  const auto model = std::make_shared<QuickModelFlag>();
  model->add_to(*command);
  const auto port = std::make_shared<int>(8080);
  add_value(*command, port_flag, *port, "WHOLE", "port of 127.0.0.1; 8080; 0: any free one")
      ->check(whole_number(0, 65535));
  command->footer(
      "Examples: soilbin serve\n"
      "          soilbin serve rover-slip --effect slip_sinkage\n"
      "          soilbin serve --soil dry-sand --tire rover-wheel --load 65N --slip 20% --port 0");
  command->callback([=, &session] {
    session.action = [=, keep = std::pair(inputs, model), &session] {
      return serve(*command, static_cast<unsigned short>(*port), session);
    };
  });
}

}  // namespace soilbin::cli
