// multipass: earlier passes have compacted the rut.
//
// Soil that a wheel has gone over is denser: a later pass sinks less into the rut's floor and meets less resistance.
// Its contact is shorter too, so at small slip, where that leaves the shear less mobilised, a rut that is only stiffer
// can cost pull; at large slip it always gives some. What 'sinkage' shows depends on where it is counted from: from
// the rut's floor it falls with the pass, from the undisturbed surface (conventions.md) it grows. There are forms for
// both. The rut left by the passes before is taken as deep as Bekker's static sinkage of the load that they carried,
// which is the wheel's own where the condition tells no rut_load; so with their slip (rut_slip).
#include <algorithm>
#include <cmath>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {
namespace {

double passes_before(const Surroundings& around) { return std::max(0, around.at.pass - 1); }

/// 1 - exp(-(pass - 1)/p0): 0 on undisturbed soil, 1 where further passes change nothing.
double compacted(const Surroundings& around, double p0) { return -std::expm1(-passes_before(around) / p0); }

/// k = k_0 (1 + a [1 - exp(-(pass - 1)/p0)]).
class Stiffer final : public Effect {
 public:
  explicit Stiffer(const std::vector<double>& p) : amplitude_(p[0]), p0_(p[1]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    scale_stiffness(soil, 1 + amplitude_ * compacted(around, p0_));
  }

 private:
  double amplitude_, p0_;
};

/// The soil under the rut's floor answers as virgin soil does deeper down: y -> y + h y/(y + e z_p). Close to the floor
/// it is stiff (reloading, Wong), once pressed in by more than the elastic share e z_p it follows the virgin curve at
/// the total depth y + h.
class Reload final : public Effect {
 public:
  Reload(const std::vector<double>& p, bool from_surface)
      : amplitude_(p[0]), p0_(p[1]), elastic_(p[2]), from_surface_(from_surface) {}
  PressureLaw pressure_law() const override { return PressureLaw::by_depth; }
  void soil_depth(ContactPatch& patch, const Surroundings& around) const override {
    const double share = left_share(around);
    if (share == 0.0) return;
    const double z_p = rut(around), h = share * z_p, e = elastic_ * z_p;
    if (h == 0.0) return;
    for (double& depth : patch.of(&ContactPatch::depth)) depth *= 1 + h / (depth + e);
  }
  void sensor(Reading& reading, const Surroundings& around) const override {
    if (!from_surface_) return;
    if (const double share = left_share(around); share != 0.0) reading.sinkage += share * rut(around);
  }

 private:
  static double rut(const Surroundings& around) {
    const OperatingCondition& at = around.at;
    const double load = at.rut_load ? around.normal_load * (*at.rut_load / at.load) : around.normal_load;
    return load > 0.0 ? bekker_static_sinkage(around.declared, around.tire.radius, around.tire.width, load) : 0.0;
  }
  /// Depth of the rut that the passes have left, over the static sinkage.
  double left_share(const Surroundings& around) const { return amplitude_ * compacted(around, p0_); }
  double amplitude_, p0_, elastic_;
  bool from_surface_;
};

/// f = 1 + a [1 - exp(-|s|/s1) + q m], m = [1 - exp(-(pass - 1)/p0)]/[1 - exp(-1/p0)] from the second pass on: k, c and
/// density grow by it, K shrinks by it. m is 1 on the second pass; that further passes add less and less is ours:
/// Senatore and Sandu's line q (pass - 1) has no end.
class SlipHardening final : public Effect {
 public:
  explicit SlipHardening(const std::vector<double>& p) : amplitude_(p[0]), s1_(p[1]), per_pass_(p[2]), p0_(p[3]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    if (passes_before(around) == 0.0) return;
    const double passes = compacted(around, p0_) / -std::expm1(-1 / p0_);
    const double worked = -std::expm1(-std::abs(around.at.rut_slip.value_or(around.motion.slip)) / s1_);
    const double factor = 1 + amplitude_ * (worked + per_pass_ * passes);
    scale_stiffness(soil, factor);
    soil.cohesion *= factor;
    soil.density *= factor;
    soil.shear_modulus /= factor;
  }

 private:
  double amplitude_, s1_, per_pass_, p0_;
};

/// Depth under the undisturbed surface z = z_b pass^e; forces as on the first pass. A power has no end: passes beyond
/// the twentieth deepen the rut no more.
class RutPower final : public Effect {
 public:
  explicit RutPower(const std::vector<double>& p) : exponent_(p[0]) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    reading.sinkage *= std::pow(std::min(1 + passes_before(around), last_), exponent_);
  }

 private:
  static constexpr double last_ = 20.0;
  double exponent_;
};

EffectForm reload(const std::string& form, bool from_surface) {
  return {
      .id = "multipass",
      .form = form,
      .equation = std::string("sigma = k (y + h y/(y + e z_p))^n, h = a z_p [1 - exp(-(pass - 1)/p0)], ") +
                  (from_surface ? "z = y + h" : "z = y") + "; z_p: Bekker's static sinkage",
      .source =
          "stated here; after Wong, Theory of Ground Vehicles, ch. 2 (soil loaded again is stiffer; there by a line)",
      .parameters = {{"a", "-", 0.6, 0.0, 1.5, "depth of the rut left by many passes over the static sinkage"},
                     {"p0", "-", 1.0, 0.2, 20.0, "passes after which most of the compaction is done"},
                     {"e", "-", 0.1, 0.02, 1.0, "elastic share: rebound of the rut over the static sinkage"}},
      .steady_only = from_surface ? "a drive counts its sinkage from the rut's floor: take the variant reload" : "",
      .conditions = {"pass"},
      .sinkage_from_rut_floor = !from_surface,
      .make = [from_surface](const std::vector<double>& p) { return std::make_unique<const Reload>(p, from_surface); }};
}

}  // namespace

std::vector<EffectForm> multipass_forms() {
  const std::string id = "multipass";
  return {
      {.id = id,
       .form = "stiffer",
       .equation = "k = k_0 (1 + a [1 - exp(-(pass - 1)/p0)]); sinkage from the rut's floor",
       .source = "stated here; after Holm 1969, J. Terramechanics 6(3) (a rut's soil stiffens, most on the first pass)",
       .parameters = {{"a", "-", 0.5, 0.0, 20.0, "relative growth of the stiffness after many passes"},
                      {"p0", "-", 1.0, 0.2, 20.0, "passes after which most of the compaction is done"}},
       .conditions = {"pass"},
       .sinkage_from_rut_floor = true,
       .make = maker<Stiffer>()},
      reload("reload", false),
      reload("reload_from_surface", true),
      {.id = id,
       .form = "slip_hardening",
       .equation = "k, c, density times f, K over f, f = 1 + a [1 - exp(-|s|/s1) + q m], m = [1 - exp(-(pass - 1)/p0)]/"
                   "[1 - exp(-1/p0)] for pass > 1",
       .source =
           "after Senatore and Sandu 2011, J. Terramechanics 48(4):265 (there the earlier pass's slip, m = pass - "
           "1 without end)",
       .parameters = {{"a", "-", 0.3, 0.0, 5.0, "relative growth of the strength by slip in the earlier passes"},
                      {"s1", "-", 0.2, 0.02, 2.0, "slip that does most of it"},
                      {"q", "-", 0.3, 0.0, 2.0, "further growth by the second pass, over that by slip"},
                      {"p0", "-", 2.0, 0.2, 20.0, "passes after which most of the further growth is done"}},
       .conditions = {"pass"},
       .sinkage_from_rut_floor = true,
       .make = maker<SlipHardening>()},
      {.id = id,
       .form = "rut_power",
       .equation = "z = z_b pass^e, pass held below 20; forces unchanged",
       .source = "after Abebe, Tanaka, Yamazaki 1989, J. Terramechanics 26(2):139 (rut depth over passes, e = 1/a)",
       .parameters = {{"e", "-", 0.3, 0.0, 1.0, "growth of the total rut depth with the pass"}},
       .steady_only = "it changes what a gauge reads, not the wheel",
       .conditions = {"pass"},
       .make = maker<RutPower>()},
  };
}

}  // namespace soilbin::bekker_wong
