// The reference engine behind the interface of the verification cases.
#pragma once

#include <memory>

#include "dem/verification/cases.hpp"
#include "tests/dem/reference_engine.hpp"

namespace soilbin::dem::test {

class ReferenceVerification : public VerificationEngine {
 public:
  explicit ReferenceVerification(const VerificationSetup& setup) : engine_(setup.materials, setup.laws, setup.dt) {
    engine_.gravity = setup.gravity;
    for (const auto& plane : setup.planes) engine_.add(ReferencePlane{plane.point, plane.normal, {}, plane.material});
    for (const auto& g : setup.grains)
      engine_.add(ReferenceGrain{g.position, g.velocity, g.spin, g.radius, g.material});
  }
  void step(long count) override { engine_.step(count); }
  Vec3 position(int grain) override { return engine_.position(grain); }
  Vec3 velocity(int grain) override { return engine_.velocity(grain); }
  Vec3 spin(int grain) override { return engine_.spin(grain); }
  double normal_force(int grain, int other) override {
    for (const auto& contact : engine_.contacts())
      if ((contact.i == grain && contact.j == other) || (contact.i == other && contact.j == grain))
        return contact.normal_force();
    return 0;
  }

 private:
  ReferenceEngine engine_;
};

inline std::unique_ptr<VerificationEngine> start_reference(const VerificationSetup& setup) {
  return std::make_unique<ReferenceVerification>(setup);
}

}  // namespace soilbin::dem::test
