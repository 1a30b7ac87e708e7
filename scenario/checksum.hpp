// A checksum that shows whether a file is damaged; it is no protection against somebody who wants to change it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace soilbin {

/// FNV-1a, 64 bits (Fowler, Noll and Vo; RFC 9923). Each single changed byte changes it.
std::uint64_t fnv1a(std::string_view bytes);

/// Its sixteen hexadecimal digits.
std::string fnv1a_digits(std::string_view bytes);

}  // namespace soilbin
