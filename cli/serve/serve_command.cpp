// soilbin serve: a page in the browser whose curves follow its controls, answered by this process.
#include <fmt/core.h>

#include <map>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/question.hpp"
#include "cli/serve/replies.hpp"
#include "cli/serve/server.hpp"
#include "cli/serve/vehicle_replies.hpp"
#include "cli/vehicle_question.hpp"

namespace soilbin::cli {
namespace {

constexpr const char* port_flag = "--port";

/// What is read of a served question's own flags: none here, but from the words by which each is asked again.
struct ServeOptions {
  explicit ServeOptions(CLI::App& command) : wheel(command) { model.add_to(command); }

  Question wheel;
  QuickModelFlag model;
  std::map<std::string, std::string> of_vehicles;
  int port = 8080;
};

/// Adds the flags that a vehicle's question has beside a wheel's. Whether a flag goes with what is served is found when
/// that is asked.
void add_flags_of_vehicles(CLI::App& command, std::map<std::string, std::string>& texts) {
  CLI::App app;
  const VehicleQuestion vehicle(app);
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty() || option == app.get_help_ptr()) continue;
    const std::string name = option->get_lnames().front(), flag = "--" + name;
    if (command.get_option_no_throw(flag) != nullptr) continue;
    CLI::Option* const added =
        option->get_items_expected_max() == 0
            ? command.add_flag(flag, option->get_description())
            : add_value(command, flag, texts[name], option->get_type_name(), option->get_description());
    added->group("Of a vehicle");
  }
}

/// What a person gave of the flags that `estimate` or `vehicle` has too.
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
  const auto listening = [](const std::string& address) {
    fmt::print("{}\nopen it in a browser; Ctrl-C stops\n", address);
    std::fflush(stdout);
  };
  const auto serve_setup = [&](const auto& setup) {
    serve_http(port, listening,
               [&](std::string_view target, const StillWanted& wanted) { return reply_to(setup, target, wanted); });
  };
  if (!case_name.empty() && names_a_vehicle(session.place, case_name))
    serve_setup(VehicleSetup(session.place, case_name, flags));
  else
    serve_setup(Setup(session.place, case_name, flags));
  return done;
}

}  // namespace

void add_serve(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "serve", "a live page on this machine: move load, slip and soil, or a vehicle's, and the curves follow");
  const auto options = std::make_shared<ServeOptions>(*command);
  command->get_option("case")->description("a case or a vehicle, by its file or its name in the library");
  add_flags_of_vehicles(*command, options->of_vehicles);
  add_value(*command, port_flag, options->port, "WHOLE", "port of 127.0.0.1; 8080; 0: any free one")
      ->check(whole_number(0, 65535));
  command->footer(
      "Examples: soilbin serve\n"
      "          soilbin serve rover-slip --effect slip_sinkage\n"
      "          soilbin serve --soil dry-sand --tire rover-wheel --load 65N --slip 20% --port 0\n"
      "          soilbin serve truck --slope 5deg");
  command->callback([=, &session] {
    session.action = [=, &session] { return serve(*command, static_cast<unsigned short>(options->port), session); };
  });
}

}  // namespace soilbin::cli
