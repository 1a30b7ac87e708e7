// A file's bytes, within bounds: whatever a person names as an input is read through here, and refused where the same
// file is to be written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace soilbin {

/// Says that this process will write a file, and which flag names it. To be called before anything is read.
void announce_output(const std::filesystem::path& path, const std::string& flag);

/// Whether there is something of this name; no, too, where nobody could see it: in a folder that can't be searched.
bool is_there(const std::filesystem::path& path);

/// The bytes of a regular file of at most `largest` of them. Throws InputError for a missing or unreadable file, a
/// folder, a device, a file that is too large, and one that was announced as an output: what was made of a file would
/// take its place.
std::string read_bytes(const std::filesystem::path& path, std::size_t largest);

}  // namespace soilbin
