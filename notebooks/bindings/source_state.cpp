// What the extension was built from. A file of its own: it is compiled anew with each commit.
#include <source_state.hpp>

#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {

std::string source_state() { return SOILBIN_SOURCE_STATE; }

}  // namespace soilbin::python
