// A force table as a file of HDF5: here because this folder alone links the engine's archive, which wraps the library.
#pragma once

#include <string>

#include "compare/export/force_table.hpp"

namespace soilbin::compare {

/// What a file of HDF5 tells beside the table.
struct TableFileAbout {
  std::string name;           ///< of the file, for messages
  std::string version;        ///< of soilbin
  std::string resolved_case;  ///< as YAML
};

/// The bytes of the file: /axes/NAME, rising; /values/CHANNEL and /std_errors/CHANNEL, an axis a dimension in the order
/// of the attribute `axes`; /interpolation/CHANNEL: largest and root mean square error. SI; each dataset has its unit.
/// Equal tables give equal bytes. Throws std::runtime_error.
std::string hdf5_of(const ForceTable& table, const TableFileAbout& about);

}  // namespace soilbin::compare
