#include "scenario/checksum.hpp"

#include <fmt/core.h>

namespace soilbin {

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return hash;
}

std::string fnv1a_digits(std::string_view bytes) { return fmt::format("{:016x}", fnv1a(bytes)); }

}  // namespace soilbin
