#include "tests/dem/reference_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace soilbin::dem::test {
namespace {

using std::numbers::pi;

double damping_ratio(double restitution) {
  if (restitution <= 0) return 1;
  const double ln = std::log(restitution);
  return -ln / std::sqrt(ln * ln + pi * pi);
}

/// `kept` in the plane normal to n, its length kept to fourth order, and turned in it.
Vec3 turned(const Vec3& kept, const Vec3& n, double angle) {
  if (squared(kept) == 0) return kept;
  const double s = dot(kept, n);
  const Vec3 in_plane = (1 + s * s / (2 * squared(kept))) * (kept - s * n);
  return std::cos(angle) * in_plane + std::sin(angle) * cross(n, in_plane);
}

/// A spring beside a dashpot, behind a slider. What exceeds the limit is slip of the slider alone.
Vec3 slider(Vec3& kept, const Vec3& rate, double stiffness, double damping, double limit, double dt) {
  kept += dt * rate;
  const Vec3 trial = -stiffness * kept - damping * rate;
  if (length(trial) <= limit) return trial;
  const Vec3 pull = limit * unit(trial);
  if (stiffness + damping > 0) kept += 1 / (stiffness + damping / dt) * (trial - pull);
  return pull;
}

double least_jkr_radius(double radius, double young, double work) {
  return std::cbrt(pi * work * radius * radius / (8 * young));
}

double overlap_where_jkr_breaks(double radius, double young, double work) {
  return -0.75 * std::cbrt(pi * pi * work * work * radius / (young * young));
}

/// Nearest image of a distance along one axis.
double nearest(double d, double period) { return period > 0 ? d - period * std::round(d / period) : d; }

}  // namespace

double reference_jkr_radius(double overlap, double radius, double young, double work) {
  const auto overlap_at = [&](double a) { return a * a / radius - std::sqrt(2 * pi * work * a / young); };
  double low = least_jkr_radius(radius, young, work);  // from here on overlap_at rises
  double high = 2 * low + std::sqrt(radius * std::abs(overlap));
  while (overlap_at(high) < overlap) high *= 2;
  for (int turn = 0; turn < 100; ++turn) {
    const double middle = (low + high) / 2;
    (overlap_at(middle) < overlap ? low : high) = middle;
  }
  return (low + high) / 2;
}

ReferenceEngine::ReferenceEngine(Materials materials, const ContactLaws& laws, double dt)
    : materials_(std::move(materials)), laws_(laws), dt_(dt) {
  if (laws.cohesion == CohesionLaw::jkr && laws.normal != NormalLaw::hertz)
    throw std::invalid_argument("jkr needs the hertz law");
}

int ReferenceEngine::add(const ReferenceGrain& grain) {
  if (begun_) throw std::logic_error("the run has begun");
  grains_.push_back(grain);
  return size() - 1;
}

int ReferenceEngine::add(const ReferencePlane& plane) {
  if (begun_) throw std::logic_error("the run has begun");
  planes_.push_back(plane);
  return static_cast<int>(planes_.size()) - 1;
}

double ReferenceEngine::mass(int i) const {
  const auto& g = grains_[i];
  if (g.held) return std::numeric_limits<double>::infinity();
  return materials_.all[g.material].density * 4.0 / 3 * pi * g.radius * g.radius * g.radius;
}

double ReferenceEngine::inertia(int i) const { return 0.4 * mass(i) * grains_[i].radius * grains_[i].radius; }

Vec3 ReferenceEngine::gravity_on(int i) const { return grains_[i].held ? Vec3{} : gravity; }

/// Forces at t = 0 from x(0) and v(0); then half a kick back.
void ReferenceEngine::begin() {
  if (begun_) return;
  begun_ = true;
  find_forces();
  for (int i = 0; i < size(); ++i) {
    grains_[i].v -= dt_ / 2 * (forces_[i] / mass(i) + gravity_on(i));
    grains_[i].w -= dt_ / 2 * (torques_[i] / inertia(i));
  }
  histories_.clear();
  find_forces();  // at t = 0 from the velocities of half a step before, like all that follow
}

void ReferenceEngine::step(long count) {
  begin();
  for (; count > 0; --count) {
    for (int i = 0; i < size(); ++i) {
      grains_[i].v += dt_ * (forces_[i] / mass(i) + gravity_on(i));
      grains_[i].w += dt_ * (torques_[i] / inertia(i));
      grains_[i].x += dt_ * grains_[i].v;
    }
    for (auto& plane : planes_) plane.point += dt_ * plane.velocity;
    ++steps_;
    find_forces();
  }
}

Vec3 ReferenceEngine::velocity(int i) {
  begin();
  return grains_[i].v + dt_ / 2 * (forces_[i] / mass(i) + gravity_on(i));
}

Vec3 ReferenceEngine::spin(int i) {
  begin();
  return grains_[i].w + dt_ / 2 * (torques_[i] / inertia(i));
}

const std::vector<ReferenceContact>& ReferenceEngine::contacts() {
  begin();
  return contacts_;
}

double ReferenceEngine::kinetic_energy() {
  double sum = 0;
  for (int i = 0; i < size(); ++i)
    if (!grains_[i].held) sum += mass(i) * squared(velocity(i)) / 2 + inertia(i) * squared(spin(i)) / 2;
  return sum;
}

void ReferenceEngine::find_forces() {
  forces_.assign(grains_.size(), {});
  torques_.assign(grains_.size(), {});
  contacts_.clear();
  std::map<std::pair<int, int>, History> next;
  for (int i = 0; i < size(); ++i) {
    const auto& g = grains_[i];
    for (int j = i + 1; j < size(); ++j) {
      if (g.held && grains_[j].held) continue;
      Vec3 d = g.x - grains_[j].x;
      d = {nearest(d.x, box.x), nearest(d.y, box.y), nearest(d.z, box.z)};
      touch(i, j, unit(d), g.radius + grains_[j].radius - length(d), next);
    }
    for (int p = 0; p < static_cast<int>(planes_.size()) && !g.held; ++p) {
      const Vec3& n = planes_[p].normal;
      touch(i, -1 - p, n, g.radius - dot(g.x - planes_[p].point, n), next);
    }
  }
  histories_ = std::move(next);  // what does not touch any more is forgotten
}

/// The starred quantities and the relative motion of i against j.
ReferenceEngine::Pair ReferenceEngine::stars(int i, int j, const Vec3& n, double overlap) const {
  const auto& g = grains_[i];
  const int other = j >= 0 ? grains_[j].material : planes_[-1 - j].material;
  const Material &m1 = materials_.all[g.material], &m2 = materials_.all[other];
  Pair p;
  p.of = materials_.between(g.material, other);
  p.young = 1 / ((1 - m1.poisson * m1.poisson) / m1.young + (1 - m2.poisson * m2.poisson) / m2.young);
  p.shear =
      1 / (2 * (2 - m1.poisson) * (1 + m1.poisson) / m1.young + 2 * (2 - m2.poisson) * (1 + m2.poisson) / m2.young);
  const double arm = g.radius - overlap / 2, mi = mass(i), ii = inertia(i), ji = 1.4 * mi * g.radius * g.radius;
  if (j < 0) {
    p.radius = g.radius, p.mass = mi, p.inertia = ii, p.rolling_inertia = ji;
    p.velocity = g.v - arm * cross(g.w, n) - planes_[-1 - j].velocity;
    p.rotation = g.w;
    p.turning = dot(g.w, n) / 2;
    return p;
  }
  const auto& h = grains_[j];
  const double arm2 = h.radius - overlap / 2, mj = mass(j), ij = inertia(j), jj = 1.4 * mj * h.radius * h.radius;
  p.radius = g.radius * h.radius / (g.radius + h.radius);
  p.mass = 1 / (1 / mi + 1 / mj);  // an infinite one drops out
  p.inertia = 1 / (1 / ii + 1 / ij);
  p.rolling_inertia = 1 / (1 / ji + 1 / jj);
  p.velocity = g.v - h.v - cross(arm * g.w + arm2 * h.w, n);
  p.rotation = g.w - h.w;
  p.turning = dot(g.w + h.w, n) / 2;
  return p;
}

void ReferenceEngine::touch(int i, int j, const Vec3& n, double overlap, std::map<std::pair<int, int>, History>& next) {
  const auto before = histories_.find({i, j});
  const bool touched = before != histories_.end();
  if (overlap <= 0 && !(touched && laws_.cohesion == CohesionLaw::jkr)) return;
  const Pair pair = stars(i, j, n, overlap);
  if (overlap <= 0 && overlap <= overlap_where_jkr_breaks(pair.radius, pair.young, pair.of.cohesion)) return;

  History& history = next[{i, j}];
  if (touched) history = before->second;
  ReferenceContact contact;
  contact.i = i, contact.j = j, contact.normal = n, contact.overlap = overlap;
  apply(contact, pair, history);

  forces_[i] += contact.force;
  torques_[i] += contact.couple - (grains_[i].radius - overlap / 2) * cross(n, contact.tangential);
  if (j >= 0) {
    forces_[j] -= contact.force;
    torques_[j] -= contact.couple + (grains_[j].radius - overlap / 2) * cross(n, contact.tangential);
  }
  contacts_.push_back(contact);
}

/// The laws, in the order of the page.
void ReferenceEngine::apply(ReferenceContact& contact, const Pair& p, History& history) const {
  const bool hertz = laws_.normal == NormalLaw::hertz, jkr = laws_.cohesion == CohesionLaw::jkr;
  const double work = p.of.cohesion, delta = contact.overlap;
  const double a = jkr ? reference_jkr_radius(delta, p.radius, p.young, work) : std::sqrt(p.radius * delta);
  const double k_n = hertz ? 4.0 / 3 * p.young * a : p.of.normal_stiffness;
  const double k_t = hertz ? 8 * p.shear * a : p.of.shear_stiffness;
  const double critical = 2 * (hertz ? std::sqrt(5.0 / 6) : 1) * damping_ratio(p.of.restitution);
  const double g_n = critical * std::sqrt((hertz ? 2 * p.young * a : k_n) * p.mass);
  const double g_t =
      laws_.tangential_damping >= 0 ? laws_.tangential_damping * g_n : critical * std::sqrt(k_t * p.mass);

  double elastic = k_n * delta, cohesion = 0, pull_off = 0;
  if (jkr) {
    elastic = 4.0 / 3 * p.young * a * a * a / p.radius - std::sqrt(8 * pi * work * p.young * a * a * a);
    pull_off = 1.5 * pi * work * p.radius;
  }
  if (laws_.cohesion == CohesionLaw::linear) cohesion = -p.of.cohesion * pi * p.radius * delta;
  const double v_n = dot(p.velocity, contact.normal);
  const double damping = -g_n * v_n;

  contact.pressing = std::max(elastic + damping + 2 * pull_off, 0.0);
  contact.tangential = tangential(p, contact.normal, p.of.sliding_friction * contact.pressing, k_t, g_t, history.slide);
  contact.force = (elastic + damping + cohesion) * contact.normal + contact.tangential;
  contact.couple = rolling(p, contact.normal, contact.pressing, k_n, history.roll) +
                   twisting(p, contact.normal, contact.pressing, a, k_t, g_t, history.twist) * contact.normal;
}

Vec3 ReferenceEngine::tangential(const Pair& p, const Vec3& n, double limit, double stiffness, double damping,
                                 Vec3& slide) const {
  slide = turned(slide, n, p.turning * dt_);
  return slider(slide, p.velocity - dot(p.velocity, n) * n, stiffness, damping, limit, dt_);
}

double ReferenceEngine::twisting(const Pair& p, const Vec3& n, double pressing, double a, double stiffness,
                                 double damping, double& twist) const {
  if (laws_.twisting == TwistingLaw::none) return 0;
  Vec3 along{twist, 0, 0};
  const double limit = 2.0 / 3 * a * p.of.sliding_friction * pressing;
  const Vec3 couple = slider(along, {dot(p.rotation, n), 0, 0}, stiffness * a * a / 2, damping * a * a / 2, limit, dt_);
  twist = along.x;
  return couple.x;
}

Vec3 ReferenceEngine::rolling(const Pair& p, const Vec3& n, double pressing, double k_n, Vec3& roll) const {
  if (laws_.rolling == RollingLaw::none) return {};
  const double limit = p.of.rolling_friction * p.radius * pressing;
  const Vec3 w_t = p.rotation - dot(p.rotation, n) * n;
  if (laws_.rolling == RollingLaw::directional || laws_.rolling == RollingLaw::directional_with_twist) {
    const Vec3 w = laws_.rolling == RollingLaw::directional ? w_t : p.rotation;
    const double rate = length(p.rotation);
    if (rate == 0) return {};
    return -std::min(limit, p.inertia * rate / dt_) / rate * w;
  }
  roll = turned(roll, n, p.turning * dt_);
  if (laws_.rolling == RollingLaw::spring_slider) {
    const double r2 = p.radius * p.radius;
    return slider(roll, w_t, p.of.rolling_stiffness * r2, p.of.rolling_viscosity * r2, limit, dt_);
  }
  roll += dt_ * w_t;
  if (laws_.rolling == RollingLaw::torsion_spring) return -p.of.rolling_stiffness * roll;
  const double lever = p.of.rolling_friction * p.radius;  // elastic_plastic
  const double k_r = 2.25 * k_n * lever * lever;
  const double c_r = 2 * p.of.rolling_damping * std::sqrt(p.rolling_inertia * k_r);
  if (k_r * length(roll) <= limit) return -k_r * roll - c_r * w_t;
  roll = limit / k_r * unit(roll);
  return -k_r * roll;
}

}  // namespace soilbin::dem::test
