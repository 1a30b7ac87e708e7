// Stopping and going on: all of a run of grains in one file, to the bit. Layout: docs/reference/dem-archive.md.
//
//   write_restart("run.h5", simulation.setup(), simulation.state(), {{"phase", "driving"}});
//   const LastGood last = read_last_good("run.h5");  // last.warning: why it is not the newest; else empty
//   Simulation again(last.restart.setup, last.restart.state);
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "dem/archive/sealed_file.hpp"
#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

/// What the program round a simulation wants to find again: its phase, the state of its random numbers.
using Notes = std::map<std::string, std::string>;

struct Restart {
  Setup setup;
  State state;  ///< meshes come without grids; Simulation makes them
  Notes notes;
};

/// Writes a whole restart or nothing; the one that was there before stays as path + ".previous", where it is to be
/// kept. The same setup, state and notes give the same bytes. Throws std::runtime_error where the disk refuses.
void write_restart(const std::filesystem::path& path, const Setup& setup, const State& state, const Notes& notes = {},
                   Keep keep = Keep::previous);

/// Throws InputError for a file that can't be read, is cut short, damaged, foreign, or of another version, and for one
/// whose seal fits but whose content no run can have: places, sizes or steps that are none, numbers of rows that the
/// file doesn't fill, links, and data that lie elsewhere (hdf5::InputFile).
Restart read_restart(const std::filesystem::path& path);

/// Whether there is a restart, or the one before it, good or not.
bool has_restart(const std::filesystem::path& path);

/// Removes both, where they are.
void remove_restart(const std::filesystem::path& path);

struct LastGood {
  Restart restart;
  std::filesystem::path from;
  std::string warning;  ///< why it isn't the last one; empty where it is
};

/// The restart, or where that isn't good the one before it. Throws InputError where neither is.
LastGood read_last_good(const std::filesystem::path& path);

}  // namespace soilbin::dem
