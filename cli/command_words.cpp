#include "cli/command_words.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/report/shell_words.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

std::string command_line(const std::vector<std::string>& words) {
  return words.empty() ? "soilbin" : "soilbin " + compare::shell_words(words);
}

namespace {

/// Flags that people give to a command which another one has: who meets them is sent there.
struct Elsewhere {
  std::vector<std::string> commands, flags;
  const char* hint;
};
const Elsewhere elsewhere[] = {
    {{"estimate"},
     {"--report", "--slips", "--output"},
     "curves over slip: --slip 0%..60% --plot slip.svg; a page: soilbin init mine, then soilbin report mine/case.yaml "
     "--output page.html"},
    {{"explain"},
     {"--plot", "--csv", "--report", "--slips"},
     "this explains one answer; curves over slip: soilbin estimate --slip 0%..60% --plot slip.svg; over slope: soilbin "
     "limits --plot slope.svg"},
    {{"explain", "limits"},
     {"--model"},
     "this is of the analytic wheel; soilbin estimate --model rft asks another model"},
    {{"estimate", "explain", "limits", "serve"}, {"--diameter"}, "--radius takes half of it"},
    {{"limits"},
     {"--slip", "--longitudinal-incline"},
     "limits looks for the slip and the slope; soilbin estimate answers at those that are given"},
    {{"run", "compare", "sweep"},
     {"--tire", "--soil", "--radius", "--width", "--lug-height"},
     "it takes a case file, which has tire and soil: soilbin init mine writes one to change; soilbin estimate takes "
     "them as flags"}};

std::string sent_elsewhere(const std::string& command, const std::string& flag) {
  const auto holds = [](const auto& words, const std::string& word) {
    return std::ranges::find(words, word) != words.end();
  };
  for (const Elsewhere& one : elsewhere)
    if (holds(one.commands, command) && (holds(one.flags, flag) || !meant_words(flag, one.flags).empty()))
      return one.hint;
  return "";
}

/// "export table": a command with those that it belongs to.
std::string called(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  return parent == nullptr || parent->get_parent() == nullptr ? command.get_name()
                                                              : called(*parent) + " " + command.get_name();
}

/// CLI11's sentences, and ours: what stands before the mark, what follows it, up to the end of a sentence of its own.
struct Sentence {
  std::string_view begins, between, ends;
  const char* ours;  ///< {0}: what stands between begin and mark; {1}: what stands between mark and end
};

constexpr Sentence sentences[] = {
    {"Could not convert: ", " = ", "", "{0}: expected a whole number, such as 1, not '{1}'"},
    {"", ": At Most 1 required but received ", "", "{0} is given more than once"},
    {"", ": 1 required ", " missing", "{0} needs a value ({1})"},
    {"A subcommand", "", " is required", "a command is missing"},
    {"", "", " is required", "'{0}' is missing"},
    {"The following argument was not expected: ", "", "", "'{0}' is one word too many"},
    {"The following arguments were not expected: ", "", "", "these words are too many: {0}"},
    {"", " requires ", "", "{0} needs {1}"},
    {"", " excludes ", "", "{0} and {1} exclude each other"},
};

}  // namespace

std::string example_of(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  for (const std::string& word : words) {
    const std::vector<const CLI::App*> known = command->get_subcommands({});
    const auto named = std::ranges::find(known, word, [](const CLI::App* one) { return one->get_name(); });
    if (named == known.end()) break;
    command = *named;
  }
  const std::string help = command->get_footer();
  for (const std::string_view mark : {"Example: ", "Examples: "})
    if (const std::size_t at = help.find(mark); at != help.npos)
      return help.substr(at + mark.size(), help.find('\n', at) - at - mark.size());
  return "";
}

std::string refusal_of(const CLI::ParseError& error, const std::string& command, const std::string& example) {
  const std::string_view theirs = error.what();
  std::string text(theirs);
  const bool of_a_check = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr;  // these speak our words
  for (const Sentence& one : sentences) {
    if (of_a_check || !theirs.starts_with(one.begins) || !theirs.ends_with(one.ends)) continue;
    const std::string_view inner =
        theirs.substr(one.begins.size(), theirs.size() - std::min(theirs.size(), one.begins.size() + one.ends.size()));
    const std::size_t mark = one.between.empty() ? inner.size() : inner.find(one.between);
    if (mark == inner.npos) continue;
    const std::string_view rest = inner.substr(std::min(mark + one.between.size(), inner.size()));
    text = fmt::format(fmt::runtime(one.ours), clipped(inner.substr(0, mark)), clipped(rest));
    break;
  }
  const bool lacks = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && !example.empty();
  if (text.find("\n  hint: ") == text.npos)
    text += lacks ? fmt::format("\n  hint: such as {}; see soilbin {}--help", example, command)
                  : fmt::format("\n  hint: see soilbin {}--help", command);
  return text;
}

std::string empty_text(const std::vector<std::string>& words) {
  std::string before = "an argument";
  for (const std::string& word : words) {
    const bool is_flag = word.starts_with("--"), lacks_value = is_flag && word.find('=') == word.size() - 1;
    if (word.empty() || lacks_value)
      return fmt::format(
          "{}: the text is empty\n  hint: give a value, or leave it out; a variable of the shell may not be set",
          lacks_value ? word.substr(0, word.size() - 1) : before);
    before = is_flag ? word : "an argument";
  }
  return "";
}

std::string unknown_flag(const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  for (const std::string& word : words) {
    if (word == "--") break;
    const std::string flag = word.substr(0, word.find('='));
    if (!flag.starts_with("--") || std::ranges::find(flags, flag) != flags.end()) continue;
    std::string hint = sent_elsewhere(command.get_name(), flag);
    if (!hint.empty()) return fmt::format("'{}' has no option '{}'\n  hint: {}", called(command), clipped(flag), hint);
    return fmt::format("'{}' has no option '{}'{}\n  hint: see soilbin {} --help", called(command), clipped(flag),
                       did_you_mean(flag, flags), called(command));
  }
  return "";
}

}  // namespace soilbin::cli
