// A file's bytes, within bounds: whatever a person names as an input is read through here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace soilbin {

/// The bytes of a regular file of at most `largest` of them. Throws InputError for a missing or unreadable file, a
/// folder, a device, and a file that is too large.
std::string read_bytes(const std::filesystem::path& path, std::size_t largest);

}  // namespace soilbin
