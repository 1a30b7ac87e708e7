#include "scenario/file_bytes.hpp"

#include <fmt/core.h>

#include <fstream>
#include <system_error>
#include <vector>

#include "scenario/errors.hpp"

namespace soilbin {
namespace {

struct AnnouncedOutput {
  std::filesystem::path path;  ///< as it is once folders that are missing are there
  std::string flag;
};

std::filesystem::path in_full(const std::filesystem::path& path) {
  std::error_code none;
  const std::filesystem::path absolute = std::filesystem::absolute(path, none);
  const std::filesystem::path full = std::filesystem::weakly_canonical(absolute, none);
  return full.empty() ? absolute.lexically_normal() : full;
}

bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code none;
  return in_full(a) == b || std::filesystem::equivalent(a, b, none);
}

/// The outputs that this process announced, in the order in which its flags were read.
std::vector<AnnouncedOutput>& announced_outputs() {
  static std::vector<AnnouncedOutput> all;
  return all;
}

void refuse_an_output(const std::filesystem::path& path, const SourcePosition& where) {
  for (const auto& [output, flag] : announced_outputs())
    if (are_one_file(path, output))
      throw InputError(where, fmt::format("{} would write over this file, which the command reads", flag), "",
                       fmt::format("give {} another name", flag));
}

}  // namespace

void announce_output(const std::filesystem::path& path, const std::string& flag) {
  std::error_code none;
  for (const auto& [output, other] : announced_outputs())
    if (other != flag && are_one_file(path, output) && !std::filesystem::is_character_file(path, none) &&
        !std::filesystem::is_fifo(path, none))
      throw InputError({path.string()}, fmt::format("is named by both {} and {}", other, flag), "",
                       fmt::format("give {} another name", flag));
  announced_outputs().push_back({in_full(path), flag});
}

bool is_there(const std::filesystem::path& path) {
  std::error_code unseen;
  return std::filesystem::exists(path, unseen);
}

std::string read_bytes(const std::filesystem::path& path, std::size_t largest) {
  namespace fs = std::filesystem;
  const SourcePosition where{path.string().substr(0, path.string().find('\n'))};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw InputError(where, "no such file");
  if (fs::is_directory(status)) {
    std::string in_it;
    for (const char* name : {"case.yaml", "campaign.yaml"})
      if (in_it.empty() && fs::exists(path / name, error)) in_it = (path / name).string();
    throw InputError(where, "is a folder; a file is expected", "", in_it.empty() ? "" : "in it there is " + in_it);
  }
  if (!fs::is_regular_file(status)) throw InputError(where, "is not a regular file that can be read");
  refuse_an_output(path, where);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(where, "can't be opened for reading");
  std::string bytes;
  constexpr std::size_t at_once = 1U << 20U;
  while (in && bytes.size() <= largest) {  // the size that the system tells isn't relied upon
    const std::size_t before = bytes.size();
    bytes.resize(before + at_once);
    in.read(bytes.data() + before, static_cast<std::streamsize>(at_once));
    bytes.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw InputError(where, "reading failed");
  if (bytes.size() > largest) throw InputError(where, fmt::format("is larger than the {} bytes allowed", largest));
  return bytes;
}

}  // namespace soilbin
