// Random numbers that come out the same on every machine: for the places and radii of poured grains.
#pragma once

#include <cstdint>

namespace soilbin::dem {

/// SplitMix64 (Steele, Lea and Flood 2014): small, seeded by any number, the same on every machine, its state one word.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53); }

 private:
  std::uint64_t state_;
};

}  // namespace soilbin::dem
