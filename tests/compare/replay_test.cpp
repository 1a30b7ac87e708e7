#include "compare/replay/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "compare/experiments/replay_recorder.hpp"
#include "compare/report/javascript.hpp"
#include "compare/report/sealed_json.hpp"
#include "scenario/errors.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::HasSubstr;

/// Two grains that move, one that rests; given out of the order of x.
Replay three_grains() {
  Replay replay;
  replay.title = "load 4 kN";
  replay.facts = {{"packing", "1"}};
  replay.radii = {0.02, 0.01, 0.03};
  replay.tire = {{0.1, 0.2, 0.3}};
  replay.triangles = {{0, 0, 0}};
  for (int k = 0; k < 4; ++k)
    replay.frames.push_back({0.1 * k,
                             {1.0 * k, 0, 0.5},
                             {1, 0, 0, 0},
                             {{2.0 - 0.2 * k, 0.1, 0.3}, {0.5, 0.4, 0.2}, {1.0 + 0.001 * k, 0, 0}}});
  return replay;
}

/// What a browser does: unpack, join the planes, undo the zigzag, add the changes up.
struct Unpacked {
  nlohmann::json header;
  std::vector<float> radii;
  std::vector<std::vector<Point>> frames;

  explicit Unpacked(const std::string& bytes) {
    const std::size_t end = bytes.find('\n');
    header = nlohmann::json::parse(bytes.substr(0, end));
    const std::size_t n = header["grains"], count = header["frames"], vertices = header["vertices"],
                      triangles = header["triangles"];
    const std::size_t before = 4 * n + 12 * (vertices + triangles);
    std::string raw(before + count * 6 * n, '\0');
    uLongf size = raw.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(raw.data()), &size,
                         reinterpret_cast<const Bytef*>(bytes.data() + end + 1), bytes.size() - end - 1),
              Z_OK);
    EXPECT_EQ(size, raw.size());
    radii.resize(n);
    std::memcpy(radii.data(), raw.data(), 4 * n);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(raw[i])); };
    std::vector<std::array<unsigned, 3>> sum(n, {0, 0, 0});
    for (std::size_t f = 0; f < count; ++f) {
      frames.emplace_back(n);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t k = 0; k < n; ++k) {
          const std::size_t at = before + (3 * f + a) * 2 * n + k;
          const unsigned z = byte(at) | byte(at + n) << 8;
          sum[k][a] = (sum[k][a] + ((z >> 1) ^ (z & 1 ? 0xFFFFU : 0U))) & 0xFFFF;
          frames[f][k][a] = header["origin"][a].get<double>() + header["step"].get<double>() * sum[k][a];
        }
    }
  }
};

TEST(Replay, UnpacksToThePlacesWithinHalfAStep) {
  const Replay replay = three_grains();
  const Unpacked unpacked(replay_bytes(replay));
  const std::size_t order[] = {1, 2, 0};                // by first x: 0.5, 1.0, 2.0
  const double half_a_step = 1.5 / 65535 / 2 * 1.0001;  // x goes from 0.5 to 2.0
  for (std::size_t f = 0; f < 4; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        EXPECT_NEAR(unpacked.frames[f][k][a], replay.frames[f].grains[order[k]][a], half_a_step);
  EXPECT_FLOAT_EQ(unpacked.radii[0], 0.01F);
  EXPECT_EQ(unpacked.header["wheel"][2][0], 2.0);
  EXPECT_NEAR(unpacked.header["times"][3].get<double>(), 0.3, 1e-12);
}

// 20,000 grains of which a hundredth moves: a frame beyond the first costs far less than its 120,000 bytes.
// What presses on grains comes after the places, a byte each, in the grains' order by x.
TEST(Replay, KeepsContactForcesWallsAndTheWheelsForces) {
  Replay replay = three_grains();
  replay.bin = ReplayBin{{0, 0, 0}, {4, 1, 1e6}, {true, false, false}};
  for (std::size_t f = 0; f < replay.frames.size(); ++f) {
    replay.frames[f].pressing = {100.0, 25.0, 0.0};  // of x 2.0, 0.5, 1.0 at first
    replay.frames[f].force = {1.0, 2.0, 3.0 + static_cast<double>(f)};
  }
  const std::string bytes = replay_bytes(replay);
  const std::size_t end = bytes.find('\n');
  const nlohmann::json header = nlohmann::json::parse(bytes.substr(0, end));
  EXPECT_EQ(header["pressing"], 100.0);
  EXPECT_EQ(header["bin"]["upper"][0], 4.0);
  EXPECT_EQ(header["bin"]["periodic"], nlohmann::json({true, false, false}));
  EXPECT_EQ(header["force"][3], nlohmann::json({1.0, 2.0, 6.0}));
  const std::size_t before = 4 * 3 + 12 + 12 + 4 * 6 * 3;
  std::string raw(before + 4 * 3, '\0');
  uLongf size = raw.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(raw.data()), &size,
                       reinterpret_cast<const Bytef*>(bytes.data() + end + 1), bytes.size() - end - 1),
            Z_OK);
  ASSERT_EQ(size, raw.size());
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(raw[before + k]); };
  EXPECT_EQ(byte(0), 128) << "255 sqrt(25/100)";
  EXPECT_EQ(byte(1), 0);
  EXPECT_EQ(byte(2), 255);
  const auto file = std::filesystem::temp_directory_path() / "soilbin-pressing.replay";
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_EQ(read_replay(file).frames, 4U);
  std::filesystem::remove(file);
  replay.frames[1].pressing.pop_back();
  EXPECT_THROW(replay_bytes(replay), InputError);
}

TEST(Replay, GrainsAtRestCostNothing) {
  Replay replay;
  for (std::size_t k = 0; k < 20000; ++k) replay.radii.push_back(0.01);
  for (int f = 0; f < 2; ++f) {
    replay.frames.emplace_back();
    for (std::size_t k = 0; k < 20000; ++k) {
      const double x = static_cast<double>(k);
      replay.frames.back().grains.push_back({std::fmod(x * 0.618034, 1.0) * 3, std::fmod(x * 0.41421, 1.0),
                                             std::fmod(x * 0.7320508, 1.0) + (k % 100 == 0 ? 0.01 * f : 0.0)});
    }
  }
  const std::size_t two = replay_bytes(replay).size();
  replay.frames.pop_back();
  EXPECT_LT(two - replay_bytes(replay).size(), 2000U);
}

TEST(Replay, RefusesWhatIsNone) {
  EXPECT_THROW(replay_bytes(Replay{}), InputError);
  Replay lost = three_grains();
  lost.frames[2].grains.pop_back();
  EXPECT_THROW(replay_bytes(lost), InputError);
  EXPECT_THROW(read_replay("no-such-file"), InputError);
  const auto path = std::filesystem::temp_directory_path() / "soilbin-no-replay";
  std::ofstream(path) << "{\"format\": \"other\"}\n";
  EXPECT_THROW(read_replay(path), InputError);
  std::ofstream(path, std::ios::binary) << replay_bytes(three_grains());
  const ReplayFile file = read_replay(path);
  EXPECT_EQ(file.grains, 3U);
  EXPECT_EQ(file.frames, 4U);
  EXPECT_NEAR(file.seconds, 0.3, 1e-12);
  std::filesystem::remove(path);
}

/// A replay with its header changed and sealed anew.
std::string sealed_again(const std::string& bytes, const std::function<void(nlohmann::ordered_json&)>& change) {
  const std::size_t end = bytes.find('\n');
  auto header = nlohmann::ordered_json::parse(bytes.substr(0, end));
  header.erase("seal");
  change(header);
  put_seal(header);
  return header.dump() + bytes.substr(end);
}

// The seal fits, and the header is of an attacker: refused in a moment, and by name. Without times it was signal 11.
TEST(Replay, ASealThatFitsProvesNothing) {
  const auto path = std::filesystem::temp_directory_path() / ("soilbin-hostile-replay-" + std::to_string(::getpid()));
  const std::string bytes = replay_bytes(three_grains());
  const auto says = [&](const std::string& replay) {
    std::ofstream(path, std::ios::binary) << replay;
    const std::string why = soilbin::test::error_of([&] { read_replay(path); });
    EXPECT_TRUE(why.empty() || why.find(path.string()) != std::string::npos);
    return why;
  };
  using Header = nlohmann::ordered_json;
  const auto changed = [&](const std::function<void(Header&)>& change) { return says(sealed_again(bytes, change)); };
  EXPECT_EQ(changed([](Header&) {}), "");
  for (const char* key : {"times", "wheel", "rotation", "force", "torque"}) {
    EXPECT_THAT(changed([&](Header& h) { h[key] = Header::array(); }), HasSubstr(key));
    EXPECT_THAT(changed([&](Header& h) { h[key][1] = "none"; }), HasSubstr(key));
    EXPECT_THAT(changed([&](Header& h) { h[key] = 3; }), HasSubstr(key));
  }
  EXPECT_THAT(changed([](Header& h) { h["frames"] = 0; }), HasSubstr("there are no frames"));
  EXPECT_THAT(changed([](Header& h) { h["grains"] = -1; }), HasSubstr("grains is no count"));
  EXPECT_THAT(changed([](Header& h) { h["grains"] = 1.5; }), HasSubstr("grains is no count"));
  EXPECT_THAT(changed([](Header& h) { h["vertices"] = 4'000'000'000U; }), HasSubstr("vertices is no count"));
  EXPECT_THAT(changed([](Header& h) { h["vertices"] = 7; }), HasSubstr("cut short or damaged"));
  std::filesystem::remove(path);
}

// 20 MB that unpack to 20 GB took 46 s.
TEST(Replay, ABombIsRefusedBeforeItGoesOff) {
  const auto path = std::filesystem::temp_directory_path() / ("soilbin-bomb-replay-" + std::to_string(::getpid()));
  std::ofstream(path, std::ios::binary) << sealed_again(replay_bytes(three_grains()), [](nlohmann::ordered_json& h) {
    h["grains"] = 1'000'000;
    h["frames"] = 3500;
  }) << std::string(20'000'000, '\0');
  const std::clock_t begin = std::clock();
  EXPECT_THAT(soilbin::test::refusal([&] { read_replay(path); }),
              HasSubstr("1000000 grains in 3500 frames are 21004000024 bytes, more than the 2147483648"));
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 2);
  std::filesystem::remove(path);
}

TEST(Replay, WhatIsWrittenIsThinEnoughToBeRead) {
  Replay long_one;
  long_one.radii.assign(100'000, 0.01);
  long_one.frames.resize(4000);  // of 2.8 GB; only their number is looked at
  for (std::size_t k = 0; k < 4000; ++k) long_one.frames[k].time = static_cast<double>(k);
  thin_out(long_one);
  ASSERT_EQ(long_one.frames.size(), 2000U);
  EXPECT_EQ(long_one.frames[999].time, 1998.0);
  Replay short_one = three_grains();
  thin_out(short_one);
  EXPECT_EQ(short_one.frames.size(), 4U);
}

// Damage of one bit: refused with the file's name, or nothing that a page shows has changed.
TEST(SlowReplay, NoFlippedBitPassesForWhatWasSeen) {
  const auto path = std::filesystem::temp_directory_path() / "soilbin-damaged-replay";
  const std::string bytes = replay_bytes(three_grains());
  std::mt19937 random(26);
  int refused = 0;
  constexpr int flips = 500;
  for (int k = 0; k < flips; ++k) {
    std::string damaged = bytes;
    const std::size_t at = random() % bytes.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    std::ofstream(path, std::ios::binary) << damaged;
    try {
      read_replay(path);
      const Unpacked seen(damaged), right(bytes);
      EXPECT_EQ(seen.frames, right.frames) << "byte " << at;
      EXPECT_EQ(seen.header["times"], right.header["times"]) << "byte " << at;
    } catch (const InputError& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << "byte " << at;
    }
  }
  EXPECT_GT(refused, flips * 9 / 10) << "all but what stands in the name of the seal";
  std::filesystem::remove(path);
}

TEST(Replay, ADeviceIsRefusedBeforeItFillsTheMemory) { EXPECT_THROW(read_replay("/dev/zero"), InputError); }

// RFC 4648, section 10.
TEST(Base64, PublishedVectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

// Grains come in ahead of the wheel and leave behind it: each frame shows those that are there.
TEST(SlowReplay, FollowsAMovingPatchWithThePlacesOfGrainsThatHaveLeft) {
  dem::BedRecipe recipe = dem::test::small_recipe({0.3, 0.16, 0.06});
  recipe.periodic = true;
  const dem::SettledBed tile = dem::settle_bed(recipe, dem::test::with_threads(1));
  const Tire tire = dem::test::small_wheel();
  dem::Rig rig;
  rig.patch = true, rig.behind = 0.12, rig.ahead = 0.16, rig.travel = 0.5;
  rig.lowering = 0.05, rig.resting = 0.02, rig.starting = 0.05;
  ReplayRecorder recorder;
  rig.onlooker = recorder.onlooker();
  OperatingCondition at;
  at.load = 20, at.slip = 0.2, at.speed = 0.5;
  const dem::WheelRun run = dem::run_wheel({tile, tire, recipe.soil.grain_tire, rig}, at, dem::test::with_threads(1));
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("soilbin-patch-" + std::to_string(::getpid()) + ".replay");
  recorder.write({file, "test"}, "patch", 1);
  const ReplayFile kept = read_replay(file);
  std::filesystem::remove(file);
  EXPECT_GE(kept.frames, 20U);
  // At least those of a patch at once; no more than the tiles that a patch lies on have, though five tiles' grains
  // came.
  EXPECT_GE(static_cast<double>(kept.grains), 0.9 * run.patch.grains);
  EXPECT_LE(static_cast<double>(kept.grains), run.patch.grains + static_cast<double>(tile.report.grains));
}

}  // namespace
}  // namespace soilbin::compare
