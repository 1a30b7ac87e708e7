// soilbin drive and soilbin limits, as a person types them.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "cli/command.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* short_drive = R"(format: soilbin-case/1
name: start
tire: rover-wheel
soil: dry-sand
drive:
  load: 64.68 N
  duration: 3 s
  controller: {rim_speed: 5 cm/s}
)";

TEST(Drive, TheRoverClimbsUntilItIsStuckNearTheSteepestSlope) {
  const Outcome r = soilbin("drive rover-climb --json --samples 50");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json drive = r.json();
  EXPECT_EQ(drive["format"], "soilbin-drive/1");
  EXPECT_EQ(drive["end"], "stuck");
  const nlohmann::json& slope = drive["samples"]["longitudinal_incline_deg"];
  const double steepest = drive["steepest_steady_slope"].get<double>() * 180 / 3.14159265358979;
  EXPECT_NEAR(slope.back().get<double>(), steepest, 0.7);
  const nlohmann::json& energy = drive["energy"];
  EXPECT_LT(std::abs(energy["unaccounted"].get<double>()), 1e-5 * energy["motor"].get<double>());
  for (const auto& [name, values] : drive["samples"].items())
    EXPECT_EQ(values.size(), drive["samples"]["time_s"].size()) << name;
}

TEST(Drive, SpeaksWritesTableAndPage) {
  const Scratch scratch;
  const std::string file = scratch.write("start.yaml", short_drive).string(), csv = (scratch / "t.csv").string(),
                    page = (scratch / "p.html").string(), plot = (scratch / "p.svg").string();
  const Outcome r = soilbin("drive '" + file + "' --csv '" + csv + "' --report '" + page + "' --plot '" + plot + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("Time is up after 3 s"), HasSubstr("shears the soil")));
  const std::string table = text_of(csv);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 402) << "a heading and 401 samples";
  EXPECT_THAT(table, testing::StartsWith("time_s,travelled_m,speed_m_s"));
  EXPECT_THAT(text_of(page), AllOf(HasSubstr("Against time"), HasSubstr("<svg")));
  EXPECT_THAT(text_of(plot), HasSubstr("Sinkage [mm]"));
  std::set<std::string> strokes;  // colour and dash of each entry of the legend, which stands at the end
  const std::string drawn = text_of(plot), legend = drawn.substr(drawn.find("speed: travel") - 200);
  const std::regex entry(
      R"re(<line (class="s c\d" stroke="#[0-9a-f]+"(?: stroke-dasharray="[0-9 ]+")?) stroke-width)re");
  std::size_t entries = 0;
  for (auto at = std::sregex_iterator(legend.begin(), legend.end(), entry); at != std::sregex_iterator(); ++at)
    strokes.insert((*at)[1]), ++entries;
  EXPECT_EQ(entries, 12U);
  EXPECT_EQ(strokes.size(), entries) << "no two of them look alike";
}

// The slope that it climbs is that of a wheel with the cross slope and the yaw of its start, as limits has it; a cross
// slope that its way leads into is doubted where it slides down.
TEST(Drive, ItsSteepestSlopeIsThatAcrossTheSlopeOfItsStart) {
  const Scratch scratch;
  const std::string file = scratch.write("start.yaml", std::string(short_drive) +
                                                           "  profile: [{at: 0 m, transverse_incline: 20 deg, yaw: 9 "
                                                           "deg}, {at: 2 cm, transverse_incline: 45 deg}]\n");
  const Outcome said = soilbin("drive '" + file + "' --samples 20"), json = soilbin("drive '" + file + "' --json");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("of dry-sand, with the cross slope of 20 deg and the yaw of 9 deg at its"));
  EXPECT_THAT(said.err, HasSubstr("warning: the wheel slides down the cross slope"));
  const nlohmann::json limits = soilbin(
                                    "limits --tire rover-wheel --soil dry-sand --load 64.68N --speed 5cm/s "
                                    "--transverse-incline 20deg --yaw 9deg --json")
                                    .json()["rows"][0];
  EXPECT_NEAR(json.json()["steepest_steady_slope"].get<double>(), limits["steepest_slope"].get<double>(), 1e-9);
}

// A drive keeps to its effects; what is advised of a tire with a pressure is what a drive takes.
TEST(Drive, ATireWithAPressureIsFlexibleWhereItsEffectsSaySo) {
  const Scratch scratch;
  const std::string truck = R"(format: soilbin-case/1
name: truck
tire: {radius: 670 mm, width: 430 mm, inflation_pressure: 150 kPa, carcass_pressure: 20 kPa}
soil: sandy-loam
drive:
  load: 37.5 kN
  duration: 4 s
  controller: {rim_speed: 1 m/s}
)",
                    file = scratch.write("truck.yaml", truck).string(),
                    flexible = scratch.write("flexible.yaml", truck + "  effects: [tire_flexibility]\n").string();
  const Outcome rigid = soilbin("drive '" + file + "' --samples 20");
  EXPECT_THAT(rigid.err, HasSubstr("the inflation pressure is ignored: add tire_flexibility to the drive's effects"));
  EXPECT_THAT(rigid.out, Not(HasSubstr("carcass")));
  const Outcome flat = soilbin("drive '" + flexible + "' --samples 20"),
                json = soilbin("drive '" + flexible + "' --samples 20 --json");
  EXPECT_THAT(flat.err, Not(HasSubstr("ignored")));
  EXPECT_THAT(flat.out, HasSubstr("is in the tire's carcass"));
  const nlohmann::json energy = json.json()["energy"];
  EXPECT_LT(std::abs(energy["unaccounted"].get<double>()), 1e-4 * energy["motor"].get<double>());
  EXPECT_NE(energy["carcass"], 0.0);
}

// Downhill gravity works too: shares are of all that is put in, and sum to 100 %. Shear gives a little of it back.
TEST(Drive, DownhillGravityPutsWorkIn) {
  const Scratch scratch;
  const std::string file =
      scratch.write("down.yaml", std::string(short_drive) + "  profile: [{at: 0 m, longitudinal_incline: -12 deg}]\n");
  const Outcome down = soilbin("drive '" + file + "' --samples 20");
  ASSERT_EQ(down.status, 0) << down.err;
  const std::string table = down.out.substr(down.out.find("of the work put in"));
  EXPECT_THAT(table, AllOf(HasSubstr("put in: gravity's work"), Not(HasSubstr("lifts the load"))));
  const std::regex share(R"(([a-z':, ]+?) +([-+.0-9e]+) +([-+.0-9e]+)\n)");
  double used = 0.0, put_in = 0.0;
  for (auto at = std::sregex_iterator(table.begin(), table.end(), share); at != std::sregex_iterator(); ++at) {
    const double percent = std::stod((*at)[3]);
    EXPECT_LE(std::abs(percent), 103.0) << (*at)[0];
    if ((*at)[1] == "in all") continue;
    ((*at)[1].str().starts_with("put in") ? put_in : used) += percent;
  }
  EXPECT_NEAR(put_in, 100.0, 0.1);
  EXPECT_NEAR(used, 100.0, 0.1);
}

// On slopes that no soil holds the wheel slides: back uphill, forward downhill.
TEST(Drive, AWheelThatCantBeHeldAtRestIsPulledDownTheSlope) {
  const Scratch scratch;
  for (const auto& [slope, to] : {std::pair{"-40 deg", "forward"}, {"40 deg", "back"}}) {
    const std::string file = scratch.write(
        "slope.yaml", std::string(short_drive) + "  profile: [{at: 0 m, longitudinal_incline: " + slope + "}]\n");
    const Outcome r = soilbin("drive '" + file + "' --samples 20");
    EXPECT_NE(r.status, 0);
    EXPECT_THAT(r.err, AllOf(HasSubstr("can't hold the wheel at rest"), HasSubstr(std::string("N pull it ") + to)))
        << slope;
  }
}

TEST(Drive, ACaseHasADriveOrAStudyAndEachCommandSaysWhich) {
  EXPECT_THAT(soilbin("drive rover-slip"),
              Refuses(AllOf(HasSubstr("no section 'drive'"), HasSubstr("soilbin run rover-slip"))));
  EXPECT_THAT(soilbin("run rover-climb"), Refuses(HasSubstr("hint: soilbin drive rover-climb")));
  EXPECT_THAT(soilbin("drive rover-clim").err, HasSubstr("did you mean 'rover-climb'"));
  EXPECT_THAT(soilbin("check rover-climb").out, HasSubstr("a drive"));
}

TEST(Drive, AnEffectThatHoldsInASteadyStateOnlyIsRefused) {
  const Scratch scratch;
  const std::string file =
      scratch.write("start.yaml", std::string(short_drive) + "  effects: [slip_sinkage]\n").string();
  EXPECT_THAT(soilbin("drive '" + file + "'"),
              Refuses(AllOf(HasSubstr("a wheel driven in time can't take the effect slip_sinkage"),
                            HasSubstr("hint: write {id: slip_sinkage, form: ding}"))));
}

/// A small wheel that pulls a little on grains of 20 mm, level, then uphill.
constexpr const char* small_drive = R"(format: soilbin-case/1
name: small
tire: {radius: 100 mm, width: 80 mm}
soil:
  semi_empirical: {exponent: 1.1, k_c: 0.99 kN/m^(n+1), k_phi: 1528 kN/m^(n+2), cohesion: {value: 0.5 kPa, sd: 0.2 kPa},
                   friction_angle: {value: 28 deg, sd: 2 deg}, shear_modulus: 10 mm, stress_angle_c1: 0.18,
                   stress_angle_c2: 0.32, density: 1500 kg/m^3}
  granular:
    radius_min: 8 mm
    radius_max: 12 mm
    grain_density: 2500 kg/m^3
    youngs_modulus: 5 MPa
    poisson_ratio: 0.2
    grain_grain: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1}
    grain_tire: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1}
drive:
  load: 20 N
  duration: 2 s
  distance: 0.25 m
  controller: {rim_speed: 30 cm/s, ramp: 0.2 s}
  profile:
    - {at: 0 m, drawbar: 1 N}
    - {at: 0.1 m, longitudinal_incline: 3 deg, drawbar: 1 N}
)";
constexpr const char* small_bin =
    " --bed-width 16cm --bed-depth 6cm --behind 12cm --ahead 12cm --lowering 0.1s --resting 0.05s --threads 1 "
    "--samples 100 --ledger ";

TEST(Drive, GrainsTakeWhatTheyCanAndSayWhatTheyCannot) {
  EXPECT_THAT(soilbin("drive rover-climb --model dme"), Refuses(HasSubstr("did you mean 'dem'")));
  EXPECT_THAT(soilbin("drive rover-climb --model dem"), Refuses(HasSubstr("has no grains")));
  const Scratch scratch;
  const std::string file =
      scratch.write("two.yaml", std::string(small_drive) + "    - {at: 0.2 m, soil: snow}\n").string();
  EXPECT_THAT(soilbin("drive '" + file + "' --model both"),
              Refuses(AllOf(HasSubstr("one soil from end to end; 'snow' begins at 0.2 m"), HasSubstr("hint: "))));
}

TEST(Drive, AWheelAsDrawnIsRefusedBeforeABedIsSettled) {
  const Scratch scratch;
  const std::string file = scratch.write("small.yaml", small_drive).string();
  EXPECT_THAT(soilbin("drive '" + file + "' --model dem --wheel-mesh nowhere.stl"),
              Refuses(AllOf(HasSubstr("nowhere.stl"), HasSubstr("hint: "))));
  const std::string step = scratch.write("wheel.step", "ISO-10303-21;").string();
  EXPECT_THAT(soilbin("drive '" + file + "' --model dem --wheel-mesh '" + step + "'"),
              Refuses(HasSubstr("take .stl or .obj")));
}

/// Motor's work less all that a side says became of it.
double left_over(const nlohmann::json& side) {
  const nlohmann::json& e = side["energy"];
  return e["motor"].get<double>() - e["kinetic"].get<double>() - e["height"].get<double>() -
         e["drawbar"].get<double>() - e["soil"].get<double>();
}

TEST(SlowDriveInGrains, BothModelsStandSideBySide) {
  const Scratch scratch;
  const std::string file = scratch.write("small.yaml", small_drive).string(), page = (scratch / "p.html").string(),
                    csv = (scratch / "t.csv").string();
  ::setenv("SOILBIN_BEDS", (scratch / "beds").string().c_str(), 1);
  const Outcome r = soilbin("drive '" + file + "' --model both" + small_bin + "--json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json drive = r.json();
  EXPECT_EQ(drive["format"], "soilbin-drive-sides/1");
  ASSERT_EQ(drive["sides"].size(), 2U);
  EXPECT_EQ(drive["sides"][0]["model"], "bekker_wong");
  const nlohmann::json& grains = drive["sides"][1];
  EXPECT_EQ(grains["model"], "dem");
  EXPECT_EQ(grains["end"], "arrived");
  EXPECT_NEAR(grains["travelled"].get<double>(), 0.25, 1e-3);
  EXPECT_NEAR(left_over(grains), 0.0, 1e-9);
  EXPECT_NEAR(left_over(drive["sides"][0]), 0.0, 1e-4 * drive["sides"][0]["energy"]["motor"].get<double>());
  double parts = 0.0;
  for (const auto& [name, joules] : grains["soil_parts"].items()) parts += joules.get<double>();
  EXPECT_NEAR(parts, grains["energy"]["soil"].get<double>(), 1e-9);
  for (const nlohmann::json& side : drive["sides"])
    for (const auto& [name, values] : side["samples"].items())
      EXPECT_EQ(values.size(), side["samples"]["time_s"].size()) << name;
  ASSERT_EQ(drive["differences"].size(), 5U);
  for (const nlohmann::json& row : drive["differences"]) {
    EXPECT_NEAR(row["difference"].get<double>(),
                row["analytic"]["value"].get<double>() - row["grains"]["value"].get<double>(), 1e-12);
    EXPECT_GT(row["grains"]["std_error"].get<double>(), 0.0) << row["of"];
  }
  const Outcome said =
      soilbin("drive '" + file + "' --model both" + small_bin + "--report '" + page + "' --csv '" + csv + "'");
  ::unsetenv("SOILBIN_BEDS");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_THAT(said.out, AllOf(HasSubstr("Grains: arrived after"), HasSubstr("is given to the soil"),
                              HasSubstr("of that: grains slide"), HasSubstr("soil force [N]")));
  EXPECT_THAT(text_of(page), AllOf(HasSubstr("Against time"), HasSubstr("Travelled [m]"), HasSubstr("Steady state")));
  EXPECT_THAT(text_of(csv), AllOf(testing::StartsWith("model,time_s,travelled_m"), HasSubstr("\ndem,")));
}

/// Without what it took on the clock.
nlohmann::json without_cost(nlohmann::json drive) {
  drive.erase("notes");
  return drive;
}

TEST(SlowDriveInGrains, SeveralPackingsAreToldEachAndAsOne) {
  const Scratch scratch;
  const std::string file = scratch.write("small.yaml", small_drive).string(), page = (scratch / "p.html").string(),
                    command = "drive '" + file + "' --model both --packings 2" + small_bin;
  ::setenv("SOILBIN_BEDS", (scratch / "beds").string().c_str(), 1);
  const Outcome r = soilbin(command + "--json"), said = soilbin(command + "--report '" + page + "'");
  ::unsetenv("SOILBIN_BEDS");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json drive = r.json();
  ASSERT_EQ(drive["sides"].size(), 3U);
  EXPECT_FALSE(drive["sides"][0].contains("packing"));
  const nlohmann::json &one = drive["sides"][1], &two = drive["sides"][2], &mean = drive["over_packings"];
  EXPECT_EQ(one["model"], "dem");
  EXPECT_EQ(one["packing"], 1);
  EXPECT_EQ(two["packing"], 2);
  EXPECT_NE(one["samples"]["torque_Nm"], two["samples"]["torque_Nm"]);
  EXPECT_EQ(mean["ends"], (nlohmann::json{one["end"], two["end"]}));
  const double first = one["end_time"], second = two["end_time"];
  EXPECT_NEAR(mean["end_time"]["value"].get<double>(), (first + second) / 2, 1e-12);
  EXPECT_NEAR(mean["end_time"]["std_error"].get<double>(), std::abs(first - second) / 2, 1e-12);
  ASSERT_FALSE(mean["steady"].is_null());
  const auto slip = [](const nlohmann::json& side) { return side["steady"]["slip"]["value"].get<double>(); };
  EXPECT_NEAR(slip(mean), (slip(one) + slip(two)) / 2, 1e-12);
  EXPECT_GE(mean["steady"]["slip"]["std_error"].get<double>(), 0.999 * std::abs(slip(one) - slip(two)) / 2);
  EXPECT_EQ(drive["differences"][1]["of"], "slip");
  EXPECT_EQ(drive["differences"][1]["grains"], mean["steady"]["slip"]);
  EXPECT_EQ(drive["notes"].size(), 2U);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_THAT(said.out, AllOf(HasSubstr("Grains, mean of 2 bed samples: arrived on 2, after"),
                              HasSubstr("grains, bed sample 2"), HasSubstr("on each bed sample")));
  EXPECT_THAT(text_of(page), HasSubstr("On each bed sample"));
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

TEST(SlowDriveInGrains, ADriveThatIsInterruptedGoesOnByTheSameCommand) {
  const Scratch scratch;
  const std::string file = scratch.write("small.yaml", small_drive).string(), beds = (scratch / "beds").string(),
                    replay = (scratch / "replay").string(),
                    command = "drive '" + file + "' --model dem" + small_bin + "--json --replay '" + replay + "'";
  ::setenv("SOILBIN_BEDS", beds.c_str(), 1);
  const Outcome whole = soilbin(command);
  ASSERT_EQ(whole.status, 0) << whole.err;
  const std::string seen = text_of(replay);
  EXPECT_THAT(names_in(beds), ElementsAre(StartsWith("bed-"))) << "nothing is left of it";
  constexpr int interrupted = 130;
  int stops = 0;
  Outcome again;
  for (int k = 0; k < 50; ++k) {
    again = soilbin(command, "timeout --preserve-status -s INT " + std::to_string(0.5 + 0.2 * k) + " ");
    if (stops > 0) {
      EXPECT_THAT(again.err, HasSubstr("going on from " + beds + "/drive-"));
    }
    if (again.status != interrupted) break;
    EXPECT_THAT(again.err, HasSubstr("the same command goes on from there"));
    ++stops;
  }
  EXPECT_GE(stops, 1);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(without_cost(again.json()), without_cost(whole.json()));
  EXPECT_TRUE(text_of(replay) == seen) << "the replay has the part before each stop too";
  EXPECT_THAT(names_in(beds), ElementsAre(StartsWith("bed-")));
  ::unsetenv("SOILBIN_BEDS");
}

TEST(LimitsCommand, TheSlipOnASlopeIsTheSlipOfNoPullThere) {
  const Scratch scratch;
  const std::string csv = (scratch / "l.csv").string(), plot = (scratch / "l.png").string();
  const Outcome r = soilbin("limits --tire rover-wheel --soil dry-sand --load 64.68N --json --csv '" + csv +
                            "' --plot '" + plot + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json row = r.json()["rows"].at(0);
  ASSERT_GE(row["slopes"].size(), 3U);
  const nlohmann::json& second = row["slopes"].at(1);
  const Outcome there =
      soilbin("estimate --tire rover-wheel --soil dry-sand --load 64.68N --json --slip " +
              std::to_string(second["slip"].get<double>()) + " --longitudinal-incline " +
              std::to_string(second["longitudinal_incline"].get<double>() * 180 / 3.14159265358979) + "deg");
  EXPECT_NEAR(there.json()["rows"].at(0)["drawbar_pull"].get<double>(), 0.0, 1e-3);
  EXPECT_NEAR(row["slopes"].back()["largest_pull"].get<double>(), 0.0, 1e-5);
  EXPECT_THAT(text_of(csv),
              HasSubstr(fmt::format(  // tables hold nine digits
                  ",{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},0.2,{:.9g},{:.9g},,\n", second["slip"].get<double>(),
                  second["std_error"]["slip"].get<double>(), second["largest_pull"].get<double>(),
                  second["std_error"]["largest_pull"].get<double>(), second["slip_of_largest_pull"].get<double>(),
                  row["steepest_slope_within_max_slip"].get<double>() / degree,
                  row["std_error"]["steepest_slope_within_max_slip"].get<double>() / degree)));
  const std::string table = text_of(csv);
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), 1 + row["slopes"].size());
  EXPECT_THAT(text_of(plot), StartsWith("\x89PNG"));
  const std::string drawing = (scratch / "l.svg").string();
  ASSERT_EQ(
      soilbin("limits --tire rover-wheel --soil dry-sand --load 64.68N --max-slip 60% --plot '" + drawing + "'").status,
      0);
  EXPECT_THAT(text_of(drawing), HasSubstr("rover-wheel on dry-sand, load 64.68 N"));
  for (const char* named : {"analytic wheel: largest pull<", "analytic wheel: slip at which it climbs the slope<",
                            "analytic wheel: slip of the largest pull<",
                            "analytic wheel: steepest slope at up to 60 % slip<", "<polygon", "one standard error"})
    EXPECT_THAT(text_of(drawing), HasSubstr(named));
  const std::string svg = text_of(drawing), path = svg.substr(svg.find(" d=\"M", svg.find("class=\"s c0\"")), 2000);
  EXPECT_GT(std::count(path.begin(), path.begin() + static_cast<long>(path.find("/>")), 'L'), 30) << "a smooth line";
}

// One uncertain value, the friction angle: the standard error of a limit is half of what the limit changes by from one
// standard deviation below to one above.
TEST(LimitsCommand, AStandardErrorIsTheChangeByOneStandardDeviation) {
  nlohmann::json low, high, row;
  const auto ask_with = [&](const std::string& load) {
    const auto limits = [&](const std::string& friction) {
      return soilbin(
                 "limits --tire rover-wheel --soil dry-sand --no-assumed-sd --shear-modulus 20+-0mm "
                 "--stress-angle-c1 0.18+-0 --stress-angle-c2 0.32+-0 --json --load " +
                 load + " --friction-angle " + friction)
          .json()["rows"]
          .at(0);
    };
    low = limits("27.9+-0deg"), high = limits("28.1+-0deg"), row = limits("28+-0.1deg");
  };
  const auto half_change = [&](const auto& value) {
    return std::abs(value(high).template get<double>() - value(low).template get<double>()) / 2;
  };
  ask_with("64.68N");
  const auto second = [](const char* key) { return [key](const auto& of) { return of["slopes"][1][key]; }; };
  const nlohmann::json& errors = row["slopes"][1]["std_error"];
  EXPECT_NEAR(errors["largest_pull"].get<double>() / half_change(second("largest_pull")), 1.0, 0.01);
  EXPECT_NEAR(errors["slip"].get<double>() / half_change(second("slip")), 1.0, 0.01);
  const auto expect_steepest = [&] {
    EXPECT_NEAR(row["std_error"]["steepest_slope"].get<double>() /
                    half_change([](const auto& of) { return of["steepest_slope"]; }),
                1.0, 0.01);
  };
  expect_steepest();
  for (const char* of_towed : {"slip", "resistance"})
    EXPECT_NEAR(row["towed"][of_towed]["std_error"].get<double>() /
                    half_change([&](const auto& of) { return of["towed"][of_towed]["value"]; }),
                1.0, 0.01)
        << of_towed;
  ask_with("300N");
  ASSERT_LT(row["steepest_slope"].get<double>(), 0.0) << "it needs a descent";
  expect_steepest();
}

TEST(LimitsCommand, AWheelThatNeedsADescentHasNoSlipOnLevelGround) {
  EXPECT_THAT(soilbin("limits --tire rover-wheel --soil dry-sand --load 300N").out,
              AllOf(HasSubstr("          0  none "), HasSubstr("it needs a downhill slope of 3.7 ± 4.5 deg or more.")));
}

// What it slips by and resists with is the answer at that slip; the angular speed is that of its travel.
TEST(LimitsCommand, ATowedWheelTakesNoTorque) {
  const std::string asked = " --tire rover-wheel --soil dry-sand --load 80N --speed 0.3m/s";
  const Outcome run = soilbin("limits" + asked);
  EXPECT_THAT(run.out, AllOf(HasSubstr("Towed over level ground, without torque, it slips by -"),
                             HasSubstr(" rad/s at 0.300 m/s.")));
  const nlohmann::json row = soilbin("limits" + asked + " --json").json()["rows"][0], level = row["slopes"][0];
  const nlohmann::json free =
      soilbin(fmt::format("estimate{} --slip {:.17g} --json", asked, row["towed"]["slip"]["value"].get<double>()))
          .json()["rows"][0];
  EXPECT_NEAR(free["torque"].get<double>(), 0.0, 1e-8);
  EXPECT_NEAR(-free["drawbar_pull"].get<double>(), row["towed"]["resistance"]["value"].get<double>(), 1e-9);
  EXPECT_NEAR(level["spin_of_largest_pull"].get<double>(),
              0.3 / 0.09 / (1 - level["slip_of_largest_pull"].get<double>()), 1e-9);
}

// With 64.68 N the rover's wheel pulls most at 100 % slip, where it climbs nothing; with 80 N at less.
// Where one standard error less of pull leaves none, a slip has no error to first order.
TEST(LimitsCommand, ASlopeThatIsPerhapsNotClimbedSaysSo) {
  const std::string ask = "limits --tire rover-wheel --soil dry-sand --load 64.68N";
  EXPECT_THAT(soilbin(ask).out, AllOf(HasSubstr(", or not at all"), HasSubstr("one standard error weaker")));
  std::size_t perhaps = 0;
  const nlohmann::json document = soilbin(ask + " --json").json();
  for (const nlohmann::json& row : document["rows"][0]["slopes"]) {
    const bool sure = row["largest_pull"] > row["std_error"]["largest_pull"];
    EXPECT_EQ(row["std_error"]["slip"].is_null(), !sure) << row;
    perhaps += !sure;
  }
  EXPECT_GT(perhaps, 2U);
}

TEST(LimitsCommand, AWheelThatSpinsOnTheSpotClimbsNothing) {
  const std::string light = soilbin("limits --tire rover-wheel --soil dry-sand --load 64.68N").out,
                    heavy = soilbin("limits --tire rover-wheel --soil dry-sand --load 80N").out;
  EXPECT_THAT(light,
              AllOf(HasSubstr("100 (no travel)"), HasSubstr("Theoretical limit "), Not(HasSubstr("Steepest slope"))));
  EXPECT_THAT(heavy, AllOf(HasSubstr("Steepest slope "), Not(HasSubstr("no travel"))));
}

// What a vehicle climbs with little slip stands beside the theoretical limit, and is the slope at which the pull at
// that slip is nothing.
TEST(LimitsCommand, TheSlopeAtALargestSlipIsTold) {
  const std::string wheel = "--soil upland-sandy-loam --radius 300mm --width 200mm --load 800N ";
  EXPECT_THAT(soilbin("limits " + wheel).out, testing::ContainsRegex("At up to 20 % slip: [0-9.]+ ± [0-9.]+ deg"));
  const nlohmann::json row = soilbin("limits " + wheel + "--max-slip 10% --json").json()["rows"][0];
  EXPECT_EQ(row["max_slip"], 0.1);
  const double slope = row["steepest_slope_within_max_slip"];
  EXPECT_LT(slope, row["steepest_slope"]);
  EXPECT_GT(row["std_error"]["steepest_slope_within_max_slip"], 0.0);
  const nlohmann::json there =
      soilbin("estimate " + wheel + "--slip 10% --longitudinal-incline " + std::to_string(slope) + "rad --json").json();
  EXPECT_NEAR(there["rows"][0]["drawbar_pull"].get<double>(), 0.0, 0.01);
  EXPECT_THAT(soilbin("limits " + wheel + "--max-slip 120%").err, HasSubstr("--max-slip"));
}

// Of the base model the pull grows up to 100 % slip, where a wheel in soil digs itself in.
TEST(LimitsCommand, WithoutSlipSinkageTheyAreUpperBounds) {
  constexpr const char* said = "Without slip sinkage the largest pull and the steepest slope are upper bounds.";
  const std::string asked = "limits --tire rover-wheel --soil dry-sand --load 64.68N";
  EXPECT_THAT(soilbin(asked).out, HasSubstr(said));
  EXPECT_THAT(soilbin(asked + " --effect slip_sinkage").out, Not(HasSubstr(said)));
}

// The largest pull at 800 N lies at 92 % slip, as deep a dig as at 100 %; a large light wheel outclimbs the sand
// itself.
TEST(LimitsCommand, BoundsAndSlopesOnWhichTheSoilSlidesAreSaid) {
  const std::string soil = "limits --soil upland-sandy-loam --width 200mm ";
  const Outcome heavy = soilbin(soil + "--radius 300mm --load 800N"), light = soilbin(soil + "--radius 1m --load 50N");
  EXPECT_THAT(heavy.out, AllOf(HasSubstr("91.94"), HasSubstr("are upper bounds")));
  EXPECT_THAT(heavy.err, Not(HasSubstr("slides by itself")));
  EXPECT_THAT(light.err, HasSubstr("from 50 deg on this soil slides by itself"));
}

TEST(LimitsCommand, HeadingsSayWhatEachColumnIs) {
  const std::string text = soilbin("limits --tire rover-wheel --soil dry-sand --load 80N").out;
  for (const char* told : {"slope [deg]", "slip to climb it [%]", "largest pull [N]", "slip of the largest pull [%]",
                           "± is one standard error from"})
    EXPECT_THAT(text, HasSubstr(told));
  EXPECT_THAT(text, testing::ContainsRegex("Steepest slope [0-9.]+ ± [0-9.]+ deg"));
}

TEST(LimitsCommand, AsksForTheLoadAndNoMore) {
  EXPECT_THAT(soilbin("limits --tire rover-wheel --soil dry-sand"), Refuses(HasSubstr("--load is missing")));
  EXPECT_THAT(soilbin("limits rover-slip").out, HasSubstr("slip_sinkage"));
  for (const char* found : {"--slip 20%", "--longitudinal-incline 5deg"})
    EXPECT_THAT(soilbin(std::string("limits rover-slip ") + found),
                Refuses(HasSubstr("limits looks for the slip and the slope")))
        << found;
}

}  // namespace
}  // namespace soilbin::cli::test
