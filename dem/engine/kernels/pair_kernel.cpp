// Compiled once for each instruction set (dem/CMakeLists.txt), each in a namespace of its own.
#include "dem/engine/kernels/kernels.hpp"
#include "dem/engine/kernels/pack_constants.hpp"
#include "dem/engine/laws/contact_law.hpp"

namespace soilbin::dem::HWY_NAMESPACE {
namespace {

using Triad = Triple<Pack>;

/// Both grains of each contact of a pack.
struct Grain {
  Triad position, velocity, rate;
  Pack radius, inverse_mass, inverse_inertia;
};

HWY_INLINE void read_place(const Motion* motion, const std::uint32_t* at, Grain& out) {
  const FourPacks p = columns([&](int k) { return &motion[at[k]].position.x; });
  out.position = {p.a, p.b, p.c};
  out.radius = p.d;
}

HWY_INLINE void read_motion(const Motion* motion, const Spin* spin, const std::uint32_t* at, Grain& out) {
  const FourPacks v = columns([&](int k) { return &motion[at[k]].velocity.x; });
  out.velocity = {v.a, v.b, v.c};
  out.inverse_mass = v.d;
  const FourPacks w = columns([&](int k) { return &spin[at[k]].rate.x; });
  out.rate = {w.a, w.b, w.c};
  out.inverse_inertia = w.d;
}

HWY_INLINE Triad where(PackMask yes, const Triad& a) { return {where(yes, a.x), where(yes, a.y), where(yes, a.z)}; }

/// Adds what the contacts did to the loads of their grains, contact by contact.
HWY_INLINE void scatter(const PairSweep& sweep, std::size_t pair, const Triad& force, const Triad& on_first,
                        const Triad& on_second) {
  const auto rows = [&](const std::uint32_t* grain) {
    return [load = sweep.load, grain = grain + pair](int k) { return &load[grain[k]].force.x; };
  };
  add_rows({force.x, force.y, force.z, on_first.x, on_first.y, on_first.z}, rows(sweep.first),
           {-force.x, -force.y, -force.z, on_second.x, on_second.y, on_second.z}, rows(sweep.second));
}

/// Places of a pack's contacts in the list.
struct Place {
  std::size_t pair, batch;
  unsigned within, mask;  ///< first lane in the batch, and the lanes' bits there
  explicit Place(std::size_t first)
      : pair(first), batch(first / 8), within(first % 8), mask((lanes == 8 ? 0xffu : (1u << lanes) - 1) << within) {}
};

/// A pack of contacts on its way through the law.
struct Meeting {
  Place at;
  Grain i, j;
  PackMask touching;
  Pack distance, arm_i, arm_j;
  Touch<Pack> touch;
  HWY_INLINE explicit Meeting(const Place& place) : at(place) {}
};

/// The touch but for its normal and overlap, which it has already. What no law asks for is left out.
HWY_INLINE void meet(Meeting& m, const LawFlags& laws, double dt) {
  const bool with_inertia = law::reads_inertia(laws.rolling);
  const Grain &i = m.i, &j = m.j;
  const Pack distance = m.distance;
  Touch<Pack>& out = m.touch;
  const Triad between = out.normal;
  const Pack radii = i.radius + j.radius, masses = i.inverse_mass + j.inverse_mass;
  const Pack lengths = distance * radii;
  const Pack inertias = with_inertia ? i.inverse_inertia + j.inverse_inertia : Pack(1.0);
  const Pack inverse = Pack(1.0) / (lengths * masses * inertias);  // one division for four quotients
  const Pack of_lengths = inverse * masses * inertias;
  out.normal = out.normal * (of_lengths * radii);
  out.radius = i.radius * j.radius * (of_lengths * distance);
  out.mass = inverse * lengths * inertias;
  out.inertia = inverse * lengths * masses;
  const Pack half = Pack(0.5) * out.overlap;
  m.arm_i = i.radius - half;
  m.arm_j = j.radius - half;
  out.velocity = i.velocity - j.velocity - cross(m.arm_i * i.rate + m.arm_j * j.rate, out.normal);
  out.rotation = i.rate - j.rate;
  out.turning = Pack(0.5) * dot(i.rate + j.rate, out.normal);
  if (laws.twisting == TwistingLaw::none) return;
  const Triad old = between - Pack(dt) * (i.velocity - j.velocity);
  out.before = old * (Pack(1.0) / sqrt(law::size2(old)));
}

/// Where losses are counted: adds them up, and adds the parts of the loads that make them.
HWY_INLINE void count(const PairSweep& sweep, bool rolls, const Meeting& m, const Response<Pack>& does,
                      const Losses<Pack>& losses, PairFindings& found) {
  const PackMask touching = m.touching;
  const std::size_t pair = m.at.pair;
  add_up(losses, touching, found.lost);
  const Triad dashpot = where(touching, losses.dashpot * m.touch.normal), slide = where(touching, does.tangential);
  const SixPacks forces{dashpot.x, dashpot.y, dashpot.z, slide.x, slide.y, slide.z};
  const std::uint32_t *first = sweep.first + pair, *second = sweep.second + pair;
  add_rows(
      forces, [&](int k) { return &sweep.ledger_loads[first[k]].dashpot.x; },
      {-forces.a, -forces.b, -forces.c, -forces.d, -forces.e, -forces.f},
      [&](int k) { return &sweep.ledger_loads[second[k]].dashpot.x; });
  if (!rolls) return;
  const Triad couple = where(touching, does.couple);
  const Pack zero(0.0);
  add_rows(
      {couple.x, couple.y, couple.z, zero, zero, zero}, [&](int k) { return &sweep.ledger_loads[first[k]].couple.x; },
      {-couple.x, -couple.y, -couple.z, zero, zero, zero},
      [&](int k) { return &sweep.ledger_loads[second[k]].couple.x; });
}

HWY_INLINE Memory<Pack> recall(const double* memory) {
  return {{load(memory), load(memory + 8), load(memory + 16)},
          {load(memory + 24), load(memory + 32), load(memory + 40)}};
}

HWY_INLINE void keep(const Triad& what, PackMask where_touching, double* to) {
  store(where(where_touching, what.x), to);
  store(where(where_touching, what.y), to + 8);
  store(where(where_touching, what.z), to + 16);
}

/// What a sweep is asked for: where these are known to the compiler, the rest of the laws is no part of the loop.
struct Asked {
  LawFlags laws;
  bool losses;
};

/// Laws and scattering, for contacts that touch.
HWY_INLINE void respond(const PairSweep& sweep, const Asked& asked, const LawConstants<Pack>& constants, Meeting& m,
                        PairFindings& found) {
  const Place& at = m.at;
  read_motion(sweep.motion, sweep.spin, sweep.first + at.pair, m.i);
  read_motion(sweep.motion, sweep.spin, sweep.second + at.pair, m.j);
  const RollingLaw rolling = asked.laws.rolling;
  meet(m, asked.laws, sweep.dt);

  double* memory = sweep.memory + at.batch * 48 + at.within;
  Memory<Pack> kept = recall(memory);
  Losses<Pack> losses;
  const Response<Pack> does =
      contact_response(asked.laws, constants, m.touch, kept, sweep.dt, asked.losses ? &losses : nullptr);
  const bool couples = rolling != RollingLaw::none || asked.laws.twisting != TwistingLaw::none;
  if (asked.losses) count(sweep, couples, m, does, losses, found);
  keep(kept.slide, m.touching, memory);
  if (law::keeps_roll(asked.laws)) keep(kept.roll, m.touching, memory + 24);

  const PairTorques<Pack> torques = pair_torques(m.touch.normal, does, m.arm_i, m.arm_j);
  scatter(sweep, at.pair, where(m.touching, does.force), where(m.touching, torques.first),
          where(m.touching, torques.second));
}

/// One pack of contacts. `one` holds the constants where all contacts are of one kind.
HWY_INLINE void work_on(const PairSweep& sweep, const Asked& asked, const LawConstants<Pack>* one, const Place& at,
                        PairFindings& found) {
  Meeting m(at);
  read_place(sweep.motion, sweep.first + at.pair, m.i);
  read_place(sweep.motion, sweep.second + at.pair, m.j);
  Triad& normal = m.touch.normal;
  normal = m.i.position - m.j.position;
  normal.x = nearest_image(normal.x, sweep.period[0]);
  normal.y = nearest_image(normal.y, sweep.period[1]);
  normal.z = nearest_image(normal.z, sweep.period[2]);
  const Pack distance2 = dot(normal, normal), sum = m.i.radius + m.j.radius;

  m.touching = distance2 < sum * sum;
  std::uint8_t& made = sweep.touching[at.batch];
  const unsigned before = made & at.mask;
  if (before == 0 && none(m.touching)) return;
  const LawConstants<Pack> constants = one ? *one : constants_of(sweep.constants, sweep.kind + at.pair);
  m.distance = sqrt(distance2);
  m.touch.overlap = sum - m.distance;
  if (asked.laws.cohesion == CohesionLaw::jkr)
    m.touching = m.touching | (mask_of(before >> at.within) &
                               still_adheres(constants, m.touch.overlap, m.i.radius * m.j.radius / sum));
  made = static_cast<std::uint8_t>((made & ~at.mask) | bits(m.touching) << at.within);
  if (!none(Pack(sweep.deepest) * min(m.i.radius, m.j.radius) < where(m.touching, m.touch.overlap)))
    found.too_deep = true;
  respond(sweep, asked, constants, m, found);
}

/// So many contacts ahead what contacts remember and the rows of second grains that touch are called for: those of big
/// beds lie in memory, and the hardware foresees the rows not at all and memories too late. Rows of first grains follow
/// each other.
constexpr std::size_t rows_ahead = 32;

HWY_INLINE void fetch_rows(const PairSweep& sweep, std::uint32_t grain) {
  __builtin_prefetch(sweep.motion + grain);
  __builtin_prefetch(sweep.load + grain, 1);
  __builtin_prefetch(sweep.spin + grain);
  if (!sweep.ledger_loads) return;
  __builtin_prefetch(&sweep.ledger_loads[grain].dashpot, 1);
  __builtin_prefetch(&sweep.ledger_loads[grain].couple, 1);
}

/// All of a batch, whichever of its packs comes.
HWY_INLINE void fetch_memory(const double* of_batch) {
  for (int column = 0; column < 6; ++column) __builtin_prefetch(of_batch + 8 * column, 1);
}

HWY_INLINE void run_asked(const PairSweep& given, const Asked& asked, std::size_t begin, std::size_t end,
                          PairFindings& found) {
  const PairSweep sweep = given;  // a copy: no store can change it, so nothing of it is read anew after each
  const LawConstants<Pack> one = broadcast(sweep.constants);
  const std::size_t last = 8 * end;
  for (std::size_t pair = 8 * begin; pair < last; pair += lanes) {
    if (const std::size_t soon = pair + rows_ahead; soon + lanes <= last && sweep.touching[soon / 8]) {
      for (int k = 0; k < lanes; ++k) fetch_rows(sweep, sweep.second[soon + k]);
      if (soon % 8 == 0) fetch_memory(sweep.memory + 6 * soon);
    }
    work_on(sweep, asked, sweep.kinds == 1 ? &one : nullptr, Place(pair), found);
  }
}

/// Hertz without cohesion or twisting, losses not counted: what long runs are made of.
template <RollingLaw rolling>
void run_plain(const PairSweep& sweep, std::size_t begin, std::size_t end, PairFindings& found) {
  run_asked(sweep, {{NormalLaw::hertz, rolling, CohesionLaw::none, TwistingLaw::none}, false}, begin, end, found);
}

}  // namespace

void run_pairs(const PairSweep& sweep, std::size_t begin, std::size_t end, PairFindings& found) {
  const LawFlags& laws = sweep.laws;
  if (laws.normal != NormalLaw::hertz || laws.cohesion != CohesionLaw::none || laws.twisting != TwistingLaw::none ||
      sweep.ledger_loads)
    return run_asked(sweep, {sweep.laws, sweep.ledger_loads != nullptr}, begin, end, found);
  switch (sweep.laws.rolling) {
    case RollingLaw::none:
      return run_plain<RollingLaw::none>(sweep, begin, end, found);
    case RollingLaw::directional:
      return run_plain<RollingLaw::directional>(sweep, begin, end, found);
    case RollingLaw::directional_with_twist:
      return run_plain<RollingLaw::directional_with_twist>(sweep, begin, end, found);
    case RollingLaw::elastic_plastic:
      return run_plain<RollingLaw::elastic_plastic>(sweep, begin, end, found);
    case RollingLaw::spring_slider:
      return run_plain<RollingLaw::spring_slider>(sweep, begin, end, found);
    case RollingLaw::torsion_spring:
      return run_plain<RollingLaw::torsion_spring>(sweep, begin, end, found);
  }
}

}  // namespace soilbin::dem::HWY_NAMESPACE
