// docs/dem-laws.md as code: what a contact does, for one contact (Real = double) or for a pack of them at once. The
// formulas stand here and nowhere else; grains, planes and meshes differ only in the Touch that they fill in.
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
  Real inertia;           ///< I* [kg m^2]; J* is 3.5 times that. Read by directional and elastic_plastic rolling
};

/// What a contact remembers.
template <class Real>
struct Memory {
  Triple<Real> slide;  ///< xi [m]
  Triple<Real> roll;   ///< theta [rad]
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

/// Turns a remembered tangent vector into the plane normal to n; its length is kept to fourth order.
template <class Real>
[[gnu::always_inline]] inline Triple<Real> turned(const Triple<Real>& kept, const Triple<Real>& n) {
  const Real s = dot(kept, n);
  const Real share = Real(0.5) * s * s / max(dot(kept, kept), Real(1e-280));
  return (kept - s * n) * (Real(1.0) + share);
}

/// Spring and dashpot side by side, behind a slider: steps 2 and 3 of the page's history.
template <class Real>
[[gnu::always_inline]] inline Triple<Real> slider(Triple<Real>& kept, const Triple<Real>& rate, Real stiffness,
                                                  Real damping, Real limit, double dt) {
  const Triple<Real> trial = kept + rate * Real(dt);
  const Triple<Real> pull = -(trial * stiffness + rate * damping);
  const Real size = sqrt(max(dot(pull, pull), Real(1e-280)));
  const Real resistance = max(stiffness + damping * Real(1 / dt), Real(1e-140));
  const Real inverse = Real(1.0) / (size * resistance);  // one division for both
  const Real scale = min(limit * resistance * inverse, Real(1.0));
  kept = trial + pull * ((Real(1.0) - scale) * size * inverse);
  return pull * scale;
}

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

/// The couple of rolling resistance on i.
template <class Real>
[[gnu::always_inline]] inline Triple<Real> rolling(const LawFlags& laws, const LawConstants<Real>& c,
                                                   const Touch<Real>& at, Real stiffness, Real pressing,
                                                   Triple<Real>& kept, double dt) {
  const Real limit = c.rolling * at.radius * pressing;
  if (laws.rolling == RollingLaw::directional) {
    const Real rate = sqrt(max(dot(at.rotation, at.rotation), Real(1e-280)));
    return at.rotation * (-min(limit / rate, at.inertia * Real(1 / dt)));
  }
  const Triple<Real> rate = at.rotation - dot(at.rotation, at.normal) * at.normal;
  kept = turned(kept, at.normal);
  if (laws.rolling == RollingLaw::spring_slider) {
    const Real r2 = at.radius * at.radius;
    return slider(kept, rate, c.roll_stiffness * r2, c.roll_damping * r2, limit, dt);
  }
  if (laws.rolling == RollingLaw::torsion_spring) {
    kept = kept + rate * Real(dt);
    return kept * (-c.roll_stiffness);
  }
  const Real reach = c.rolling * at.radius;
  const Real k = Real(2.25) * stiffness * reach * reach;
  const Triple<Real> spring = slider(kept, rate, k, Real(0.0), limit, dt);
  const auto below = dot(spring, spring) < limit * limit * Real(1 - 1e-12);
  const Real viscous = Real(2.0) * c.roll_damping * sqrt(Real(3.5) * at.inertia * k);
  return spring - rate * select(below, viscous, Real(0.0));
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
  if (laws.cohesion == CohesionLaw::linear) push = push - c.cohesion * at.radius * max(at.overlap, Real(0.0));
  if (laws.cohesion == CohesionLaw::jkr) out.pressing = out.pressing + c.pull_off * at.radius;
  out.pressing = max(out.pressing, Real(0.0));

  memory.slide = law::turned(memory.slide, n);
  const Triple<Real> before = memory.slide;
  out.tangential = law::slider(memory.slide, along, normal.shear, normal.shear_damping, c.sliding * out.pressing, dt);
  out.force = push * n + out.tangential;
  out.couple = Triple<Real>{Real(0.0), Real(0.0), Real(0.0)};
  if (laws.rolling != RollingLaw::none)
    out.couple = law::rolling(laws, c, at, normal.stiffness, out.pressing, memory.roll, dt);
  if (losses) {
    const Triple<Real> stretched = (memory.slide - before) * Real(1 / dt);
    losses->dashpot = -normal.damping * approach;
    losses->damping = normal.damping * approach * approach;
    losses->shear_damping = normal.shear_damping * dot(along, stretched);
    losses->sliding = -dot(out.tangential, along - stretched);
    losses->into_slide = -dot(out.tangential, along);
    losses->into_roll = -dot(out.couple, at.rotation);
  }
  return out;
}

/// Energy stored in a contact's springs [J]: normal with cohesion, tangential, rolling. jkr counts from the moment at
/// which the contact is made.
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
  out.rolling = 0.5 * stiffness * dot(memory.roll, memory.roll);
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
