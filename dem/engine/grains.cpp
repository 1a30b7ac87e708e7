#include "dem/engine/grains.hpp"

#include <algorithm>

namespace soilbin::dem {
namespace {

/// Two points far out, in any box: without a radius nothing touches them.
constexpr double far_away = 1e100;

template <class Row>
void take(std::vector<Row>& rows, std::span<const std::uint32_t> order) {
  std::vector<Row> taken;
  taken.reserve(order.size() + 2);
  for (const std::uint32_t k : order) taken.push_back(rows[k]);
  rows = std::move(taken);
}

}  // namespace

double Grains::largest_radius() const {
  double largest = 0;
  for (std::size_t k = 0; k < count(); ++k) largest = std::max(largest, motion[k].radius);
  return largest;
}

void Grains::close() {
  motion.resize(count());
  motion.push_back({{far_away, 0, 0}, 0, {}, 1});
  motion.push_back({{-far_away, 0, 0}, 0, {}, 1});
  spin.resize(count() + 2);
  load.resize(count() + 2);
}

void Grains::add(GrainId new_id, const Vec3& position, const Vec3& velocity, const Vec3& rate, double radius,
                 double mass, std::uint8_t of_material) {
  motion.resize(count());
  spin.resize(count());
  load.resize(count());
  motion.push_back({position, radius, velocity, 1 / mass});
  spin.push_back({rate, 1 / (0.4 * mass * radius * radius)});
  load.push_back({});
  id.push_back(new_id);
  material.push_back(of_material);
  close();
}

void Grains::reorder(std::span<const std::uint32_t> order) {
  take(motion, order);
  take(spin, order);
  take(load, order);
  take(id, order);
  take(material, order);
  close();
}

void Grains::remove(std::span<const std::uint8_t> gone) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t k = 0; k < count(); ++k)
    if (!gone[k]) kept.push_back(k);
  reorder(kept);
}

}  // namespace soilbin::dem
