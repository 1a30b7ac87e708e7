// soilbin export: a header of C that is compiled, run and held against the CSV and the model; soils for Chrono that
// come back as they went; a wheel for Gazebo.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

#ifdef __x86_64__
constexpr const char* fmi_platform = "linux64";
#else
constexpr const char* fmi_platform = "aarch64-linux";
#endif

const std::string rover_on_sand = " --soil dry-sand --tire rover-wheel";

/// Reads places from its input and prints status and values; with a word, the nanoseconds of a look-up.
const char* const look_up_program = R"(#include "rover.h"
#include <stdio.h>
#include <time.h>
int main(int argc, char **argv) {
  double load, slip, yaw;
  rover_answer answer;
  (void)argv;
  if (argc > 1) {
    double sum = 0.0;
    const clock_t begin = clock();
    int i;
    for (i = 0; i < 1000000; ++i) {
      if (rover_lookup(40.0 + 0.00008 * i, 0.0000006 * i, 0.0000001 * i, &answer) == rover_NO_ANSWER) return 1;
      sum += answer.drawbar_pull;
    }
    printf("%g %g\n", 1e9 * (double)(clock() - begin) / CLOCKS_PER_SEC / 1e6, sum);
    return 0;
  }
  while (scanf("%lf %lf %lf", &load, &slip, &yaw) == 3) {
    const int status = rover_lookup(load, slip, yaw, &answer);
    printf("%d %.17g %.17g %.17g %.17g %.17g\n", status, answer.drawbar_pull, answer.torque, answer.sinkage,
           answer.lateral_force, answer.drawbar_pull_std_error);
  }
  printf("%g\n", ROVER_DRAWBAR_PULL_LARGEST_ERROR);
  return 0;
}
)";

std::vector<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; cells >> cell;) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return rows;
}

int shell(const std::string& line) {
  const int raw = std::system(line.c_str());
  return WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
}

/// The program compiled beside a header of a table over load, slip and yaw.
class ExportedHeader : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome run = soilbin(
        "export table" + rover_on_sand + " --load 40N..120N:20N --slip 0%..60%:10% --yaw 0deg..10deg:5deg" +
        " --header '" + (scratch / "rover.h").string() + "' --csv '" + (scratch / "rover.csv").string() + "' --json");
    ASSERT_EQ(run.status, 0) << run.err;
    answer = run.json();
    scratch.write("main.c", look_up_program);
    const std::string here = "cd '" + folder() + "' && ";
    ASSERT_EQ(shell(here + "cc -std=c99 -pedantic -Wall -Wextra -Werror -O2 main.c -o look_up"), 0);
    ASSERT_EQ(shell(here + "cc -x c++ -pedantic -Wall -Wextra -Werror -c main.c -o unused.o"), 0) << "C++ takes it too";
  }
  std::vector<std::vector<double>> looked_up(const std::string& places) const {
    scratch.write("places", places);
    const std::string here = "cd '" + folder() + "' && ";
    EXPECT_EQ(shell(here + "./look_up <places >found"), 0);
    return numbers_of(text_of(scratch / "found"));
  }
  std::string folder() const { return (scratch / "").string(); }
  Scratch scratch;
  nlohmann::json answer;
};

TEST_F(ExportedHeader, GivesTheNodesOfTheCsv) {
  std::istringstream csv(text_of(scratch / "rover.csv"));
  std::string line, places;
  std::vector<std::vector<double>> rows;
  std::getline(csv, line);
  EXPECT_THAT(line, testing::StartsWith("load_N,slip,yaw_deg,drawbar_pull_N,drawbar_pull_se_N,torque_Nm,"));
  while (std::getline(csv, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    rows.push_back(numbers_of(line).front());
    std::ostringstream place;
    place.precision(17);
    place << rows.back()[0] << ' ' << rows.back()[1] << ' ' << rows.back()[2] * std::numbers::pi / 180 << '\n';
    places += place.str();
  }
  EXPECT_EQ(rows.size(), 5U * 7U * 3U);
  const auto found = looked_up(places);
  ASSERT_EQ(found.size(), rows.size() + 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NE(found[i][0], 2) << "a last digit of the angle may lie outside";
    EXPECT_NEAR(found[i][1], rows[i][3], 1e-7);
    EXPECT_NEAR(found[i][2], rows[i][5], 1e-7);
    EXPECT_NEAR(found[i][3], rows[i][7], 1e-9);
    EXPECT_NEAR(found[i][4], rows[i][9], 1e-7);
    EXPECT_NEAR(found[i][5], rows[i][4], 1e-7);
  }
}

TEST_F(ExportedHeader, IsWithinItsStatedErrorOfTheModelBetweenThem) {
  double largest = 0.0;
  for (const char* const place : {"50 5 2.5", "90 35 7.5", "110 55 2.5", "50 5 7.5"}) {
    const std::vector<double> at = numbers_of(place).front();
    std::ostringstream asked, given;
    asked << "estimate" << rover_on_sand << " --load " << at[0] << "N --slip " << at[1] << "% --yaw " << at[2]
          << "deg --json";
    given.precision(17);
    given << at[0] << ' ' << at[1] / 100 << ' ' << at[2] * std::numbers::pi / 180 << '\n';
    const auto found = looked_up(given.str());
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0][0], 0);
    const auto row = soilbin(asked.str()).json().at("rows")[0];
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& channel = answer.at("channels")[k];
      const double error = std::abs(found[0][k + 1] - row.at(channel.at("name").get<std::string>()).get<double>());
      EXPECT_LE(error, channel.at("largest_error").get<double>() * 1.000001 + 1e-9) << channel.at("name");
      if (k == 0) largest = std::max(largest, error);
    }
    EXPECT_NEAR(found[1][0], answer.at("channels")[0].at("largest_error").get<double>(), 1e-4 * found[1][0]);
  }
  EXPECT_GT(largest, 0.0) << "these places lie between nodes";
}

TEST_F(ExportedHeader, ClampsAndSaysSo) {
  const auto found = looked_up("1000 0.2 0\n120 0.2 0\nnan 0.2 0\n");
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0][0], 1);
  EXPECT_EQ(found[1][0], 0);
  EXPECT_EQ(found[0][1], found[1][1]);
  EXPECT_EQ(found[2][0], 2);
  EXPECT_TRUE(std::isnan(found[2][1]));
}

// Some 0.05 us; the limit is that of a machine which others use.
TEST_F(ExportedHeader, LooksUpInAboutAMicrosecond) {
  ASSERT_EQ(shell("cd '" + folder() + "' && ./look_up time >took"), 0);
  const double nanoseconds = numbers_of(text_of(scratch / "took")).front().front();
  RecordProperty("nanoseconds", std::to_string(nanoseconds));
  EXPECT_LT(nanoseconds, 3000.0);
}

TEST_F(ExportedHeader, TellsItsProvenanceAndRange) {
  EXPECT_THAT(text_of(scratch / "rover.h"),
              AllOf(HasSubstr(" * soil:  dry-sand"), HasSubstr("load: 40 .. 120 N, 5 nodes"),
                    HasSubstr("yaw: 0 .. 10 deg, 3 nodes"), HasSubstr("rover_lookup(load, slip, yaw, &answer)"),
                    HasSubstr("load [N], slip [-], yaw [rad]"), HasSubstr("soil k_phi: ")));
}

TEST(ExportTable, SaysNoAnswerBesideAGap) {
  const Scratch scratch;
  const Outcome run = soilbin("export table" + rover_on_sand + " --load 50N..1500N:290N --slip 0%..60%:20% --header '" +
                              (scratch / "rover.h").string() + "'");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("nodes have no answer of the model"));
  EXPECT_THAT(text_of(scratch / "rover.h"), HasSubstr("NAN"));
}

TEST(ExportTable, TakesAStudyAndWritesHdf5) {
  const Scratch scratch;
  const Outcome run = soilbin("export table rover-slip --load 50N,65N --slip 0%..60%:20% --model rft --hdf5 '" +
                              (scratch / "t.h5").string() + "'");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(text_of(scratch / "t.h5"), testing::StartsWith("\x89HDF\r\n"));
}

TEST(ExportTable, RefusesWithAHint) {
  EXPECT_THAT(soilbin("export table" + rover_on_sand + " --load 65N --slip 20%"),
              Refuses(AllOf(HasSubstr("none varies"), HasSubstr("hint: such as --load"))));
  EXPECT_THAT(soilbin("export tabel" + rover_on_sand).err, HasSubstr("unknown command 'tabel', did you mean 'table'?"));
  EXPECT_THAT(soilbin("export table" + rover_on_sand + " --laod 65N").err, HasSubstr("did you mean '--load'?"));
  EXPECT_EQ(soilbin("export").status, 2);
  EXPECT_THAT(
      soilbin("export table" + rover_on_sand + " --load 65N,80N --slip 20% --model rft --effect slip_sinkage").err,
      HasSubstr("--effect means nothing to --model rft"));
}

TEST(ExportScm, ComesBackAsItWent) {
  for (const std::string soil : {"dry-sand", "cmu-sand", "lunar-regolith"}) {
    const Scratch scratch;
    const std::string file = (scratch / "scm.json").string();
    const Outcome run = soilbin("export scm " + soil + " --output '" + file + "'");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, AllOf(HasSubstr("Mohr_friction"), HasSubstr("slip sinkage"), HasSubstr("N/m^(n+2)")));
    const std::string asked = " --tire rover-wheel --load 65N --slip 20% --yaw 3deg --json";
    const auto before = soilbin("estimate --soil " + soil + asked).json().at("rows")[0];
    const auto after = soilbin("estimate --soil '" + file + "'" + asked).json().at("rows")[0];
    for (const char* channel : {"drawbar_pull", "torque", "sinkage", "lateral_force"}) {
      const auto value = before.at(channel).get<double>(), sd = before.at("std_error").at(channel).get<double>();
      EXPECT_NEAR(after.at(channel).get<double>(), value, 1e-9 * std::abs(value)) << soil << channel;
      EXPECT_NEAR(after.at("std_error").at(channel).get<double>(), sd, 1e-9 * sd) << soil << channel;
    }
    EXPECT_THAT(soilbin("check '" + file + "'").out, HasSubstr("valid: soil '" + soil + "'"));
  }
}

TEST(ExportScm, WritesTheKeysThatChronoReads) {
  const auto file = soilbin("export scm dry-sand --json").json();
  EXPECT_EQ(file.at("Type"), "SCM");
  EXPECT_TRUE(file.at("Patch dimensions").at("Length").is_number());
  EXPECT_TRUE(file.at("Grid spacing").is_number());
  EXPECT_TRUE(file.at("Simulation settings").at("Fix proxies").is_boolean());
  const auto& soil = file.at("Soil parameters");
  for (const char* key : {"Bekker Kphi", "Bekker Kc", "Bekker n exponent", "Mohr cohesive limit", "Mohr friction limit",
                          "Janosi shear coefficient", "Elastic stiffness", "Damping"})
    EXPECT_TRUE(soil.at(key).is_number()) << key;
  EXPECT_GT(soil.at("Elastic stiffness").get<double>(), soil.at("Bekker Kphi").get<double>());
  EXPECT_GT(soil.at("Mohr friction limit").get<double>(), 20) << "in degrees";
}

TEST(ExportScm, SaysWhatIsMissing) {
  const Scratch scratch;
  const std::string file = scratch.write("scm.json", R"({"Soil parameters": {"Bekker Kphi": 2e6}})").string();
  EXPECT_THAT(soilbin("estimate --soil '" + file + "' --tire rover-wheel --load 65N --slip 20%"),
              Refuses(HasSubstr("lacks Bekker Kc, Bekker n exponent, Mohr cohesive limit")));
}

TEST(ExportGazebo, GivesThePluginsNumbers) {
  const Outcome run = soilbin("export gazebo" + rover_on_sand + " --load 65N --slip 20%");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("<slip_compliance_lateral>"), HasSubstr("<wheel_radius>")));
  const auto answer = soilbin("export gazebo" + rover_on_sand + " --load 65N --slip 20% --json").json();
  EXPECT_EQ(answer.at("format"), "soilbin-wheel-slip/1");
  EXPECT_GT(answer.at("longitudinal").at("slip_compliance").get<double>(), 0.0);
  EXPECT_EQ(soilbin("export gazebo" + rover_on_sand + " --load 65N --slip 20% --yaw 4deg").status, 2);
}

TEST(ExportGazebo, WritesAMapOfSoils) {
  const Scratch scratch;
  const std::string asked = "export gazebo" + rover_on_sand + " --load 65N --slip 20%";
  const Outcome run = soilbin(asked + " --map '" + (scratch / "map.png").string() +
                              "' --map-soil lunar-regolith --map-soil cmu-sand --map-size 20m");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("lunar-regolith"), HasSubstr("<size_x>20</size_x>")));
  EXPECT_THAT(text_of(scratch / "map.png"), testing::StartsWith("\x89PNG"));
  EXPECT_THAT(soilbin(asked + " --map-soil lunar-regolit").err, HasSubstr("did you mean 'lunar-regolith'?"));
  EXPECT_THAT(soilbin(asked + " --map-size 20m").err, HasSubstr("hint: --map FILE.png"));
  EXPECT_THAT(soilbin(asked + " --map-soil snow-sweden").err, HasSubstr("soil 'snow-sweden': no solution"));
}

TEST(ExportFmi, WritesAUnitThatOthersUnpack) {
  const Scratch scratch;
  const std::string file = (scratch / "rover unit.fmu").string();
  const Outcome run =
      soilbin("export fmi" + rover_on_sand + " --load 50N,65N --slip 0%..60%:10% --output '" + file + "' --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto answer = run.json();
  EXPECT_EQ(answer.at("format"), "soilbin-fmu/1");
  EXPECT_EQ(answer.at("table").at("format"), "soilbin-force-table/1");
  const std::string here = "cd '" + (scratch / "").string() + "' && ";
  ASSERT_EQ(shell(here + "python3 -m zipfile -e 'rover unit.fmu' unit >listed"), 0) << "a ZIP that Python reads";
  EXPECT_THAT(text_of(scratch / "unit/modelDescription.xml"), HasSubstr(answer.at("guid").get<std::string>()));
  EXPECT_THAT(text_of(scratch / "unit/resources/case.yaml"), HasSubstr("rover-wheel"));
  const std::string library = text_of(scratch / "unit/binaries" / fmi_platform / "rover_unit.so");
  EXPECT_THAT(library, testing::StartsWith("\x7f"
                                           "ELF"));
  EXPECT_EQ(shell(here + "cc -std=c99 -pedantic -Wall -Wextra -Werror -c unit/sources/rover_unit.c -o unused.o"), 0);
  EXPECT_EQ(shell(here + "cc -std=c99 -DFMI2_FUNCTION_PREFIX=rover_unit_ -c unit/sources/rover_unit.c -o unused.o && "
                         "nm unused.o | grep -q rover_unit_fmi2DoStep"),
            0);
}

TEST(ExportFmi, IsItsSourceWithoutACompiler) {
  const Scratch scratch;
  const Outcome run = soilbin("export fmi" + rover_on_sand + " --load 50N,65N --slip 0%..60%:10% --output '" +
                                  (scratch / "rover.fmu").string() + "'",
                              "PATH=/nowhere ");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Not compiled: The unit holds its source alone"));
  EXPECT_THAT(text_of(scratch / "rover.fmu"),
              AllOf(HasSubstr("sources/rover.c"), testing::Not(HasSubstr("binaries/"))));
}

TEST(ExportFmi, RefusesWithAHint) {
  EXPECT_THAT(soilbin("export fmi" + rover_on_sand + " --load 65N --slip 10%..60%:10%").err,
              AllOf(HasSubstr("begin at 0 %"), HasSubstr("hint: --slip 0%..60%:5%")));
  EXPECT_THAT(soilbin("export fmi" + rover_on_sand + " --load 65N,80N --slip 20%").err, HasSubstr("runs over slip"));
  EXPECT_EQ(soilbin("export fmi" + rover_on_sand + " --load 65N --slip 0%..60%:10% --output /proc/x.fmu").status, 2);
}

}  // namespace
}  // namespace soilbin::cli::test
