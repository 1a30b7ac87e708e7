// Mean velocities of the soil round a wheel.
#pragma once

#include "dem/engine/grains.hpp"
#include "dem/rig/wheel_outcome.hpp"
#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

/// Adds up what grains do near the middle plane of a wheel, moment by moment.
class FlowMeter {
 public:
  /// Cells reach `ahead` to both sides of the axle and from `below` to `above` it; the plane is as thick as two cells.
  /// `solid`: volume of a grain over that of its spheres, of which overlaps count once.
  FlowMeter(double cell, double ahead, double below, double above, double solid = 1);

  /// Velocities are taken as the engine keeps them, half a step behind: free fall adds g dt/2 to a bed at rest.
  void add(const Grains& grains, const Vec3& axle);
  /// The means so far.
  SoilFlow flow() const;

  /// One of the same cells, with nothing in it yet.
  FlowMeter empty_one() const;
  /// What several processes saw of one moment: `join` makes each list of sums that of all.
  template <class Join>
  void join(const Join& join_sums) {
    join_sums(volume_), join_sums(vx_), join_sums(vz_);
  }
  /// Other moments, of the same cells.
  FlowMeter& operator+=(const FlowMeter& other);

  /// For StagedRun::keep: all but the cells' layout.
  template <class Notes>
  void state(Notes& notes) {
    notes(moments_, volume_, vx_, vz_);
  }

 private:
  SoilFlow layout_;
  std::vector<double> volume_, vx_, vz_;
  double moments_ = 0, solid_ = 1;
};

template <class Notes>
void archive(Notes& notes, FlowMeter& meter) {
  meter.state(notes);
}

}  // namespace soilbin::dem
