// Cases with published or closed-form answers that an engine of docs/dem-laws.md must meet. A case knows its set-up,
// what is measured and the answer; it drives any engine through VerificationEngine. `soilbin verify` runs them on the
// fast engine, the tests on the reference engine too.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dem/engine/materials.hpp"
#include "dem/engine/vec3.hpp"

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

/// Chung and Ooi 2011, Granular Matter 13:643, tests 1 to 8.
std::vector<VerificationRow> chung_ooi_rows(const StartEngine& start);
/// Closed forms of a grain that slides, rolls, stands on a slope or bounces.
std::vector<VerificationRow> motion_rows(const StartEngine& start);
/// Closed forms of a grain that sticks.
std::vector<VerificationRow> adhesion_rows(const StartEngine& start);
/// End states that MercuryDPM keeps for its own tests.
std::vector<VerificationRow> mercury_rows(const StartEngine& start);
/// Plates, ridges, corners, a turntable and a drum of triangles, on the engine itself.
std::vector<VerificationRow> mesh_rows();
/// All of them.
std::vector<VerificationRow> verification_rows(const StartEngine& start);

}  // namespace soilbin::dem
