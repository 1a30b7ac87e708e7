// soilbin mobility: a vehicle by flags or file, on a rating cone index or a soil.
#include <gmock/gmock.h>

#include <string>

#include "tests/cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string mobility_of_hmmwv =
    "mobility --weight 13450lbf --axles 2 --tires 4 --tire-width 12.5in --tire-diameter 37in --clearance 17.4in "
    "--power 190hp";

TEST(Mobility, MeetsThePublishedHmmwv) {
  const Outcome run = soilbin(mobility_of_hmmwv + " --rating-cone-index '300+-30 kPa' --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto answer = run.json();
  EXPECT_NEAR(answer.at("mobility_index").get<double>(), 83.82, 0.01);
  EXPECT_NEAR(answer.at("vci1").get<double>(), 191.6e3, 50);
  EXPECT_NEAR(answer.at("vci50").get<double>(), 435.8e3, 50);
  EXPECT_TRUE(answer.at("passages")[0].at("go").get<bool>());
  EXPECT_FALSE(answer.at("passages")[1].at("go").get<bool>());
}

TEST(Mobility, TakesAVehicleFileASoilAndATire) {
  const Scratch scratch;
  const std::string file =
      scratch
          .write("m1152.yaml",
                 "format: soilbin-vehicle/1\nname: M1152A1\nweight: 13450 lbf\naxles: 2\ntires: 4\n"
                 "tire_width: 12.5 in\ntire_diameter: 37 in\nclearance: 17.4 in\npower: 190 hp\n")
          .string();
  const Outcome run = soilbin("mobility '" + file + "' --soil lean-clay");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("M1152A1 on lean-clay"), HasSubstr("no go")));
  EXPECT_THAT(run.err, HasSubstr("--remolding-index"));
  EXPECT_THAT(soilbin("check '" + file + "'").out, HasSubstr("valid: vehicle 'M1152A1'"));
  const Outcome half =
      soilbin("mobility '" + file + "' --soil lean-clay --remolding-index 50% --driven-axles 1 --json");
  EXPECT_NEAR(half.json().at("rating_cone_index").at("value").get<double>(), 85e3, 1);
  EXPECT_THAT(half.err, HasSubstr("1 of 2 axles are driven"));
}

TEST(Mobility, SaysWhatItTakesToWhoNamesAVehicleOnASoil) {
  EXPECT_THAT(soilbin("mobility truck"),
              Refuses(AllOf(HasSubstr("tells no clearance"), HasSubstr("hint: soilbin vehicle truck asks that"),
                            HasSubstr("such as soilbin mobility --weight "))));
}

TEST(Mobility, NamesWhatIsMissing) {
  EXPECT_THAT(soilbin("mobility --weight 60kN --axles 2 --tires 4 --tire hmmwv"),
              Refuses(AllOf(HasSubstr("--clearance"), HasSubstr("--power"), Not(HasSubstr("--tire-width")))));
}

TEST(Mobility, IsOfFineGrainedSoilAlone) {
  EXPECT_THAT(soilbin(mobility_of_hmmwv + " --soil dry-sand"), Refuses(HasSubstr("'dry-sand' has no 'cone_index'")));
}

}  // namespace
}  // namespace soilbin::cli::test
