// A wheel on soft soil as the plugin WheelSlip of Gazebo has it (gz::sim::systems::WheelSlip, and WheelSlipPlugin of
// Gazebo Classic): a force in proportion to slip, up to a coefficient of friction, fitted to the model's curves.
//
//   const WheelSlipFit fit = wheel_slip_of(question);  // at its one load
//   fit.longitudinal.compliance, fit.longitudinal.friction
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/export/packed_files.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

/// The force that the plugin gives by its documentation (WheelSlip.hh), over the normal force: slip/compliance, but no
/// more than the friction and no less than its negative. With no compliance the friction at any slip.
double wheel_slip_force(double slip, double compliance, double friction);

/// One place of a curve: what the plugin takes for slip, and the model's force over the normal load.
struct SlipPoint {
  double slip = 0.0;         ///< longitudinal: (r w - v)/(r w) less idle_slip; lateral: v sin(yaw)/(r w)
  double force_share = 0.0;  ///< of the normal load; lateral: against the slip
};

/// A line up to a friction, fitted.
struct SlipLine {
  double compliance = 0.0;     ///< slip for a force of the normal load [-]
  double friction = 0.0;       ///< largest force [normal loads]
  double rms_error = 0.0;      ///< of the force, over the points [normal loads]
  double largest_error = 0.0;  ///< [normal loads]
  std::vector<SlipPoint> points;
};

/// The least squares over compliance, with the friction that of the largest force among the points. Points beyond the
/// largest force count too. Throws NoSolution where no point has a force above 0.
SlipLine fitted_line(std::vector<SlipPoint> points);

struct WheelSlipFit {
  Case question;             ///< one model, one condition
  double normal_load = 0.0;  ///< [N]
  double radius = 0.0;       ///< [m]
  /// Drawbar pull from the slip without pull to 60 %, without yaw. Its slips count from there: the plugin's line passes
  /// through 0.
  SlipLine longitudinal;
  SlipLine lateral;           ///< lateral force at yaws of 2 .. 20 deg, at `lateral_slip`
  double lateral_slip = 0.0;  ///< that of the question
  double idle_slip = 0.0;     ///< of a driven wheel that pulls nothing, which the plugin lacks; 0 where it pulls anyway
  double idle_torque = 0.0;   ///< that it takes then [N m]
  std::vector<ModelAnswers> answers;  ///< behind the points
};

/// The fit of a question that asks one model at one condition on level ground, whose slip the lateral curve has. Throws
/// InputError for another question, NoSolution where the model answers nowhere.
WheelSlipFit wheel_slip_of(Case question, const MakeModel& make = make_model);

// Several soils under one wheel as the picture that Gazebo's system LookupWheelSlip reads beside WheelSlip
// (gz::sim::systems::LookupWheelSlip, src/systems/lookup_wheel_slip in gazebosim/gz-sim, since Gazebo Jetty): red
// changes the lateral slip compliance, green the longitudinal one, blue both frictions,
//
//   value = max(0, nominal + (colour - 128) step),
//
// where the nominal compliances are those that WheelSlip has, and its frictions are 1.
//
//   const SlipMap map = slip_map(fit_on_sand, {clay, mud}, {.size = 10.0});  // [m]
//   write_file_atomically("map.png", rgb_png(picture_of(map)));

/// What the two plugins have together for one place on the map.
struct MappedSlip {
  double lateral = 0.0;       ///< slip compliance [-]
  double longitudinal = 0.0;  ///< slip compliance [-]
  double friction = 0.0;      ///< in both directions: the map has one channel for it
};

struct SlipMapSoil {
  std::string soil;
  std::array<unsigned char, 3> colour{};  ///< red, green, blue
  MappedSlip fitted;                      ///< its friction is the longitudinal one
  double lateral_friction = 0.0;          ///< fitted; the map gives `fitted.friction` in its place
};

struct SlipMap {
  double size = 0.0;   ///< of the square on the ground, about the world's origin [m]
  int pixels = 0;      ///< along each side: the plugin takes the picture's height for its width
  MappedSlip nominal;  ///< of WheelSlip: the first soil's compliances, and a friction of 1
  MappedSlip step;     ///< a colour's step changes each by so much: what is read is off by half of it at most
  std::vector<SlipMapSoil> soils;  ///< in stripes of equal width along x, the first at the lowest x
};

struct SlipMapSize {
  double size = 10.0;  ///< [m]
  int pixels = 256;    ///< along each side
};

/// The map of one wheel's fits, a soil each, under one load. The steps are the smallest with which the colours 1 to 255
/// reach every soil. Throws InputError for no fit, fits of several wheels or loads, fewer pixels than soils, and a size
/// that is not above 0.
SlipMap slip_map(const std::vector<WheelSlipFit>& fits, const SlipMapSize& asked = {});

/// The map of a fit's soil and of others, each fitted in its place. Throws as wheel_slip_of, with the soil's name, and
/// as above.
SlipMap slip_map(const WheelSlipFit& first, const std::vector<Soil>& others, const SlipMapSize& asked = {});

/// What the plugins have where the map has this colour.
MappedSlip slip_at(const SlipMap& map, const std::array<unsigned char, 3>& colour);

/// The colours in rows from the largest y down, each from the lowest x up.
RgbPicture picture_of(const SlipMap& map);

}  // namespace soilbin::compare
