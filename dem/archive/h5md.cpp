#include "dem/archive/h5md.hpp"

#include <array>

namespace soilbin::dem {
namespace {

void set_version(const hdf5::Group& group, std::int32_t major, std::int32_t minor) {
  const std::array<std::int32_t, 2> version{major, minor};
  group.set_numbers("version", hdf5::Number::i32, {2}, version.data());
}

}  // namespace

void write_h5md(const hdf5::Group& root) {
  const hdf5::Group h5md = root.create("h5md");
  set_version(h5md, 1, 1);
  h5md.create("author").set_text("name", "not told");  // H5MD wants one
  const hdf5::Group creator = h5md.create("creator");
  creator.set_text("name", "soilbin");
  creator.set_text("version", SOILBIN_VERSION);
  const hdf5::Group units = h5md.create("modules").create("units");
  set_version(units, 1, 0);
  units.set_free_text("system", "SI");
}

void write_box(const hdf5::Group& particles, const Domain& domain) {
  const hdf5::Group box = particles.create("box");
  const std::int32_t dimension = 3;
  box.set_numbers("dimension", hdf5::Number::i32, {}, &dimension);
  std::vector<std::string> boundary;
  for (const bool periodic : domain.periodic) boundary.emplace_back(periodic ? "periodic" : "none");
  box.set_texts("boundary", boundary);
  const Vec3 edges = domain.upper - domain.lower;
  box.write("edges", hdf5::Number::f64, {3}, &edges.x);
  box.set_free_text("unit", "m", "edges");
}

}  // namespace soilbin::dem
