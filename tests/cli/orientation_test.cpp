// The commands that help a person find the way: help, init, list, schema, doctor.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Help, OfTheProgramAndOfEveryCommand) {
  const Outcome all = soilbin("--help");
  EXPECT_EQ(all.status, 0);
  EXPECT_EQ(soilbin("").status, 2);
  EXPECT_EQ(soilbin("--version").status, 0);
  for (const char* command :
       {"estimate", "explain", "run", "predict", "report", "check", "init", "list", "schema", "doctor"}) {
    EXPECT_THAT(all.out, HasSubstr(command));
    const Outcome one = soilbin(std::string(command) + " --help");
    EXPECT_EQ(one.status, 0) << command;
    EXPECT_THAT(one.out, HasSubstr("Usage")) << command;
  }
}

TEST(Init, WritesACaseThatRunsAndNeverOverwrites) {
  const Scratch scratch;
  const std::string folder = (scratch / "new").string();
  EXPECT_EQ(soilbin("init '" + folder + "'").status, 0);
  const std::string before = text_of(fs::path(folder) / "case.yaml");
  EXPECT_EQ(soilbin("check '" + folder + "/case.yaml'").status, 0);
  const Outcome run = soilbin("run '" + folder + "/case.yaml' --json");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json()["rows"].size(), 2U * 2U * 7U);
  EXPECT_THAT(soilbin("init '" + folder + "'"), Refuses(HasSubstr("stays as it is")));
  EXPECT_EQ(text_of(fs::path(folder) / "case.yaml"), before);
}

TEST(Init, NamesTheSchemaForEditorsWhereItWasWritten) {
  const Scratch scratch;
  const std::string folder = (scratch / "new").string();
  ASSERT_EQ(soilbin("init '" + folder + "'").status, 0);
  std::ifstream file(fs::path(folder) / "case.yaml");
  std::string line;
  std::getline(file, line);
  constexpr std::string_view mark = "# yaml-language-server: $schema=";
  ASSERT_TRUE(line.starts_with(mark)) << line;
  const nlohmann::json schema = nlohmann::json::parse(text_of(line.substr(mark.size())));
  EXPECT_EQ(schema["properties"]["format"]["const"], "soilbin-case/1");
}

TEST(Version, TellsCommitBuildAndCompiler) {
  EXPECT_THAT(soilbin("--version").out,
              testing::MatchesRegex(
                  "soilbin [0-9.]+ \\((commit [0-9a-f]+(-dirty)?|release [0-9.]+), [A-Za-z]+, GNU [0-9.]+\\)\n"));
}

TEST(Manual, DescribesEveryCommandAndFlagOfTheHelp) {
  const std::string page = soilbin("manual").out;
  EXPECT_THAT(page, testing::StartsWith(".TH SOILBIN 1"));
  for (const char* command : {"estimate", "run", "loop", "failure\\-map", "doctor"})
    EXPECT_THAT(page, HasSubstr(std::string("\n.SS ") + command + "\n"));
  for (const char* flag : {"\\-\\-slip", "\\-\\-save\\-model", "\\-\\-record"}) EXPECT_THAT(page, HasSubstr(flag));
  EXPECT_THAT(page, HasSubstr("SOILBIN_BEDS"));
}

TEST(Manual, ListsTheSameForTheDocuments) {
  const std::string page = soilbin("manual --markdown").out;
  EXPECT_THAT(page, testing::StartsWith("# The commands\n"));
  for (const char* command : {"estimate", "run", "loop", "failure-map", "doctor"}) {
    EXPECT_THAT(page, HasSubstr(fmt::format("\n| [{0}](#{0}) | ", command)));
    EXPECT_THAT(page, HasSubstr(fmt::format("\n## {}\n", command)));
  }
  for (const char* flag : {"| `--slip` ", "| `--save-model` ", "| `--record` "}) EXPECT_THAT(page, HasSubstr(flag));
}

TEST(Manual, CompletesInBash) {
  const Scratch scratch;
  const std::string script = (scratch / "completion").string();
  std::ofstream(script) << soilbin("manual --bash-completion").out;
  const auto completed = [&](const std::string& words, int at) {
    const fs::path typed =
        scratch.write("typed", ". " + script + "; COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(at) +
                                   "; _soilbin; echo ${COMPREPLY[*]}");
    const std::string line = "bash '" + typed.string() + "' >'" + (scratch / "answer").string() + "'";
    EXPECT_EQ(std::system(line.c_str()), 0);
    return text_of(scratch / "answer");
  };
  EXPECT_EQ(completed("soilbin est", 1), "estimate\n");
  EXPECT_EQ(completed("soilbin estimate --lug-h", 2), "--lug-height\n");
}

TEST(List, EveryShelfAndTheCatalogue) {
  for (const char* what : {"soils", "tires", "studies", "measured", "vehicles", "effects"}) {
    const Outcome r = soilbin(std::string("list ") + what);
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, testing::Not(HasSubstr("unreadable"))) << what;
    const nlohmann::json json = soilbin(std::string("list --json ") + what).json();
    EXPECT_GT(json[what].size(), 2U) << what;
  }
  EXPECT_THAT(soilbin("list effects").out, HasSubstr("theta_c = 5.73 deg, from 0 deg to 34.38 deg"));
  for (const auto& form : soilbin("list effects --json").json()["effects"]) {
    const std::string name = form["form"];
    EXPECT_EQ(form["sinkage_from_rut_floor"].get<bool>(),
              form["id"] == "multipass" && name != "rut_power" && name != "reload_from_surface")
        << name;
  }
  EXPECT_THAT(soilbin("list soils").out, AllOf(HasSubstr(" 1.04 ± 0.10* "), HasSubstr("*: an assumed standard dev")));
  EXPECT_THAT(soilbin("list soil").err, HasSubstr("did you mean 'soils'?"));
}

TEST(List, WithoutAWordTellsWhatEachNameIs) {
  const Outcome r = soilbin("list");
  EXPECT_EQ(r.status, 0) << r.err;
  for (const char* line : {"Tires and wheels (soilbin list tires)", "Wheels of planetary rovers",
                           "Mars rover Curiosity", "Straight driving: drawbar pull"})
    EXPECT_THAT(r.out, HasSubstr(line));
  const nlohmann::json shelves = soilbin("list --json").json();
  for (const char* shelf : {"soils", "tires", "studies", "measured", "vehicles"})
    for (const auto& entry : shelves[shelf]) EXPECT_NE(entry["description"], "") << entry["name"];
}

TEST(Schema, IsJsonForEachFormat) {
  for (const char* what : {"case", "tire", "soil", "campaign", "vehicle"}) {
    const Outcome r = soilbin(std::string("schema ") + what);
    ASSERT_EQ(r.status, 0) << r.err;
    const nlohmann::json schema = r.json();
    EXPECT_TRUE(schema.contains("properties")) << what;
    EXPECT_EQ(schema["properties"]["format"]["const"], std::string("soilbin-") + what + "/1");
  }
  EXPECT_EQ(soilbin("schema tyre").status, 2);
}

TEST(Doctor, IsWellAndSaysWhereTheLibraryIs) {
  const Outcome r = soilbin("doctor");
  EXPECT_EQ(r.status, 0) << r.out;
  for (const char* word : {"compiler", "GSL", "yaml-cpp", "Library of cases", "pass", "two independent codes",
                           "inputs of Azimi and others 2013"})
    EXPECT_THAT(r.out, HasSubstr(word));
  EXPECT_EQ(soilbin("doctor --json").json()["self_test"].size(), 5U);
}

TEST(Library, TheEnvironmentGoesFirst) {
  const Scratch scratch;
  scratch.write("mine/soils/secret-sand.yaml", text_of(fs::path(SOILBIN_SOURCE_DIR) / "cases/soils/dry-sand.yaml"));
  ::setenv("SOILBIN_CASES", (scratch / "mine").c_str(), 1);
  const Outcome r = soilbin("list soils");
  ::unsetenv("SOILBIN_CASES");
  EXPECT_THAT(r.out, HasSubstr("secret-sand"));
  EXPECT_THAT(r.out, HasSubstr("dry-sand"));
}

}  // namespace
}  // namespace soilbin::cli::test
