// A time series in H5MD: a folder with a file a frame, each written whole or not at all. So whatever kills the program,
// the frames before are readable; a run that goes on from a restart writes the frames it comes by again, with the same
// bits; and the number of grains may change. HDF5's own way (SWMR) leaves a killed file marked as open.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

struct FrameBody {
  std::string name;
  Vec3 position;
  Rotation rotation;
  Vec3 velocity, spin;  ///< half a step before the frame
  Vec3 force, torque;   ///< of the grains, a step before the frame
};

struct Frame {
  std::int64_t step = 0;
  double time = 0;  ///< [s]
  Grains grains;    ///< position, radius, velocity (half a step before), id, material; the rest is empty
  std::vector<FrameBody> bodies;
};

/// The file of a step's frame in a folder.
std::filesystem::path frame_path(const std::filesystem::path& folder, std::int64_t step);

/// Writes a frame, and the folder where there is none.
void write_frame(const std::filesystem::path& folder, const Setup& setup, const State& state);

/// All frames of a folder in the order of steps.
std::vector<std::filesystem::path> frames_of(const std::filesystem::path& folder);

/// Throws InputError for a file that can't be read, is cut short, damaged, foreign, or of another version.
Frame read_frame(const std::filesystem::path& path);

}  // namespace soilbin::dem
