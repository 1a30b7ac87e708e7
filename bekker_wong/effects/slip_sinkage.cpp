// slip_sinkage: the wheel digs itself in as slip grows.
//
// A turning wheel carries soil backward from under itself; at 60 % slip measured sinkage is several times the static
// one where the base model's is flat (Ding et al. 2010). Forms differ in what gives: the soil's law (stiffness falls
// with slip, so the balance moves deeper) or the position (the wheel settles deeper at stresses that still carry the
// load).
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/rolling_wheel.hpp"

namespace soilbin::bekker_wong {
namespace {

double driven_slip(const Surroundings& around) { return std::max(0.0, around.motion.slip); }

/// n = n0 + n1 |s| (Ding): the exponent grows, so the same load sits deeper (z < 1 m, the unit that k is fixed at).
class GrowingExponent final : public Effect {
 public:
  explicit GrowingExponent(const std::vector<double>& p) : n1_(p[0]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    if (n1_ != 0.0) soil.exponent = std::max(0.05, soil.exponent + n1_ * std::abs(around.motion.slip));
  }

 private:
  double n1_;
};

/// Total sinkage z = z_b f(s) with f(0) = 1; the wheel settles deeper after the balance.
template <double (*Factor)(double amplitude, double slip)>
class Settling final : public Effect {
 public:
  explicit Settling(const std::vector<double>& p) : amplitude_(p[0]) {}
  double settle(double sinkage, const Rolling& rolling) const override {
    return sinkage * Factor(amplitude_, driven_slip(rolling.around));
  }

 private:
  double amplitude_;
};

/// Pressure at depth z f(s)^-1: the soil answers as if it had been pressed less deep by what slip has dug away.
template <double (*Factor)(double amplitude, double slip)>
class Loosening final : public Effect {
 public:
  explicit Loosening(const std::vector<double>& p) : amplitude_(p[0]) {}
  PressureLaw pressure_law() const override { return PressureLaw::by_depth; }
  void pressure(ContactPatch& patch, const SoilValues& soil, const Outline&,
                const Surroundings& around) const override {
    const double factor = std::pow(Factor(amplitude_, driven_slip(around)), -soil.exponent);
    for (double& sigma : patch.of(&ContactPatch::sigma)) sigma *= factor;
  }

 private:
  double amplitude_;
};

double lyasko(double a, double s) { return (1 + a * s) / (1 - 0.5 * a * s); }
double linear(double a, double s) { return 1 + a * s; }

/// Reece: added sinkage h s/(1 - s), with a length h of the order of the lug height or the shear displacement.
class Reece final : public Effect {
 public:
  explicit Reece(const std::vector<double>& p) : length_(p[0]) {}
  double settle(double sinkage, const Rolling& rolling) const override {
    const double s = std::min(driven_slip(rolling.around), 0.95);
    return sinkage + length_ * s / (1 - s);
  }

 private:
  double length_;
};

/// Reece's h s/(1 - s) is h times the way that the tread slides over the way that it rolls, held below 100. So counted,
/// a braked tread and a wheel that goes sideways dig as well, and digging comes to an end: at a share of the radius
/// along the wheel's plane, at 0.9 of it across.
class Sliding final : public Effect {
 public:
  explicit Sliding(const std::vector<double>& p) : length_(p[0]), driven_end_(p[1]), braked_end_(p[2]) {}
  double settle(double sinkage, const Rolling& rolling) const override {
    const Kinematics& motion = rolling.around.motion;
    const double radius = rolling.outline.radius, rim = motion.rim();
    const double least = least_rolled * std::max(rim, std::hypot(motion.forward, motion.lateral));
    const double rolls = std::max(std::min(rim, motion.forward), least), slides = rim - motion.forward;
    const double along = dug(std::abs(slides) / rolls, (slides > 0.0 ? driven_end_ : braked_end_) * radius);
    const double across = dug(std::abs(motion.lateral) / rolls, across_end * radius);
    const double deepest = std::max(sinkage, 0.98 * max_settled_share * radius - rolling.patch.deflection);
    return std::min(sinkage + std::hypot(along, across), deepest);
  }

 private:
  static constexpr double least_rolled = 0.01, across_end = 0.9;
  double dug(double slid, double end) const { return length_ * slid / (1 + length_ * slid / end); }
  double length_, driven_end_, braked_end_;
};

}  // namespace

std::vector<EffectForm> slip_sinkage_forms() {
  const std::string id = "slip_sinkage";
  const std::string settles = "it moves the wheel after the balance; ding and loosening change the soil instead";
  return {
      {.id = id,
       .form = "lyasko",
       .equation = "z = z_b (1 + a s)/(1 - a s/2), a = 1: Lyasko; stresses scaled to carry the load",
       .source = "Lyasko 2010, J. Terramechanics 47(1):21 (a = 1)",
       .parameters = {{"a", "-", 1.0, 0.0, 1.6, "amplitude; 1 gives Lyasko's factor"}},
       .steady_only = settles,
       .make = maker<Settling<lyasko>>()},
      {.id = id,
       .form = "ding",
       .equation = "n = n0 + n1 |s|",
       .source = "Ding, Gao, Deng, Tao 2010, J. Cent. South Univ. Technol. 17:129 (sinkage exponent grows with slip)",
       .parameters = {{"n1", "-", 0.4, -0.5, 3.0, "growth of the exponent with slip"}},
       .make = maker<GrowingExponent>()},
      {.id = id,
       .form = "linear",
       .equation = "z = z_b (1 + S s); stresses scaled to carry the load",
       .source = "after Lyasko 2010, J. Terramechanics 47(1):21 (linear slip-sinkage coefficient S)",
       .parameters = {{"S", "-", 1.0, 0.0, 5.0, "slip sinkage at full slip over the balanced sinkage"}},
       .steady_only = settles,
       .make = maker<Settling<linear>>()},
      {.id = id,
       .form = "loosening",
       .equation = "sigma = k (z/f)^n, f = (1 + a s)/(1 - a s/2)",
       .source = "after Lyasko 2010, J. Terramechanics 47(1):21, the factor taken inside the pressure law",
       .parameters = {{"a", "-", 1.0, 0.0, 1.6, "amplitude; 1 gives Lyasko's factor"}},
       .make = maker<Loosening<lyasko>>()},
      {.id = id,
       .form = "reece",
       .equation = "z = z_b + h s/(1 - s), s held below 0.95; stresses scaled to carry the load",
       .source = "after Reece 1965, Principles of Soil-Vehicle Mechanics, Proc. IMechE 180(2A)",
       .parameters = {{"h", "mm", 0.01, 0.0, 0.2, "length of soil that slip digs away"}},
       .steady_only = settles,
       .make = maker<Reece>()},
      {.id = id,
       .form = "sliding",
       .equation =
           "z = z_b + sqrt(D(x, d r)^2 + D(y, 0.9 r)^2), D(x, L) = h x/(1 + h x/L), x and y: ways slid along and "
           "across over the way rolled, held below 100 (driven x = s/(1 - s)), d_b for d where braked; stresses "
           "scaled to carry the load",
       .source = "stated: after Reece 1965, Proc. IMechE 180(2A), his h s/(1 - s) taken for sliding in any direction",
       .parameters =
           {{"h", "mm", 0.015, 0.0, 0.2, "length of soil that sliding digs away"},
            {"d", "-", 0.3, 0.02, 1.0, "depth that a driven tread digs at most, as a share of the radius", {}, 0.2},
            {"d_b", "-", 0.4, 0.02, 1.0, "depth that a braked tread digs at most, as a share of the radius", {}, 0.2}},
       .steady_only = settles,
       .make = maker<Sliding>()},
  };
}

}  // namespace soilbin::bekker_wong
