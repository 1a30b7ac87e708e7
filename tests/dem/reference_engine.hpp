// docs/theory/dem-laws.md a second time, in the plainest way: every pair is looked at in every step, in double, with
// histories in a map. Slow and independent of dem/engine on purpose; the fast engine is held against it.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "dem/engine/materials.hpp"
#include "dem/surface/vec3.hpp"

namespace soilbin::dem::test {

struct ReferenceGrain {
  Vec3 x, v, w;  ///< [m], [m/s], [rad/s]; once the run has begun, v and w are those of half a step ago
  double radius = 0;
  int material = 0;
  bool held = false;  ///< of infinite mass, at rest; v and w must be 0
};

/// Solid behind, free in front of `point`, where `normal` (of length 1) looks.
struct ReferencePlane {
  Vec3 point, normal{0, 0, 1}, velocity;
  int material = 0;
};

/// One contact at the time of the engine. `j` is a grain, or -1 - p for plane p.
struct ReferenceContact {
  int i = 0, j = 0;
  double overlap = 0;
  Vec3 normal;          ///< toward i
  Vec3 force;           ///< on i
  Vec3 tangential;      ///< part of `force`
  Vec3 couple;          ///< M on i
  double pressing = 0;  ///< F_N
  double normal_force() const { return dot(force, normal); }
};

class ReferenceEngine {
 public:
  ReferenceEngine(Materials materials, const ContactLaws& laws, double dt);

  Vec3 gravity;
  Vec3 box;  ///< length of the period along x, y and z; 0: not periodic

  int add(const ReferenceGrain& grain);
  int add(const ReferencePlane& plane);
  void step(long count = 1);

  double time() const { return static_cast<double>(steps_) * dt_; }
  int size() const { return static_cast<int>(grains_.size()); }
  double mass(int i) const;  ///< infinite where it is held
  double inertia(int i) const;
  Vec3 position(int i) const { return grains_[i].x; }
  Vec3 velocity(int i);  ///< v(t), of the step
  Vec3 spin(int i);      ///< w(t), of the step
  const std::vector<ReferenceContact>& contacts();
  /// Translation and rotation, of v(t) and w(t) [J].
  double kinetic_energy();

 private:
  struct History {
    Vec3 slide, roll;
    double twist = 0;
  };
  /// What the laws need to know of a contact.
  struct Pair {
    Interaction of;
    double young, shear;                            // E*, G*
    double radius, mass, inertia, rolling_inertia;  // R*, m*, I*, J*
    Vec3 velocity, rotation;                        // v, w_r
    double turning;                                 // of both about n
  };

  void begin();
  void find_forces();
  Vec3 gravity_on(int i) const;  ///< none where it is held
  Pair stars(int i, int j, const Vec3& n, double overlap) const;
  void touch(int i, int j, const Vec3& n, double overlap, std::map<std::pair<int, int>, History>& next);
  void apply(ReferenceContact& contact, const Pair& pair, History& history) const;
  Vec3 tangential(const Pair& pair, const Vec3& n, double limit, double stiffness, double damping, Vec3& slide) const;
  double twisting(const Pair& pair, const Vec3& n, double pressing, double a, double stiffness, double damping,
                  double& twist) const;
  Vec3 rolling(const Pair& pair, const Vec3& n, double pressing, double stiffness, Vec3& roll) const;

  Materials materials_;
  ContactLaws laws_;
  double dt_;
  long steps_ = 0;
  bool begun_ = false;
  std::vector<ReferenceGrain> grains_;
  std::vector<ReferencePlane> planes_;
  std::vector<Vec3> forces_, torques_;
  std::vector<ReferenceContact> contacts_;
  std::map<std::pair<int, int>, History> histories_;
};

/// Contact radius of JKR: the larger root a of delta = a^2/R* - sqrt(2 pi w a/E*), by bisection.
double reference_jkr_radius(double overlap, double radius, double young, double work);

}  // namespace soilbin::dem::test
