// A tire by its size alone, as it stands on the side wall.
//
//   tire_of_size("600/65R28")->radius  // 0.7456 [m]: half of 28 in of rim, and 65 % of 600 mm
//   tire_of_size("18.4-38")->source    // "by its size alone: 467.4 mm wide, sides of 85 % of that (assumed: ...) ..."
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scenario/tire.hpp"

namespace soilbin {

/// How the source of such a tire begins: it says what the size tells and what is assumed.
inline constexpr std::string_view by_size_alone = "by its size alone: ";

/// The tire of a size: section width and height, and outer radius, smooth and rigid, since a size tells neither tread
/// nor pressure.
/// - 600/65R28, 385/65R22.5, 710/45-26.5: width [mm], height of the sides [%] of it, rim [in]
/// - 18.4-38, 16.00R20, 23.5R25: width and rim [in]. Sides of 85 % are assumed, of 105 % for a width of two decimals
///   (the 14.00R20 of the library has that, earthmovers' sizes 107 to 114 %); 12.5/80-18 tells them
/// - 66x43.00-25: outer diameter, width and rim [in]
/// IF, VF, CFO, LT and P before it tell of load and pressure, and are kept in the name alone. A service description
/// after it ("154D") is left out. Nothing where the text is no size. Throws InputError with a hint for a size that is
/// incomplete or that no tire has.
std::optional<Tire> tire_of_size(const std::string& text);

/// Whether two sizes are of one width and of rims that differ by an inch at most, as 14R20, 14.00R21 and 14.00R20 are:
/// one may be meant where the other is written. No where either is no size.
bool nearly_same_size(const std::string& one, const std::string& other);

/// A size as the library names it, "600-65R28" for "600/65 r28"; "" where the text is no size.
std::string library_name_of_size(const std::string& text);

}  // namespace soilbin
