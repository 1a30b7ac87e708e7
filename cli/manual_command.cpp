// soilbin manual: the manual page, the same for the documents, and the completion for bash, all from the descriptions
// that --help shows.
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "compare/report/javascript.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::cli {

/// The files of cli/written; made by the build.
std::vector<compare::EmbeddedFile> written_files();

namespace {

/// Text as troff takes it: backslashes and hyphens kept, no line that begins like a request.
std::string troff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool begins = out.empty() || out.back() == '\n';
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

/// The options that --help shows: a command hides those of its group of flags that it has no use for.
std::vector<const CLI::Option*> shown_options(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::string described(const CLI::Option& option) {
  const std::string kind = option.get_type_name();
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", troff(option.get_name(option.get_positional())),
                     kind.empty() ? "" : fmt::format(" \\fI{}\\fR", troff(kind)), troff(option.get_description()));
}

std::string command_page(const CLI::App& command) {
  std::string page = fmt::format(".SS {}\n{}\n", troff(command.get_name()), troff(command.get_description()));
  for (const CLI::Option* option : shown_options(command))
    if (option->get_name() != "--help") page += described(*option);
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    page += command_page(*below);
  if (!command.get_footer().empty()) page += fmt::format(".PP\n{}\n", troff(command.get_footer()));
  return page;
}

std::string manual_page(const CLI::App& app) {
  std::string page = fmt::format(
      ".TH SOILBIN 1 \"\" \"soilbin {}\" \"User Commands\"\n.SH NAME\nsoilbin \\- what does this tire do on this "
      "soil?\n"
      ".SH SYNOPSIS\n.B soilbin\n\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n.SH DESCRIPTION\n"
      "Drawbar pull, torque, sinkage and side force of a wheel on soil: by the semi\\-empirical model of Wong and "
      "Reece, by discrete elements in a virtual soil bin, and beside measurements. Values carry their unit: 80N, "
      "110mm, 20%, 5deg.\n"
      ".SH COMMANDS\n",
      SOILBIN_VERSION);
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    page += command_page(*command);
  return page +
         ".SH EXIT STATUS\n0: done; 1: failed, or no answer; 2: bad input; 3: part of the work is done and kept, the "
         "same command goes on; 130: stopped by Ctrl\\-C.\n"
         ".SH ENVIRONMENT\n.TP\nSOILBIN_CASES\nfolders of tires, soils, studies, vehicles and campaigns, before the "
         "installed "
         "ones\n"
         ".TP\nSOILBIN_BEDS\nfolder in which settled beds of grains are kept\n"
         ".TP\nSOILBIN_JAVASCRIPT\nfolder of d3 and three.js for pages, before those of the system\n";
}

/// Text as a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string option_tables(const CLI::App& command) {
  std::vector<std::string> groups;
  for (const CLI::Option* option : shown_options(command))
    if (std::ranges::find(groups, option->get_group()) == groups.end()) groups.push_back(option->get_group());
  std::string text;
  for (const std::string& group : groups) {
    std::string rows;
    for (const CLI::Option* option : shown_options(command)) {
      if (option->get_group() != group || option->get_name() == "--help" || option->get_positional()) continue;
      const std::string kind = option->get_type_name();
      rows += fmt::format("| `{}`{} | {} |\n", option->get_name(), kind.empty() ? "" : " `" + cell(kind) + "`",
                          cell(option->get_description()));
    }
    if (!rows.empty()) text += fmt::format("\n| {} | |\n|---|---|\n{}", group == "Options" ? "option" : group, rows);
  }
  return text;
}

std::string markdown_of(const CLI::App& command, const std::string& before) {
  const std::string name = before + command.get_name();
  std::string usage = name, places;
  for (const CLI::Option* option : shown_options(command)) {
    if (!option->get_positional()) continue;
    usage += " " + (option->get_required() ? option->get_type_name() : "[" + option->get_type_name() + "]");
    places += fmt::format("- `{}`: {}\n", option->get_type_name(), option->get_description());
  }
  std::string text =
      fmt::format("\n## {}\n\n{}.\n\n`soilbin {}`\n{}{}", name, compare::capital(command.get_description()), usage,
                  places.empty() ? "" : "\n" + places, option_tables(command));
  if (!command.get_footer().empty()) text += fmt::format("\n{}\n", command.get_footer());
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    text += markdown_of(*below, name + " ");
  return text;
}

/// docs/reference/commands.md of an installation and of the site.
std::string markdown_page(const CLI::App& app) {
  std::string page =
      "# The commands\n\n"
      "Every command with its options, as `soilbin COMMAND --help` shows them. This page is written by\n"
      "`soilbin manual --markdown`. Numbers carry their unit: `80N`, `110mm`, `20%`, `5deg`. Errors and exit "
      "statuses:\n"
      "[errors.md](errors.md).\n\n| command | what it does |\n|---|---|\n";
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  std::string heading;
  for (const CLI::App* command : commands) {
    if (command->get_group() != heading) page += fmt::format("| **{}** | |\n", heading = command->get_group());
    page += fmt::format("| [{0}](#{0}) | {1} |\n", command->get_name(), cell(command->get_description()));
  }
  for (const CLI::App* command : commands) page += markdown_of(*command, "");
  return page;
}

std::string joined_names(const CLI::App& command) {
  std::string names;
  for (const CLI::Option* option : shown_options(command))
    for (const std::string& name : option->get_lnames()) names += (names.empty() ? "--" : " --") + name;
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    names += " " + below->get_name() + " " + joined_names(*below);
  return names;
}

/// What bash completes: commands, their flags, names of the library after --tire and --soil, else files.
std::string bash_completion(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    cases += fmt::format("    {}) flags=\"{}\" ;;\n", command->get_name(), joined_names(*command));
  }
  std::string script = compare::embedded(written_files(), "completion.bash");
  script.replace(script.find("@commands@"), 10, commands);
  return script.replace(script.find("@cases@"), 7, cases);
}

}  // namespace

void add_manual(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("manual", "the manual page of soilbin, or its completion for bash");
  const auto for_bash = std::make_shared<bool>(false), as_markdown = std::make_shared<bool>(false);
  command->add_flag("--bash-completion", *for_bash, "a script for bash in place of the page");
  command->add_flag("--markdown", *as_markdown, "the same as Markdown, as the documents hold it")
      ->excludes("--bash-completion");
  command->footer("Example: soilbin manual | man -l -");
  command->callback([=, &app, &session] {
    session.action = [=, &app] {
      fmt::print("{}", *for_bash ? bash_completion(app) : *as_markdown ? markdown_page(app) : manual_page(app));
      return done;
    };
  });
}

}  // namespace soilbin::cli
