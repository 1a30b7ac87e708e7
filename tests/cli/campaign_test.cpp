#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;

const char* const campaign = R"(format: soilbin-campaign/1
name: small
wheel: {radius: 0.11 m, width: 0.1 m}
soil:
  exponent: 1.1
  k_c: 0.99 kN/m^(n+1)
  k_phi: 1528 kN/m^(n+2)
  cohesion: 1.04 kPa
  friction_angle: 28 deg
  shear_modulus: {value: 20 mm, sd: 6 mm}
  stress_angle_c1: 0.18
  stress_angle_c2: 0.32
  density: 1600 kg/m^3
)";

TEST(Predict, EveryRowOfTheCmuCampaignIsAnswered) {
  const Outcome r = soilbin("predict cmu-smooth --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json answer = r.json();
  EXPECT_EQ(answer["format"], "soilbin-predict/1");
  ASSERT_EQ(answer["rows"].size(), 90U);
  std::size_t solved = 0;
  for (const auto& row : answer["rows"]) {
    EXPECT_TRUE(row["run"].is_number_integer());
    if (row.contains("error")) continue;
    ++solved;
    for (const char* key : {"drawbar_pull", "torque", "sinkage", "lateral_force", "theta_1"})
      EXPECT_TRUE(row.at(key).is_number()) << key;
    EXPECT_FALSE(row["residual"].empty()) << row["run"];
    for (const auto& [key, rest] : row["residual"].items())
      EXPECT_NEAR(row[key].get<double>() - row["measured"][key].get<double>(), rest.get<double>(), 1e-12);
  }
  EXPECT_GT(solved, 80U);
}

// What grains lack beside the analytic wheel under a heavy lugged tire on a measured sand.
TEST(SlowLoopOnGrains, NamesWhatAHeavyLuggedTireLacks) {
  const Scratch scratch;
  const std::string folder = "'" + (scratch / "told").string() + "'";
  ASSERT_EQ(soilbin("campaign heavy-lugged-cullinan --output " + folder).status, 0);
  const nlohmann::json answer = soilbin("loop " + folder + " --json").json();
  EXPECT_EQ(answer["verdict"], "effect_found");
  std::map<std::string, std::string> forms;
  for (const auto& effect : answer["effects"]) forms[effect["id"]] = effect["form"];
  EXPECT_EQ(forms.size(), 3U);
  EXPECT_EQ(forms["lug_thrust"], "tips");
  EXPECT_EQ(forms["shear_hump"], "carried");
  EXPECT_TRUE(forms.contains("slip_sinkage"));
}

// The table holds what --json holds, to the bit; an empty cell is a channel that was not measured.
TEST(Predict, SavesEachRunAsATableAndDrawsIt) {
  const Scratch scratch;
  const std::string csv = (scratch / "runs.csv").string(), plot = (scratch / "runs.pdf").string();
  const Outcome r = soilbin("predict cmu-smooth --json --csv '" + csv + "' --plot '" + plot + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(text_of(plot), testing::StartsWith("%PDF-"));
  std::istringstream table(text_of(csv));
  std::string line;
  std::getline(table, line);
  EXPECT_THAT(line, HasSubstr("drawbar_pull_measured_N,drawbar_pull_predicted_N,drawbar_pull_se_N"));
  const nlohmann::json rows = r.json()["rows"];
  for (const nlohmann::json& row : rows) {
    ASSERT_TRUE(std::getline(table, line));
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (row.contains("error")) continue;
    ASSERT_GE(cells.size(), 14U);
    const auto expect_rounded = [](const std::string& cell, double value) {  // tables hold 15 digits
      EXPECT_NEAR(std::stod(cell), value, 1e-14 * std::abs(value));
    };
    expect_rounded(cells[9], row["measured"]["drawbar_pull"]);
    expect_rounded(cells[10], row["drawbar_pull"]);
    EXPECT_EQ(cells[12], "") << "no torque was measured";
    expect_rounded(cells[13], row["torque"]);
  }
  EXPECT_FALSE(std::getline(table, line));
  EXPECT_THAT(text_of(csv), HasSubstr(",,the wheel sinks 68 % of its radius")) << "a remark of its row";
}

TEST(Predict, WhatCheckDoubtsIsToldBeforeTheAnswer) {
  const Scratch scratch;
  scratch.write("campaign.yaml", campaign);
  scratch.write("runs.csv", "run,load_N,slip,sinkage_m\n1,80,0.1,0.01\n2,80,0.2,0.02\n2,80,0.2,0.02\n");
  const std::string folder = "'" + (scratch / "").string() + "'";
  const Outcome checked = soilbin("check " + folder), predicted = soilbin("predict " + folder + " --json");
  EXPECT_EQ(predicted.status, 0);
  EXPECT_EQ(predicted.err, "warning: line 4: all its values are those of line 3: counted twice\n");
  EXPECT_THAT(checked.out, HasSubstr(predicted.err));
}

TEST(Predict, AHopelessRowCarriesItsErrorAndRowsAreNumberedWhereNoRunIs) {
  const Scratch scratch;
  scratch.write("c/campaign.yaml", campaign);
  scratch.write("c/runs.csv", "load_N,slip,drawbar_pull_N\n80,0.2,1.0\n900000,0.2,5.0\n80,0.4,3.0\n");
  const Outcome r = soilbin("predict '" + (scratch / "c").string() + "' --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json rows = r.json()["rows"];
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1]["run"], 2);
  EXPECT_THAT(rows[1]["error"].get<std::string>(), HasSubstr("sink deeper"));
  EXPECT_TRUE(rows[0].contains("drawbar_pull"));
  EXPECT_TRUE(rows[2].contains("drawbar_pull"));
}

TEST(Predict, AResolvedModelReplacesTheDeclaredSoilAndEffects) {
  const Scratch scratch;
  scratch.write("c/campaign.yaml", campaign);
  scratch.write("c/runs.csv", "load_N,slip,drawbar_pull_N\n80,0.2,1.0\n80,0.4,3.0\n");
  const fs::path model = scratch.write("model.yaml", R"(format: soilbin-case/1
name: fitted
tire: {radius: 110 mm, width: 100 mm}
soil: dry-sand
study:
  models: [{model: bekker_wong, effects: [slip_sinkage]}]
  conditions: {load: 80 N, slip: 20 %}
)");
  const std::string predict = "predict '" + (scratch / "c").string() + "' --json";
  const nlohmann::json declared = soilbin(predict).json()["rows"];
  const nlohmann::json fitted = soilbin(predict + " --model '" + model.string() + "'").json()["rows"];
  EXPECT_GT(fitted[1]["sinkage"].get<double>(), 1.2 * declared[1]["sinkage"].get<double>());
}

// To first order a prediction's standard error is as large as that of the one uncertain value: twice K's, twice the
// pull's. Beside it stands the label that the campaign gave the row.
TEST(Predict, ShowsStandardErrorsAndTheCampaignsLabels) {
  const Scratch scratch;
  const auto predict = [&](const std::string& yaml, const std::string& flags) {
    scratch.write("c/campaign.yaml", yaml);
    scratch.write("c/runs.csv", "setpoint,load_N,slip,drawbar_pull_N\nsoft start,80,0.2,1.0\n,80,0.4,3.0\n");
    return soilbin("predict '" + (scratch / "c").string() + "' " + flags);
  };
  std::string doubled = campaign;
  doubled.replace(doubled.find("sd: 6 mm"), 8, "sd: 12 mm");
  const auto pull_error = [&](const std::string& yaml) {
    return predict(yaml, "--json").json()["rows"][0]["std_error"]["drawbar_pull"].get<double>();
  };
  EXPECT_GT(pull_error(campaign), 0.1);
  EXPECT_NEAR(pull_error(doubled), 2 * pull_error(campaign), 1e-3 * pull_error(campaign));
  const std::string text = predict(campaign, "").out;
  EXPECT_THAT(text, testing::ContainsRegex("soft start .* 1.000  +-?[0-9.]+ ± [0-9.]+ "));
  EXPECT_THAT(text, HasSubstr("± is one standard error from the standard deviations of K; "));
}

TEST(Predict, RefusesABadCampaignWithFileAndLine) {
  const Scratch scratch;
  scratch.write("c/campaign.yaml", campaign);
  scratch.write("c/runs.csv", "load_N,slip,drawbar_pull_N\n80,zero,1.0\n");
  EXPECT_THAT(soilbin("predict '" + (scratch / "c").string() + "' --json"), Refuses(HasSubstr("runs.csv:2:")));
  EXPECT_THAT(soilbin("predict cmu-smoth").err, HasSubstr("did you mean 'cmu-smooth'?"));
}

// What a person wrote is never lost to what a command makes of it, by whatever name, before any work.
TEST(Outputs, NeverTakeThePlaceOfWhatTheCommandReads) {
  const Scratch scratch;
  scratch.write("c/campaign.yaml", campaign);
  scratch.write("c/runs.csv", "load_N,slip,drawbar_pull_N\n80,0.2,1.0\n80,0.4,3.0\n");
  scratch.write("mine/case.yaml",
                "format: soilbin-case/1\nname: mine\ntire: rover-wheel\nsoil: dry-sand\n"
                "study: {conditions: [{load: 80 N, slip: 20 %}]}\n");
  fs::create_symlink(scratch / "c/runs.csv", scratch / "link.csv");
  const std::string here = (scratch / "").string();
  struct Asked {
    std::string command, file, flag;
  };
  for (const Asked& asked :
       {Asked{"predict " + here + "c --csv " + here + "c/runs.csv", "c/runs.csv", "--csv"},
        {"predict " + here + "c --csv " + here + "link.csv", "c/runs.csv", "--csv"},
        {"loop " + here + "c --save-model " + here + "c/campaign.yaml", "c/campaign.yaml", "--save-model"},
        {"run " + here + "mine/case.yaml --csv " + here + "mine/../mine/case.yaml", "mine/case.yaml", "--csv"},
        {"run " + here + "mine/case.yaml --output " + here + "mine", "mine/case.yaml", "--output"},
        {"report " + here + "mine/case.yaml --output " + here + "mine/case.yaml", "mine/case.yaml", "--output"}}) {
    const std::string before = text_of(scratch / asked.file);
    const Outcome outcome = soilbin(asked.command);
    EXPECT_EQ(outcome.status, 2) << asked.command;
    EXPECT_EQ(outcome.out, "") << asked.command;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(asked.file + ": " + asked.flag + " would write over this file"),
                                   HasSubstr("hint: give " + asked.flag + " another name")));
    EXPECT_EQ(text_of(scratch / asked.file), before) << asked.command;
  }
}

TEST(Check, ValidFilesPassAndNonsenseIsWarnedOf) {
  for (const char* name : {"paper-straight", "cmu-smooth", "dry-sand", "rover-wheel"}) {
    const Outcome r = soilbin(std::string("check ") + name);
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("valid: "));
  }
  const Scratch scratch;
  const fs::path file = scratch.write("case.yaml", R"(format: soilbin-case/1
name: nonsense
tire: {radius: 50 mm, width: 200 mm}
soil:
  semi_empirical: {exponent: 1.9, k_c: 1 kN/m^(n+1), k_phi: 3000 kN/m^(n+2), cohesion: 0 kPa, friction_angle: 0 deg,
    shear_modulus: 200 mm, stress_angle_c1: 0.8, stress_angle_c2: 0.5, density: 9000 kg/m^3}
study:
  conditions: {load: [100 N, 1000 kN], slip: 20 %}
)");
  const Outcome r = soilbin("check '" + file.string() + "' --json");
  EXPECT_EQ(r.status, 0) << r.err;
  const std::string kinds = r.json()["warning_kinds"].dump();
  for (const char* kind : {"unusual_exponent", "no_strength", "unusual_density", "stress_angles_limited",
                           "unusual_shear_modulus", "no_solution", "wider_than_high"})
    EXPECT_THAT(kinds, HasSubstr(kind));
}

TEST(Check, AStoreOfAFailureMapIsRead) {
  const Outcome r = soilbin("check '" SOILBIN_SOURCE_DIR "/cases/failure_maps/paper-longitudinal.json'");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, testing::MatchesRegex("valid: store of [0-9]+ experiments\nno warnings\n"));
}

}  // namespace
}  // namespace soilbin::cli::test
