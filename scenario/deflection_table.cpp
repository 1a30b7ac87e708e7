#include "scenario/deflection_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>

#include "scenario/description.hpp"

namespace soilbin {
namespace {

/// The two rows of one pressure about a load: the one below or at it, and the one above or at it; both the same at the
/// table's edge.
struct RowsAbout {
  const TireDeflection *below = nullptr, *above = nullptr;
};

RowsAbout rows_about(const DeflectionTable& table, double load, double pressure) {
  RowsAbout about;
  for (const TireDeflection& row : table.rows) {
    if (row.pressure != pressure) continue;
    if (row.load <= load && (!about.below || row.load > about.below->load)) about.below = &row;
    if (row.load >= load && (!about.above || row.load < about.above->load)) about.above = &row;
  }
  if (!about.below) about.below = about.above;
  if (!about.above) about.above = about.below;
  return about;
}

double between(double x, double x_low, double low, double x_high, double high) {
  return x_high > x_low ? low + (high - low) * (x - x_low) / (x_high - x_low) : low;
}

/// W/f at one of the table's pressures.
double stiffness_at(const DeflectionTable& table, double load, double pressure) {
  const auto [below, above] = rows_about(table, load, pressure);
  const double clamped = std::clamp(load, below->load, above->load);
  return between(clamped, below->load, below->load / below->deflection, above->load, above->load / above->deflection);
}

/// The table's pressures about one; at an edge both are the edge.
struct Pressures {
  double below = -std::numeric_limits<double>::infinity(), above = std::numeric_limits<double>::infinity();
};

Pressures pressures_about(const DeflectionTable& table, double pressure) {
  Pressures about;
  for (const TireDeflection& row : table.rows) {
    if (row.pressure <= pressure) about.below = std::max(about.below, row.pressure);
    if (row.pressure >= pressure) about.above = std::min(about.above, row.pressure);
  }
  if (about.below < 0.0) about.below = about.above;
  if (about.above == std::numeric_limits<double>::infinity()) about.above = about.below;
  return about;
}

std::string row_text(const TireDeflection& row) {
  return fmt::format("{:.6g} mm under {:.6g} kN at {:.6g} kPa", 1000 * row.deflection, row.load / 1000,
                     row.pressure / 1000);
}

}  // namespace

double deflection_of(const DeflectionTable& table, double load, double pressure) {
  const Pressures about = pressures_about(table, pressure);
  const double clamped = std::clamp(pressure, about.below, about.above);
  return load / between(clamped, about.below, stiffness_at(table, load, about.below), about.above,
                        stiffness_at(table, load, about.above));
}

bool covers(const DeflectionTable& table, double load, double pressure) {
  const Pressures about = pressures_about(table, pressure);
  if (pressure < about.below || pressure > about.above) return false;
  return std::ranges::all_of(std::array{about.below, about.above}, [&](double at) {
    const auto [below, above] = rows_about(table, load, at);
    return below->load <= load && load <= above->load;
  });
}

std::string in_words(const DeflectionTable& table) {
  const auto [lightest, heaviest] = std::ranges::minmax(table.rows, {}, &TireDeflection::load);
  const auto [softest, hardest] = std::ranges::minmax(table.rows, {}, &TireDeflection::pressure);
  return fmt::format("{} rows, {:.4g} .. {:.4g} kN, {:.4g} .. {:.4g} kPa", table.rows.size(), lightest.load / 1000,
                     heaviest.load / 1000, softest.pressure / 1000, hardest.pressure / 1000);
}

std::string contradiction(const DeflectionTable& table) {
  if (table.rows.empty()) return "a load-deflection table needs a row";
  if (table.rows.size() > most_deflection_rows)
    return fmt::format("a load-deflection table has {} rows, more than {}", table.rows.size(), most_deflection_rows);
  for (const TireDeflection& one : table.rows)
    for (const TireDeflection& other : table.rows) {
      const bool more_load = other.load > one.load, same = &one == &other;
      if (same || other.pressure < one.pressure) continue;
      if (other.pressure == one.pressure && other.load == one.load)
        return fmt::format("two rows of one load and pressure: {} and {}", row_text(one), row_text(other));
      if (other.pressure == one.pressure && more_load && !(other.deflection > one.deflection))
        return fmt::format("the tire deflects by {}, yet by {}: a larger load deflects it more", row_text(one),
                           row_text(other));
      if (other.pressure > one.pressure && other.load == one.load && other.deflection > one.deflection)
        return fmt::format("the tire deflects by {}, yet by {}: a higher pressure deflects it less", row_text(one),
                           row_text(other));
    }
  return "";
}

std::string contradiction(const Tire& tire) {
  if (!tire.deflection) return "";
  for (const TireDeflection& row : tire.deflection->rows)
    if (!(row.deflection < tire.radius))
      return fmt::format("the tire deflects by {}: more than its radius of {:.6g} mm", row_text(row),
                         1000 * tire.radius);
  return "";
}

}  // namespace soilbin
