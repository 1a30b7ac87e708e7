#include "dem/verification/fast_engine.hpp"

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {
namespace {

Setup setup_of(const VerificationSetup& setup) {
  Setup out{setup.materials, setup.laws, {}, {}};
  out.numerics.dt = setup.dt;
  out.numerics.force_step = true;  // some cases are published with coarse steps
  out.numerics.threads = 1;
  return out;
}

class FastEngine : public VerificationEngine {
 public:
  explicit FastEngine(const VerificationSetup& setup) : simulation_(setup_of(setup)) {
    simulation_.set_gravity(setup.gravity);
    for (const VerificationSetup::Plane& plane : setup.planes) {
      Body body;
      body.surfaces = {{Plane{plane.point, plane.normal}, plane.material}};
      simulation_.add_body(body);
    }
    for (const VerificationSetup::Grain& g : setup.grains)
      simulation_.add_grain(g.position, g.radius, g.material, g.velocity, g.spin);
  }

  void step(long count) override { simulation_.run(count); }
  Vec3 position(int grain) override { return now(grain).position; }
  Vec3 velocity(int grain) override { return now(grain).velocity; }
  Vec3 spin(int grain) override { return now(grain).spin; }

  double normal_force(int grain, int other) override {
    simulation_.run(0);  // finds the contacts where nothing has run yet
    for (const Contact& contact : simulation_.contacts()) {
      const bool as_given = contact.first == static_cast<GrainId>(grain) && contact.second == other;
      const bool turned = contact.second == grain && static_cast<int>(contact.first) == other;
      if (as_given || turned) return dot(contact.force, contact.normal);
    }
    return 0;
  }

 private:
  GrainNow now(int grain) const { return simulation_.grain(static_cast<GrainId>(grain)); }

  Simulation simulation_;
};

}  // namespace

std::unique_ptr<VerificationEngine> start_fast_engine(const VerificationSetup& setup) {
  return std::make_unique<FastEngine>(setup);
}

}  // namespace soilbin::dem
