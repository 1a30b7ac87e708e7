// A wheel on soft soil as the plugin WheelSlip of Gazebo has it (gz::sim::systems::WheelSlip, and WheelSlipPlugin of
// Gazebo Classic): a force in proportion to slip, up to a coefficient of friction, fitted to the model's curves.
//
//   const WheelSlipFit fit = wheel_slip_of(question);  // at its one load
//   fit.longitudinal.compliance, fit.longitudinal.friction
#pragma once

#include <vector>

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

/// Of a question that asks one model at one condition on level ground; its slip is that of the lateral curve. Throws
/// InputError for another question, NoSolution where the model answers nowhere.
WheelSlipFit wheel_slip_of(Case question, const MakeModel& make = make_model);

}  // namespace soilbin::compare
