// What H5MD 1.1 (https://nongnu.org/h5md) asks of a file, beside its particles.
#pragma once

#include "dem/archive/hdf5.hpp"
#include "dem/engine/domain.hpp"

namespace soilbin::dem {

/// The group h5md: version, author, creator, the module of units.
void write_h5md(const hdf5::Group& root);

/// The group box of a group of particles.
void write_box(const hdf5::Group& particles, const Domain& domain);

}  // namespace soilbin::dem
