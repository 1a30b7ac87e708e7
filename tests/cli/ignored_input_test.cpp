// What is given and changes nothing of the answer is refused or doubted: every flag of every command that answers.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <vector>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A flag as --help shows it, and the heading that it stands under.
struct ShownFlag {
  std::string name, heading;
};

std::vector<ShownFlag> flags_of(const std::string& command) {
  std::istringstream help(soilbin(command + " --help").out);
  std::vector<ShownFlag> flags;
  std::string heading;
  const std::regex flag(R"(^  (?:-h,)?(--[a-z0-9-]+).*)");
  for (std::string line; std::getline(help, line);) {
    std::smatch found;
    if (std::regex_match(line, found, flag)) flags.push_back({found[1], heading});
    if (!line.empty() && line.front() != ' ' && line.back() == ':') heading = line;
  }
  return flags;
}

/// What the flag is given, as for a shell; a value that is not the default.
const std::map<std::string, std::string>& samples() {
  static const std::map<std::string, std::string> all = {
      {"--radius", "120mm"},
      {"--width", "110mm"},
      {"--inflation-pressure", "50kPa"},
      {"--carcass-pressure", "20kPa"},
      {"--section-height", "60mm"},
      {"--construction", "radial"},
      {"--lug-height", "9mm"},
      {"--lug-count", "13"},
      {"--lug-thickness", "4mm"},
      {"--lug-pattern", "chevron"},
      {"--lug-angle", "30deg"},
      {"--exponent", "0.9+-0.1"},
      {"--k-c", "'2 kN/m^(n+1)'"},
      {"--k-phi", "'900 kN/m^(n+2)'"},
      {"--cohesion", "2kPa"},
      {"--friction-angle", "25deg"},
      {"--shear-modulus", "12mm"},
      {"--stress-angle-c1", "0.3"},
      {"--stress-angle-c2", "0.2"},
      {"--density", "1100kg/m^3"},
      {"--gravity", "3m/s^2"},
      {"--reference-sinkage", "50mm"},
      {"--load", "75N"},
      {"--slip", "25%"},
      {"--speed", "0.5m/s"},
      {"--longitudinal-incline", "4deg"},
      {"--transverse-incline", "5deg"},
      {"--yaw", "7deg"},
      {"--pass", "2"},
      {"--slip-by", "travel_speed"},
      {"--force-frame", "wheel"},
      {"--moisture", "9%"},
      {"--position", "2m"},
      {"--run", "4"},
      {"--effect", "slip_sinkage"},
      {"--model", "rft"},
      {"--no-assumed-sd", ""},
      {"--rigid", ""},
      {"--no-lugs", ""},
      {"--max-slip", "30%"},
      {"--decimal-comma", ""},
      {"--soil", "sandy-loam"},
      {"--tire", "rover-wheel"},
      {"--bin-depth", "0.4m --bin-width=0.5m"},  // one needs the other
      {"--bin-width", "0.5m --bin-depth=0.4m"}};
  return all;
}

std::string typed(const std::string& flag) {
  const std::string& value = samples().at(flag);
  return " " + flag + (value.empty() ? "" : "=" + value);
}

/// The rows of an answer without the condition that they repeat.
std::string answers_of(const nlohmann::json& document) {
  nlohmann::json rows = document.at("rows");
  for (nlohmann::json& row : rows)
    for (const char* key : {"label", "load", "slip", "speed", "longitudinal_incline", "transverse_incline", "yaw",
                            "pass", "slip_by", "force_frame", "moisture", "position", "run"})
      row.erase(key);
  return rows.dump();
}

std::set<std::string> warnings_of(const nlohmann::json& document) {
  std::set<std::string> all;
  for (const auto& warning : document.value("warnings", nlohmann::json::array())) all.insert(warning);
  return all;
}

/// Whether the flag changes the answer that is had without it, is refused, or is met by a warning that wasn't there.
void expect_it_is_not_ignored(const std::string& asked, const nlohmann::json& plain, const std::string& flag) {
  SCOPED_TRACE(asked + typed(flag));
  const Outcome with = soilbin(asked + typed(flag) + " --json");
  if (with.status == 2) {
    EXPECT_THAT(with.err, HasSubstr(flag));
    return;
  }
  ASSERT_EQ(with.status, 0) << with.err;
  const nlohmann::json changed = with.json();
  if (answers_of(changed) != answers_of(plain)) return;
  const std::set<std::string> before = warnings_of(plain), after = warnings_of(changed);
  EXPECT_FALSE(std::includes(before.begin(), before.end(), after.begin(), after.end()))
      << "changes nothing, without a word";
}

/// Effects that leave speed, passes, density or the lugs' number unread, and some that read them.
const char* const settings[] = {"", " --lug-height=8mm --effect=lug_thrust", " --effect=bulldozing --yaw=5deg",
                                " --effect=rate_dependence --effect=hard_layer",
                                " --inflation-pressure=60kPa --effect=tire_flexibility"};

TEST(SlowIgnoredInput, EveryFlagOfAQuestionChangesTheAnswerOrIsDoubted) {
  const std::set<std::string> outputs = {"--help", "--plot", "--csv", "--json", "--report", "--markdown"};
  const std::set<std::string> needed = {"--tire", "--radius", "--width", "--soil", "--load", "--slip"};
  const std::string wheel = " --radius=110mm --width=100mm --soil=dry-sand --load=80N";
  for (const std::string command : {"estimate", "limits"}) {
    const std::vector<ShownFlag> flags = flags_of(command);
    EXPECT_GT(flags.size(), 30U);
    for (const std::string setting : settings) {
      if (command == "limits" && setting != settings[0] && setting != settings[1]) continue;
      const std::string asked = command + wheel + (command == "limits" ? "" : " --slip=20%") + setting;
      const nlohmann::json plain = soilbin(asked + " --json").json();
      for (const ShownFlag& flag : flags) {
        if (outputs.contains(flag.name) || needed.contains(flag.name)) continue;
        ASSERT_TRUE(samples().contains(flag.name)) << "a new flag: give it a sample, " << flag.name;
        if (setting.find(" " + flag.name + "=") == std::string::npos) expect_it_is_not_ignored(asked, plain, flag.name);
      }
    }
  }
}

/// A command that answers in JSON, and for each of its flags that is no output a value that matters.
struct Asking {
  std::string name, words;
  std::map<std::string, std::string> values;
};

/// Its answer without the words that it was asked by, and its warnings.
std::string answer_text(nlohmann::json document) {
  for (const char* echo : {"command", "words"}) document.erase(echo);
  return document.dump();
}

TEST(SlowIgnoredInput, EveryFlagOfOtherCommandsChangesTheAnswerOrIsRefused) {
  const Scratch scratch;
  std::string plates = "test,box,plate_diameter_mm,sinkage_mm,pressure_kPa\n";
  for (int test = 1; test <= 6; ++test)
    for (int z = 2; z <= 16; z += 2) {
      const double diameter = test % 2 == 0 ? 150 : 100, share = test > 4 ? 1.3 : 1.0;
      plates += std::to_string(test) + (test > 4 ? ",b," : ",a,") + std::to_string(diameter) + "," + std::to_string(z) +
                "," + std::to_string(share * (20 / diameter + 1) * std::pow(z, 1.0 + 0.01 * z)) + "\n";
    }
  const std::string readings = "'" + scratch.write("plates.csv", plates).string() + "'";
  const std::string model = "'" +
                            scratch
                                .write("model.yaml",
                                       "format: soilbin-case/1\nname: m\ntire: rover-wheel\nsoil: "
                                       "sandy-loam\nstudy:\n  models: [bekker_wong]\n  conditions: "
                                       "{load: 60 N, slip: 20 %}\n")
                                .string() +
                            "'";
  const std::string record = "'" SOILBIN_SOURCE_DIR "/cases/studies/recorded/paper-straight.json'";
  const Asking all[] = {
      {"plates",
       readings,
       {{"--only", "box=a"},
        {"--by", "box"},
        {"--density", "1500kg/m^3"},
        {"--pressure", "5kPa..15kPa"},
        {"--plate", "100mm"}}},
      {"predict", "made-lesson", {{"--model", model}}},
      {"design",
       "made-lesson --runs=8 --effect=slip_sinkage",
       {{"--runs", "9"},
        {"--limit", "slip=0%..20%"},
        {"--effect", "bulldozing"},
        {"--noise", "drawbar_pull=5N"},
        {"--seed", "2"}}},
      {"reproduce", "", {{"--recorded", record}}},
      {"loop",
       "made-lesson --folds=2",
       {{"--next", ""}, {"--limit", "slip=0%..20%"}, {"--folds", "3"}, {"--seed", "2"}, {"--details", ""}}}};
  const std::set<std::string> outputs = {"--help",   "--plot",     "--csv",           "--json",
                                         "--report", "--markdown", "--decimal-comma", "--save-model"};
  for (const Asking& asking : all) {
    const Outcome plain = soilbin(asking.name + " " + asking.words + " --json");
    ASSERT_EQ(plain.status, 0) << asking.name << plain.err;
    for (const ShownFlag& flag : flags_of(asking.name)) {
      if (outputs.contains(flag.name)) continue;
      ASSERT_TRUE(asking.values.contains(flag.name)) << "a new flag: give it a value, " << asking.name << flag.name;
      const std::string& value = asking.values.at(flag.name);
      std::string words = asking.words;  // a flag that counts once takes the place of its own
      if (const std::size_t own = words.find(flag.name + "="); own != std::string::npos && flag.name != "--effect")
        words.erase(own, words.find(' ', own) - own);
      const std::string asked = asking.name + " " + words + " " + flag.name + (value.empty() ? "" : "=" + value);
      const Outcome with = soilbin(asked + " --json");
      if (with.status == 2) {
        EXPECT_THAT(with.err, HasSubstr(flag.name)) << asked;
        continue;
      }
      ASSERT_EQ(with.status, 0) << asked << with.err;
      EXPECT_NE(answer_text(with.json()), answer_text(plain.json())) << asked << " changes nothing, without a word";
    }
  }
}

TEST(IgnoredInput, IsToldWithWhatReadsIt) {
  const std::string ask =
      "estimate --radius=110mm --width=100mm --soil=dry-sand --load=80N --slip=20% --lug-height=8mm "
      "--effect=lug_thrust ";
  EXPECT_THAT(soilbin(ask + "--lug-count=24").err,
              AllOf(HasSubstr("the number of lugs is ignored: add --effect "), HasSubstr("lug_thrust:passive_blade")));
  EXPECT_EQ(soilbin(ask + "--lug-count=24 --effect=none").status, 2) << "none stands alone";
  EXPECT_THAT(soilbin(ask + "--lug-pattern=chevron").err,
              HasSubstr("the lugs' pattern is ignored: only grains have it, --model dem"));
  EXPECT_THAT(soilbin(ask + "--speed=1m/s").err, HasSubstr("the speed is ignored: add --effect rate_dependence or "));
  EXPECT_THAT(soilbin(ask + "--carcass-pressure=20kPa").err,
              HasSubstr("the carcass pressure is ignored: add --effect tire_flexibility"));
  EXPECT_THAT(soilbin(ask + "--density=1100kg/m^3").err, HasSubstr("the soil's density is ignored"));
  EXPECT_THAT(soilbin(ask + "--force-frame=wheel").err,
              HasSubstr("'force_frame' is ignored: no condition has a 'yaw'"));
  EXPECT_EQ(soilbin(ask).err, "");
}

// A speed in a case's file too, but not one that follows from a rotation.
TEST(IgnoredInput, ASpeedOfACaseIsToldWhereNoModelReadsIt) {
  const Scratch scratch;
  const auto warned = [&](const std::string& models, const std::string& speed) {
    const fs::path file = scratch.write(
        "case.yaml", "format: soilbin-case/1\nname: c\ntire: rover-wheel\nsoil: dry-sand\nstudy:\n  models: [" +
                         models + "]\n  conditions: {load: 60 N, slip: 20 %, " + speed + "}\n");
    const Outcome r = soilbin("run '" + file.string() + "'");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err.find("the speed is ignored: add --effect rate_dependence") != std::string::npos;
  };
  EXPECT_TRUE(warned("bekker_wong", "speed: 2 m/s"));
  EXPECT_TRUE(warned("bekker_wong", "speed: [0.1 m/s, 1 m/s]"));
  EXPECT_FALSE(warned("{model: bekker_wong, effects: [rate_dependence]}", "speed: 2 m/s"));
  EXPECT_FALSE(warned("bekker_wong", "speed: 0.1 m/s")) << "the default";
  EXPECT_FALSE(warned("bekker_wong", "rotation: 10 rpm"));
}

/// Sample values of the flags of grains: readable ones, so that only their being given is at fault.
std::string sample_of_grains(const std::string& flag, const Scratch& scratch) {
  const std::map<std::string, std::string> values = {{"--bed-length", "2m"},
                                                     {"--bed-width", "0.9m"},
                                                     {"--bed-depth", "0.4m"},
                                                     {"--graded", "2"},
                                                     {"--graded-for", "50mm"},
                                                     {"--behind", "0.4m"},
                                                     {"--ahead", "0.6m"},
                                                     {"--travel", "1m"},
                                                     {"--lowering", "0.4s"},
                                                     {"--resting", "0.1s"},
                                                     {"--tilting", "0.1s"},
                                                     {"--time-step", "0.01ms"},
                                                     {"--sleep", "0"},
                                                     {"--deepest-overlap", "0.4"},
                                                     {"--wheel-mesh", "no-such.stl"},
                                                     {"--packing", "2"},
                                                     {"--settling-friction", "dense"},
                                                     {"--threads", "2"},
                                                     {"--starting", "0.1s"},
                                                     {"--patch", ""},
                                                     {"--until-error", "0.02"},
                                                     {"--packings", "3"},
                                                     {"--half-step", "yes"},
                                                     {"--coarser-twin", ""},
                                                     {"--engine", "lammps"},
                                                     {"--ranks", "2"},
                                                     {"--settled-by", "soilbin"},
                                                     {"--shard", "1/2"},
                                                     {"--known", "no-such.json"},
                                                     {"--converge", ""},
                                                     {"--dry-run", ""},
                                                     {"--ledger", ""},
                                                     {"--record", (scratch / "record.json").string()},
                                                     {"--replay", (scratch / "run.replay").string()},
                                                     {"--paraview", (scratch / "views").string()}};
  const auto found = values.find(flag);
  if (found == values.end()) return "";
  return " " + flag + (found->second.empty() ? "" : "=" + found->second);
}

// None of them is read by the analytic model, so none may be given to it: the smooth wheel's answer was given for a
// mesh that isn't there.
TEST(SlowIgnoredInput, FlagsOfGrainsAreRefusedWhereNoGrainsAreAsked) {
  const Scratch scratch;
  const std::map<std::string, std::set<std::string>> read = {{"run rover-slip", {"--recorded"}},
                                                             {"compare rover-slip --no-loop", {"--recorded"}},
                                                             {"drive rover-climb", {"--threads"}}};
  for (const auto& [command, but] : read) {
    std::size_t refused = 0;
    for (const ShownFlag& flag : flags_of(command.substr(0, command.find(' ')))) {
      if (flag.heading.find("Grains") == std::string::npos || but.contains(flag.name)) continue;
      const std::string given = sample_of_grains(flag.name, scratch);
      ASSERT_FALSE(given.empty()) << "a new flag of grains: give it a sample, " << flag.name;
      const Outcome r = soilbin(command + given);
      EXPECT_EQ(r.status, 2) << command << given;
      EXPECT_THAT(r.err, AllOf(HasSubstr(flag.name), HasSubstr("hint: --model dem"))) << command << given;
      EXPECT_EQ(r.out, "");
      ++refused;
    }
    EXPECT_GE(refused, 15U) << command;
  }
  const Outcome drawn = soilbin("run rover-slip --model rft --wheel-mesh no-such.stl");
  EXPECT_THAT(drawn.err, HasSubstr("no-such.stl")) << "resistive force theory reads it";
  const Outcome several = soilbin("run rover-slip --packings=3 --graded=2");
  EXPECT_THAT(several.err, HasSubstr("--graded, --packings have no effect on the analytic model"));
}

TEST(IgnoredInput, BesideARecordNoFlagOfRunsIsTaken) {
  for (const char* flag :
       {"--packings=3", "--threads=2", "--half-step=yes", "--coarser-twin", "--dry-run", "--engine=lammps"})
    EXPECT_THAT(soilbin(std::string("run paper-straight --recorded ") + flag).err, HasSubstr("on recorded runs"))
        << flag;
}

// The bed is as wide and deep as the bin that the case declares.
TEST(IgnoredInput, TheBinOfACaseGoesBeforeTheBedsFlags) {
  for (const char* command :
       {"run paper-smooth --model dem --dry-run", "bed paper-smooth", "sweep paper-smooth --on local"})
    EXPECT_THAT(soilbin(std::string(command) + " --bed-depth 0.4m").err,
                HasSubstr("--bed-depth has no effect beside the case's bin, whose 0.3 m the bed takes"))
        << command;
  EXPECT_THAT(soilbin("bed paper-straight --travel 1m").err, HasSubstr("'bed' has no option '--travel'"));
}

TEST(IgnoredInput, OfOtherCommands) {
  const std::pair<const char*, const char*> wrong[] = {
      {"compare rover-slip --effect bulldozing --no-loop --title T", "--title is the title of a page"},
      {"compare rover-slip --effect bulldozing --no-loop --seed 3", "--seed is the loop's"},
      {"loop made-lesson --details", "--details"},
      {"loop made-lesson --next --json", "exclude each other"},
      {"sweep status somewhere --shards 3", "--shards has no effect on a status"},
      {"sweep paper-straight --on local --json", "--json is for the status"},
      {"sweep paper-straight --on local --shards 2 --at-least 60s", "exclude each other"},
      {"sweep paper-straight --on slurm --at-once 2", "--at-once has no effect on Slurm's jobs"},
      {"run paper-straight --model dem --dry-run --until-error 0.02", "--until-error has no effect"},
      {"run paper-straight --model dem --dry-run --graded-for 50mm", "--graded-for has no effect"},
      {"run paper-straight --model dem --dry-run --until-error 0.02 --patch --travel 1m",
       "--until-error has no effect"},
      {"record show no-such.json --packings 3", "--packings is about the runs that are missing"},
      {"element-test repose paper-sand --settling-friction dense", "takes no --settling-friction"},
      {"calibrate paper-sand --across 9", "--across has no effect on sand on sand"},
      {"calibrate paper-sand --contact tire --target board_angle=31deg --strength residual",
       "--strength has no effect on the tilting board"}};
  for (const auto& [command, says] : wrong) EXPECT_THAT(soilbin(command), Refuses(HasSubstr(says))) << command;
}

}  // namespace
}  // namespace soilbin::cli::test
