#include <fmt/core.h>
#include <gtest/gtest.h>
#include <chrono>
#include "bekker_wong/transient/driving.hpp"
namespace soilbin::bekker_wong {
TEST(Probe, X) {
  Scenario s; s.tire.radius=0.09; s.tire.width=0.11;
  s.soil.semi_empirical = SemiEmpiricalSoil{.exponent={1.1,0},.k_c={990,0},.k_phi={1.52843e6,0},.cohesion={1040,0},.friction_angle={28*3.14159265358979/180,0},.shear_modulus={0.02,0},.stress_angle_c1={0.18,0},.stress_angle_c2={0.32,0}};
  Drive d; d.load=64.68; d.duration=20; d.controller.rim_speed=0.05; 
  const char* al = getenv("SLOPE"); const char* db=getenv("DB");
  Waypoint w; w.longitudinal_incline = (al?atof(al):0)*3.14159265/180; w.drawbar = db?atof(db):0; d.profile={w};
  DriveNumerics n; if (getenv("N")) n.nodes=atoi(getenv("N")); if (getenv("TOL")) n.relative_tolerance=atof(getenv("TOL"));
  auto t0=std::chrono::steady_clock::now();
  auto r = drive_wheel(s,d,40,n);
  double ms = std::chrono::duration<double>(std::chrono::steady_clock::now()-t0).count()*1e3;
  fmt::print("   t      x        v       rim     slip   cslip   z[mm]   M      F     motor   kin    height draw comp shear damp rest\n");
  for (auto& q : r.samples) fmt::print("{:6.3f} {:8.5f} {:8.5f} {:8.5f} {:7.4f} {:7.4f} {:7.4f} {:7.4f} {:7.3f} {:.4g} {:.3g} {:.3g} {:.3g} {:.4g} {:.4g} {:.3g} {:.2g}\n", q.time,q.travelled,q.speed,q.rim_speed,q.slip.value_or(-9),q.contact_slip,q.sinkage*1e3,q.torque,q.forward,q.energy.motor,q.energy.kinetic,q.energy.height,q.energy.drawbar,q.energy.compaction,q.energy.shear,q.energy.damping,q.energy.unaccounted());
  fmt::print("{} at {} ; {} steps {} rates {} jac {} fails; {} ms\n", word_of(r.end), r.end_time, r.effort.steps, r.effort.rate_calls, r.effort.jacobians, r.effort.failed_steps, ms);
  RollingWheel wheel(s.tire, {1.1,990,1.52843e6,1040,28*3.14159265358979/180,0.02,0.18,0.32,1500});
  OperatingCondition at; at.load=d.load; at.longitudinal_incline=w.longitudinal_incline; at.slip=*r.samples.back().slip;
  auto st = wheel.roll(at).reading;
  auto& q=r.samples.back();
  fmt::print("static: DP {} vs {}; M {} vs {}; z {} vs {}\n", st.drawbar_pull, w.drawbar, st.torque, q.torque, st.sinkage, q.sinkage);
}
}
