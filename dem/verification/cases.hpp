// Cases with published or closed-form answers that an engine of docs/theory/dem-laws.md must meet. A case knows its
// set-up, what is measured and the answer; it drives any engine through VerificationEngine. `soilbin verify` runs them
// on the fast engine, the tests on the reference engine too.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dem/engine/materials.hpp"
#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

namespace verification {

inline constexpr double g = 9.81;       ///< [m/s^2]
inline constexpr int first_plane = -1;  ///< as the other one of a contact
inline constexpr const char* closed_form = "closed form";

}  // namespace verification

struct VerificationRow {
  std::string name;
  double published = 0, ours = 0;
  double tolerance = 0;  ///< of the difference, in `unit`
  std::string unit, source;
  double error() const { return ours - published; }
  bool pass() const { return std::abs(error()) <= tolerance; }
};

/// What a case sets before an engine at t = 0.
struct VerificationSetup {
  /// Solid behind, free in front of `point`, where `normal` (of length 1) looks.
  struct Plane {
    Vec3 point, normal{0, 0, 1};
    int material = 0;
  };
  struct Grain {
    Vec3 position, velocity, spin;
    double radius = 0;
    int material = 0;
  };
  Materials materials;
  ContactLaws laws;
  std::vector<Plane> planes;
  std::vector<Grain> grains;
  Vec3 gravity;
  /// [s]; some cases step as coarsely as they were published, so an engine must not refuse it.
  double dt = 0;
};

/// What a case asks of an engine. Velocity and spin are those of the step, v(t) and w(t), not of half a step ago.
class VerificationEngine {
 public:
  virtual ~VerificationEngine() = default;
  virtual void step(long count) = 0;
  virtual Vec3 position(int grain) = 0;
  virtual Vec3 velocity(int grain) = 0;
  virtual Vec3 spin(int grain) = 0;
  /// Force of the contact on `grain` along the contact's normal [N], pushing positive: elastic, damping and cohesion.
  /// `other` is a grain, or -1 - p for plane p; 0 where the two do not touch.
  virtual double normal_force(int grain, int other) = 0;
};

using StartEngine = std::function<std::unique_ptr<VerificationEngine>(const VerificationSetup&)>;

/// A set-up or a few alike, and the rows that come of them. Each row's name begins with one of `names`, so that a case
/// can be chosen by name before anything is computed.
struct VerificationCase {
  std::vector<std::string> names;
  std::function<void(std::vector<VerificationRow>& rows, const StartEngine& start)> add_rows;
};

/// Chung and Ooi 2011, Granular Matter 13:643, tests 1 to 8.
std::vector<VerificationCase> chung_ooi_cases();
/// Closed forms of a grain that slides, rolls, stands on a slope or bounces.
std::vector<VerificationCase> motion_cases();
/// Closed forms of a grain that sticks.
std::vector<VerificationCase> adhesion_cases();
/// End states that MercuryDPM keeps for its own tests.
std::vector<VerificationCase> mercury_cases();
/// Plates, ridges, corners, a turntable and a drum of triangles, on the fast engine whichever is started.
std::vector<VerificationCase> mesh_cases();
/// Closed forms of grains of several spheres, on the fast engine whichever is started.
std::vector<VerificationCase> clump_cases();
/// What must not depend on the time step, each at a step, a half and a quarter of it: grains that roll or spin, two
/// that spin as one (by the law alone), a wheel in a small bin (on the fast engine whichever is started).
std::vector<VerificationCase> step_size_cases();
/// All of them.
std::vector<VerificationCase> verification_cases();

/// The rows of these cases, in order. `progress`, where there is any, hears how many cases are done and of how many,
/// after each; it may throw to stop.
std::vector<VerificationRow> rows_of(const std::vector<VerificationCase>& cases, const StartEngine& start,
                                     const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace soilbin::dem
