// Compiled once for each instruction set (dem/CMakeLists.txt), each in a namespace of its own.
#include "dem/engine/kernels/kernels.hpp"
#include "dem/engine/kernels/pack_constants.hpp"
#include "dem/engine/laws/contact_law.hpp"

namespace soilbin::dem::HWY_NAMESPACE {
namespace {

using Triad = Triple<Pack>;

HWY_INLINE Triad load_triad(const double (*columns)[8], int first) {
  return {load(columns[0] + first), load(columns[1] + first), load(columns[2] + first)};
}

HWY_INLINE void store_triad(const Triad& what, double (*columns)[8], int first) {
  store(what.x, columns[0] + first);
  store(what.y, columns[1] + first);
  store(what.z, columns[2] + first);
}

}  // namespace

void run_touches(const TouchSweep& sweep, TouchBatch& batch, int count) {
  for (int first = 0; first < count; first += lanes) {
    const Touch<Pack> touch{.normal = load_triad(batch.normal, first),
                            .overlap = load(batch.overlap + first),
                            .radius = load(batch.radius + first),
                            .mass = Pack(1.0) / load(batch.inverse_mass + first),
                            .velocity = load_triad(batch.velocity, first),
                            .rotation = load_triad(batch.rotation, first),
                            .inertia = Pack(1.0) / load(batch.inverse_inertia + first),
                            .turning = load(batch.turning + first),
                            .before = load_triad(batch.before, first)};
    Memory<Pack> memory{load_triad(batch.memory, first), load_triad(batch.memory + 3, first)};
    Losses<Pack> losses;
    const Response<Pack> does = contact_response(sweep.laws, constants_of(sweep.constants, batch.kind + first), touch,
                                                 memory, sweep.dt, sweep.ledger ? &losses : nullptr);
    store_triad(memory.slide, batch.memory, first);
    store_triad(memory.roll, batch.memory + 3, first);
    store_triad(does.force, batch.force, first);
    store_triad(does.couple, batch.couple, first);
    if (!sweep.ledger) continue;
    store_triad(losses.dashpot * touch.normal, batch.dashpot, first);
    store_triad(does.tangential, batch.slide, first);
    add_up(losses, mask_of((1u << (count - first)) - 1), batch.lost);
  }
}

}  // namespace soilbin::dem::HWY_NAMESPACE
