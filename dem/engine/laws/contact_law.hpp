// docs/theory/dem-laws.md as code: what a contact does, for one contact (Real = double) or for a pack of them at once.
// The formulas stand here and nowhere else; grains, planes and meshes differ only in the Touch that they fill in.
//
// Compiled once for each instruction set, so everything here is a template or always inlined, and no standard header
// with code of its own is included.
#pragma once

#include "dem/engine/laws/law_constants.hpp"
#include "dem/engine/laws/triple.hpp"

namespace soilbin::dem {

/// The geometry and motion of a contact, seen from grain i; symbols as on the page.
template <class Real>
struct Touch {
  Triple<Real> normal;    ///< n, toward i
  Real overlap;           ///< delta [m]
  Real radius;            ///< R* [m]
  Real mass;              ///< m* [kg]
  Triple<Real> velocity;  ///< v of i's surface against the other's [m/s]
  Triple<Real> rotation;  ///< w_r [rad/s]
  Real inertia;           ///< I* [kg m^2]; J* is 3.5 times that. Read where law::reads_inertia
  Real turning;           ///< of both about n: (w_i + w_j) . n/2 [rad/s]
  Triple<Real> before;    ///< n a step ago. Read by laws of twisting
};

/// What a contact remembers.
template <class Real>
struct Memory {
  Triple<Real> slide;  ///< xi [m]
  Triple<Real> roll;   ///< theta, and phi n of twisting [rad]
};

/// What a contact does, and, on demand, where its energy goes.
template <class Real>
struct Response {
  Triple<Real> force;       ///< on i [N]
  Triple<Real> tangential;  ///< its part in the tangent plane [N]
  Triple<Real> couple;      ///< M on i [N m]
  Real pressing;            ///< F_N [N]
};

/// Where a contact's energy goes, as powers [W], by the velocities of half a step ago.
template <class Real>
struct Losses {
  Real damping;        ///< lost in the normal dashpot
  Real shear_damping;  ///< lost in the tangential one
  Real sliding;        ///< lost in the slider
  Real into_slide;     ///< taken from the motion by tangential spring, dashpot and slider together
  Real into_roll;      ///< taken by rolling resistance
  Real dashpot;        ///< no power but the normal dashpot's push on i [N]
};

namespace law {

/// Squares of lengths that are divided by are at least this, so that two of them can share a division.
inline constexpr double least_square = 1e-140;
inline constexpr double least = 1e-70;

template <class Real>
struct Inverses {
  Real first, second;
};

/// 1/a and 1/b for one division, the slowest of operations.
template <class Real>
[[gnu::always_inline]] inline Inverses<Real> inverses(Real a, Real b) {
  const Real both = Real(1.0) / (a * b);
  return {b * both, a * both};
}

template <class Real>
[[gnu::always_inline]] inline Real size2(const Triple<Real>& a) {
  return max(dot(a, a), Real(least_square));
}

/// How the tangent plane turns about its normal within a step: the angle's sine, and one less its cosine, to fifth
/// order.
template <class Real>
struct Turn {
  Real sine, versine;
  [[gnu::always_inline]] explicit Turn(Real angle) {
    const Real square = angle * angle;
    sine = angle * (Real(1.0) - square * Real(1.0 / 6));
    versine = square * (Real(0.5) - square * Real(1.0 / 24));
  }
};

/// Turns a remembered tangent vector into the plane normal to n, and in it; its length is kept to fourth order.
template <class Real>
[[gnu::always_inline]] inline Triple<Real> turned(const Triple<Real>& kept, const Triple<Real>& n, Real inverse_size2,
                                                  const Turn<Real>& turn) {
  const Real s = dot(kept, n);
  const Triple<Real> in_plane = (kept - s * n) * (Real(1.0) + Real(0.5) * s * s * inverse_size2);
  return in_plane + (cross(n, in_plane) * turn.sine - in_plane * turn.versine);
}

/// Spring and dashpot side by side, behind a slider: steps 2 and 3 of the page's history.
template <class Real>
struct Slider {
  Triple<Real> trial, pull;
  Real size;        ///< of the pull
  Real resistance;  ///< against being moved on in this step

  [[gnu::always_inline]] Slider(const Triple<Real>& kept, const Triple<Real>& rate, Real stiffness, Real damping,
                                double dt)
      : trial(kept + rate * Real(dt)),
        pull(-(trial * stiffness + rate * damping)),
        size(sqrt(size2(pull))),
        resistance(max(stiffness + damping * Real(1 / dt), Real(least))) {}

  [[gnu::always_inline]] Real divisor() const { return size * resistance; }
  /// The pull within its limit, and what is kept then; `inverse` of the divisor.
  [[gnu::always_inline]] Triple<Real> limited(Real limit, Real inverse, Triple<Real>& kept) const {
    const Real scale = min(limit * resistance * inverse, Real(1.0));
    kept = trial + pull * ((Real(1.0) - scale) * size * inverse);
    return pull * scale;
  }
};

/// Contact radius of JKR: the larger root of delta = a^2/R - sqrt(2 pi w a/E). With u = sqrt(a):
/// u^4/R - b u = delta; Newton from above, where the curve is convex and rising, so it comes down to the root.
template <class Real>
[[gnu::always_inline]] inline Real jkr_contact_radius(Real overlap, Real radius, Real b, Real u_start) {
  const Real inverse = Real(1.0) / radius;
  Real u = sqrt(sqrt(max(overlap, Real(0.0)) * radius)) + u_start;
  for (int turn = 0; turn < 12; ++turn) {
    const Real u3 = u * u * u * inverse;
    u = u - (u3 * u - b * u - overlap) / max(Real(4.0) * u3 - b, Real(1e-280));
  }
  return u * u;
}

template <class Real>
struct Normal {
  Real a;          ///< contact radius [m]
  Real stiffness;  ///< k_n, secant [N/m]
  Real elastic;    ///< F_e, or JKR's whole F [N]
  Real damping;    ///< g_n [N s/m]
  Real shear;      ///< k_t [N/m]
  Real shear_damping;
};

template <class Real>
[[gnu::always_inline]] inline Normal<Real> normal(const LawFlags& laws, const LawConstants<Real>& c,
                                                  const Touch<Real>& at) {
  Normal<Real> out;
  out.a = sqrt(max(at.radius * at.overlap, Real(0.0)));
  if (laws.normal == NormalLaw::hooke) {
    const Real root = sqrt(at.mass);
    out.stiffness = c.normal;
    out.elastic = c.normal * at.overlap;
    out.damping = c.damping * root;
    out.shear = c.shear;
    out.shear_damping = c.shear_damping * root;
    return out;
  }
  if (laws.cohesion == CohesionLaw::jkr) {
    out.a = jkr_contact_radius(at.overlap, at.radius, c.adhesion_overlap, c.adhesion_start);
    out.elastic = c.normal * out.a * out.a * out.a / at.radius - c.adhesion_force * sqrt(out.a) * out.a;
  }
  const Real root = sqrt(at.mass * out.a);
  out.stiffness = c.normal * out.a;
  if (laws.cohesion != CohesionLaw::jkr) out.elastic = out.stiffness * at.overlap;
  out.damping = c.damping * root;
  out.shear = c.shear * out.a;
  out.shear_damping = c.shear_damping * root;
  return out;
}

/// Linear cohesion: pi k_c R* delta, pulls the two together [N].
template <class Real>
[[gnu::always_inline]] inline Real linear_pull(const LawConstants<Real>& c, Real radius, Real overlap) {
  return c.cohesion * radius * max(overlap, Real(0.0));
}

[[gnu::always_inline]] inline bool is_directional(RollingLaw rolling) {
  return rolling == RollingLaw::directional || rolling == RollingLaw::directional_with_twist;
}

/// Whether a law remembers a rotation.
[[gnu::always_inline]] inline bool keeps_roll(const LawFlags& laws) {
  return laws.twisting != TwistingLaw::none || (laws.rolling != RollingLaw::none && !is_directional(laws.rolling));
}

/// Whether a law asks for I*.
[[gnu::always_inline]] inline bool reads_inertia(RollingLaw rolling) {
  return is_directional(rolling) || rolling == RollingLaw::elastic_plastic;
}

/// Marshall's couple along n on i, and the angle of twist after the step: spring and dashpot behind a slider, as those
/// of the tangential force act over the circle of contact.
template <class Real>
[[gnu::always_inline]] inline Real twist(const LawConstants<Real>& c, const Touch<Real>& at, const Normal<Real>& normal,
                                         Real pressing, double dt, Real& angle) {
  const Real share = Real(0.5) * normal.a * normal.a, limit = Real(2.0 / 3) * normal.a * c.sliding * pressing;
  const Real k = share * normal.shear, g = share * normal.shear_damping, rate = dot(at.rotation, at.normal);
  angle = angle + rate * Real(dt);
  const Real trial = -(k * angle + g * rate), couple = max(min(trial, limit), -limit);
  angle = angle + (trial - couple) / max(k + g * Real(1 / dt), Real(least));
  return couple;
}

/// Tangential force by `slide`, limited by friction, and the couple of rolling resistance on i. Eight parameters: it is
/// the end of contact_response, in whose lines they are, cut out to be read; a struct would only list them once more.
template <class Real>
[[gnu::always_inline]] inline void resist(const LawFlags& laws, const LawConstants<Real>& c, const Touch<Real>& at,
                                          Real stiffness, const Slider<Real>& slide, Memory<Real>& memory, double dt,
                                          Response<Real>& out) {
  const Real friction = c.sliding * out.pressing, limit = c.rolling * at.radius * out.pressing;
  const Triple<Real> rate = at.rotation - dot(at.rotation, at.normal) * at.normal;
  if (is_directional(laws.rolling)) {
    const Triple<Real>& turning = laws.rolling == RollingLaw::directional ? rate : at.rotation;
    const Real speed = sqrt(size2(at.rotation));
    const Inverses<Real> inverse = inverses(slide.divisor(), speed);
    out.tangential = slide.limited(friction, inverse.first, memory.slide);
    out.couple = turning * (-min(limit * inverse.second, at.inertia * Real(1 / dt)));
  } else if (laws.rolling == RollingLaw::spring_slider || laws.rolling == RollingLaw::elastic_plastic) {
    const bool viscous = laws.rolling == RollingLaw::elastic_plastic;
    const Real reach = viscous ? c.rolling * at.radius : at.radius;
    const Real k = (viscous ? Real(2.25) * stiffness : c.roll_stiffness) * reach * reach;
    const Slider<Real> roll(memory.roll, rate, k, viscous ? Real(0.0) : c.roll_damping * reach * reach, dt);
    const Inverses<Real> inverse = inverses(slide.divisor(), roll.divisor());
    out.tangential = slide.limited(friction, inverse.first, memory.slide);
    out.couple = roll.limited(limit, inverse.second, memory.roll);
    if (!viscous) return;
    const auto below = dot(out.couple, out.couple) < limit * limit * Real(1 - 1e-12);
    const Real dashpot = Real(2.0) * c.roll_damping * sqrt(Real(3.5) * at.inertia * k);
    out.couple = out.couple - rate * select(below, dashpot, Real(0.0));
  } else {
    out.tangential = slide.limited(friction, Real(1.0) / slide.divisor(), memory.slide);
    out.couple = Triple<Real>{Real(0.0), Real(0.0), Real(0.0)};
    if (laws.rolling != RollingLaw::torsion_spring) return;
    memory.roll = memory.roll + rate * Real(dt);
    out.couple = memory.roll * (-c.roll_stiffness);
  }
}

}  // namespace law

/// Force and couple of a contact, and its memory after a step of dt; where `losses` is given, where its energy goes.
template <class Real>
[[gnu::always_inline]] inline Response<Real> contact_response(const LawFlags& laws, const LawConstants<Real>& c,
                                                              const Touch<Real>& at, Memory<Real>& memory, double dt,
                                                              Losses<Real>* losses) {
  const Triple<Real>& n = at.normal;
  const Real approach = dot(at.velocity, n);
  const Triple<Real> along = at.velocity - approach * n;
  const law::Normal<Real> normal = law::normal(laws, c, at);

  Real push = normal.elastic - normal.damping * approach;
  Response<Real> out;
  out.pressing = push;
  if (laws.cohesion == CohesionLaw::linear) push = push - law::linear_pull(c, at.radius, at.overlap);
  if (laws.cohesion == CohesionLaw::jkr) out.pressing = out.pressing + c.pull_off * at.radius;
  out.pressing = max(out.pressing, Real(0.0));

  const bool twists = laws.twisting != TwistingLaw::none;
  const law::Turn<Real> turn(at.turning * Real(dt));
  Real twist = twists ? dot(memory.roll, at.before) : Real(0.0);
  if (twists) memory.roll = memory.roll - twist * at.before;
  if (law::keeps_roll(laws)) {
    const law::Inverses<Real> inverse = law::inverses(law::size2(memory.slide), law::size2(memory.roll));
    memory.slide = law::turned(memory.slide, n, inverse.first, turn);
    memory.roll = law::turned(memory.roll, n, inverse.second, turn);
  } else {
    memory.slide = law::turned(memory.slide, n, Real(1.0) / law::size2(memory.slide), turn);
  }
  const Triple<Real> before = memory.slide;
  const law::Slider<Real> slide(memory.slide, along, normal.shear, normal.shear_damping, dt);
  law::resist(laws, c, at, normal.stiffness, slide, memory, dt, out);
  if (twists) {
    out.couple = out.couple + law::twist(c, at, normal, out.pressing, dt, twist) * n;
    memory.roll = memory.roll + twist * n;
  }
  out.force = push * n + out.tangential;
  if (losses) {
    const Triple<Real> stretched = (memory.slide - before) * Real(1 / dt);
    losses->dashpot = -normal.damping * approach;
    losses->damping = normal.damping * approach * approach;
    losses->shear_damping = normal.shear_damping * dot(stretched, stretched);
    losses->sliding = -dot(out.tangential, along - stretched);
    losses->into_slide = -dot(out.tangential, along);
    losses->into_roll = -dot(out.couple, at.rotation);
  }
  return out;
}

/// What a contact of two grains does to their torques, its arms from their centres to the middle of the overlap.
template <class Real>
struct PairTorques {
  Triple<Real> first, second;  ///< [N m]
};

template <class Real>
[[gnu::always_inline]] inline PairTorques<Real> pair_torques(const Triple<Real>& normal, const Response<Real>& does,
                                                             Real arm_first, Real arm_second) {
  const Triple<Real> lever = cross(normal, does.tangential);
  return {does.couple - arm_first * lever, -(does.couple + arm_second * lever)};
}

/// Energy stored in a contact's springs [J]: normal with cohesion, tangential, rolling with twisting. jkr counts from
/// the moment at which the contact is made.
template <class Real>
struct Stored {
  Real normal, tangential, rolling;
};

inline Stored<double> stored_energy(const LawFlags& laws, const LawConstants<double>& c, const Touch<double>& at,
                                    const Memory<double>& memory) {
  const law::Normal<double> normal = law::normal(laws, c, at);
  const double d2 = at.overlap * at.overlap;
  Stored<double> out{normal.stiffness * d2 * (laws.normal == NormalLaw::hooke ? 0.5 : 0.4),
                     0.5 * normal.shear * dot(memory.slide, memory.slide), 0};
  if (laws.cohesion == CohesionLaw::linear) out.normal -= 0.5 * c.cohesion * at.radius * d2;
  if (laws.cohesion == CohesionLaw::jkr) {
    const double b = c.adhesion_overlap, f = c.adhesion_force, k = c.normal / at.radius;
    const auto integral = [&](double a) {  // of F d(delta), over a
      const double a2 = a * a, a35 = a2 * a * sqrt(a);
      return 0.4 * k / at.radius * a2 * a2 * a - (0.5 * k * b + 2 * f / at.radius) * a35 / 3.5 + 0.25 * f * b * a2;
    };
    out.normal = integral(normal.a) - integral(law::jkr_contact_radius(0.0, at.radius, b, c.adhesion_start));
  }
  double stiffness = 0;
  if (laws.rolling == RollingLaw::elastic_plastic)
    stiffness = 2.25 * normal.stiffness * c.rolling * c.rolling * at.radius * at.radius;
  if (laws.rolling == RollingLaw::spring_slider) stiffness = c.roll_stiffness * at.radius * at.radius;
  if (laws.rolling == RollingLaw::torsion_spring) stiffness = c.roll_stiffness;
  const double twist = dot(memory.roll, at.normal);
  if (laws.twisting == TwistingLaw::marshall) out.rolling = 0.25 * normal.shear * normal.a * normal.a * twist * twist;
  out.rolling += 0.5 * stiffness * (dot(memory.roll, memory.roll) - twist * twist);
  return out;
}

/// Whether a contact of jkr that was made still holds at this overlap, negative from delta = 0 on:
/// delta > -(3/4)(b^4 R*/4)^(1/3), b = sqrt(2 pi w/E*).
template <class Real>
[[gnu::always_inline]] inline auto still_adheres(const LawConstants<Real>& c, Real overlap, Real radius) {
  const Real depth = Real(-4.0 / 3) * overlap, b2 = c.adhesion_overlap * c.adhesion_overlap;
  return depth * depth * depth < Real(0.25) * b2 * b2 * radius;
}

}  // namespace soilbin::dem
