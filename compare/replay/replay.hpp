// A run of grains to look at: soilbin-replay/1, small enough to lie in a page (docs/reference/replay-format.md).
//
// A line of JSON, a line feed, and a zlib stream. Positions are steps of `step` metres from `origin` in 16 bits; each
// frame holds what moved since the one before, zigzag-coded, low bytes apart from high bytes: grains at rest are zeros,
// which cost nothing.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace soilbin::compare {

using Point = std::array<double, 3>;  ///< x, y, z in the frame of the bin [m]

/// The wheel and all grains at one time. Grains keep their places in the list.
struct ReplayFrame {
  double time = 0.0;                             ///< [s]
  Point wheel{};                                 ///< its centre
  std::array<double, 4> rotation{1.0, 0, 0, 0};  ///< of the tire's mesh: unit quaternion w, x, y, z
  std::vector<Point> grains;
  std::vector<double> pressing{};  ///< the largest normal force of each grain's contacts [N]; empty: not kept
  Point force{}, torque{};         ///< of the grains on the wheel at this step, torque about its centre [N], [N m]
};

/// The space in which the grains lie.
struct ReplayBin {
  Point lower{}, upper{};          ///< [m]
  std::array<bool, 3> periodic{};  ///< along x, y, z: no wall there
};

struct Replay {
  std::string title;                                       ///< the condition in words
  std::vector<std::pair<std::string, std::string>> facts;  ///< "packing" "1"
  std::vector<double> radii;                               ///< of each grain [m]
  std::vector<Point> tire;                                 ///< vertices of the tire's surface, about its centre [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double surface = 0.0;            ///< height of the undisturbed surface [m]
  std::optional<ReplayBin> bin{};  ///< no value: not kept
  std::vector<ReplayFrame> frames;
};

inline constexpr const char* replay_format = "soilbin-replay/1";

/// Leaves out every second frame, again and again, until a page can take the rest: 2 GiB before they are compressed.
void thin_out(Replay& replay);

/// The file's bytes. Header keys that older files lack: "bin", "force", "torque", and "pressing": the largest normal
/// force [N] that a byte of 255 stands for; where it is there, a byte for each grain of each frame follows the places,
/// 255 sqrt(F/pressing). Grains are told in the order of their first x, so that what a wheel moves lies together.
/// Places are good to half a step, the largest extent over 65535 / 2. Throws InputError without frames or with frames
/// of unequal numbers of grains.
std::string replay_bytes(const Replay& replay);

/// A replay file as a page takes it: its header, and the whole for the browser to unpack.
struct ReplayFile {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;
  std::size_t grains = 0, frames = 0;
  double seconds = 0.0;  ///< from the first frame to the last
  std::string bytes;
};

/// Throws InputError for a file that can't be read or is no replay, one whose header contradicts itself, and one of
/// more than 2 GiB once it is unpacked; that is told before it is.
ReplayFile read_replay(const std::filesystem::path& path);

}  // namespace soilbin::compare
