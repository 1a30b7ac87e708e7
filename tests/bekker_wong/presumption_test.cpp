// What an effect takes for a value that the tire does not declare is stated by its form, for every form of the
// catalogue.
#include "bekker_wong/presumption.hpp"

#include <array>
#include <functional>
#include <set>

#include "bekker_wong/bed_fixture.hpp"

namespace soilbin::bekker_wong::bed {
namespace {

/// A value that a tire may leave out: how to declare it, and two sizes of it.
struct Optional {
  std::string key;
  std::function<void(Tire&, double)> declare;
  double one, other;
};

const std::vector<Optional>& optional_values() {
  static const std::vector<Optional> all = {
      {"lugs.height", [](Tire& t, double h) { t.lugs.height = h; }, 0.008, 0.016},
      {"lugs.count", [](Tire& t, double n) { t.lugs.count = static_cast<int>(n); }, 18, 30},
      {"lugs.thickness", [](Tire& t, double s) { t.lugs.thickness = s; }, 0.002, 0.006},
      {"inflation_pressure", [](Tire& t, double p) { t.inflation_pressure = p; }, 40e3, 80e3},
      {"carcass_pressure", [](Tire& t, double p) { t.carcass_pressure = Estimate{p}; }, 5e3, 20e3},
  };
  return all;
}

/// Driven, yawed and on its third pass, so that whatever an effect hears of is there.
std::array<double, 4> rolled(const EffectForm& form, const Tire& tire) {
  OperatingCondition at = driven(800, 0.3);
  at.speed = 0.3, at.yaw = 10 * degree, at.pass = 3, at.position = 2.5, at.moisture = 0.09, at.run = 7;
  at.longitudinal_incline = 5 * degree, at.transverse_incline = 5 * degree;
  const Reading r =
      RollingWheel(tire, sand(), make_effects({{form.id, form.form, {}}}), Bin{0.5, 1.0}).roll(at).reading;
  return {r.drawbar_pull, r.torque, r.sinkage, r.lateral_force};
}

Tire fully_declared() {
  Tire tire = smooth_tire();
  for (const Optional& value : optional_values()) value.declare(tire, value.one);
  return tire;
}

/// The values whose change moves the form's answer on a tire that declares them all.
std::set<std::string> read_by(const EffectForm& form) {
  std::set<std::string> keys;
  for (const Optional& value : optional_values()) {
    Tire other = fully_declared();
    value.declare(other, value.other);
    if (rolled(form, other) != rolled(form, fully_declared())) keys.insert(value.key);
  }
  return keys;
}

TEST(Presumption, IsStatedByEachFormForWhatItReadsAndNothingElse) {
  std::set<std::string> presuming;
  for (const EffectForm& form : effect_catalogue()) {
    SCOPED_TRACE(form.id + " " + form.form);
    std::set<std::string> stated;
    for (const Presumed& value : presumed(form, smooth_tire())) stated.insert(value.key);
    EXPECT_EQ(stated, read_by(form));
    for (const Optional& value : optional_values())
      EXPECT_EQ(depends_on(form, value.key), stated.contains(value.key)) << value.key;
    EXPECT_EQ(depends_on(form, "lugs"), depends_on(form, "lugs.height"));
    EXPECT_TRUE(presumed(form, fully_declared()).empty());
    if (!stated.empty()) presuming.insert(form.id);
  }
  EXPECT_EQ(presuming, (std::set<std::string>{"lug_thrust", "tire_flexibility"}));
}

// The value that is told is the one that acts: a tire that declares it answers alike, to the bit.
TEST(Presumption, IsWhatTheFormReckonsWith) {
  for (const EffectForm& form : effect_catalogue()) {
    SCOPED_TRACE(form.id + " " + form.form);
    Tire declared = smooth_tire();
    for (const Presumed& taken : presumed(form, smooth_tire()))
      for (const Optional& value : optional_values())
        if (value.key == taken.key) value.declare(declared, taken.value);
    EXPECT_EQ(rolled(form, declared), rolled(form, smooth_tire()));
  }
}

// 5 % of a radius of 250 mm.
TEST(Presumption, IsToldInWordsOneSentenceAnEffect) {
  EXPECT_EQ(
      presumptions({{"lug_thrust", "shear_radius", {}}, {"lug_thrust", "free_blade", {}}, {"bulldozing", "", {}}},
                   smooth_tire()),
      std::vector<std::string>{"lug thrust assumes lug height = 12.5 mm (5 % of the radius), number of lugs = 24, "
                               "which the tire does not declare; leave the effect out for a wheel without lugs."});
  EXPECT_EQ(presumptions({{"tire_flexibility", "flat_section", {}}}, smooth_tire()),
            std::vector<std::string>{"tire flexibility assumes inflation pressure = 100 kPa, carcass pressure = 0 kPa, "
                                     "which the tire does not declare."});
  EXPECT_TRUE(presumptions({{"lug_thrust", "shear_radius", {}}}, fully_declared()).empty());
}

}  // namespace
}  // namespace soilbin::bekker_wong::bed
