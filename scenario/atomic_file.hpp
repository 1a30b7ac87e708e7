#pragma once

#include <filesystem>
#include <string_view>

namespace soilbin {

/// Writes a whole file or nothing: into a temporary file of the same folder, flushed to the disk, then renamed over
/// the target. On failure the target is as it was, the temporary file is gone, and std::runtime_error names the file,
/// the step and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Tries the place before the work: makes the temporary file that write_file_atomically would, and removes it. Throws
/// what that would.
void try_to_write(const std::filesystem::path& path);

}  // namespace soilbin
