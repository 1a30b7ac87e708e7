// Files whose seal fits and whose content was made to do harm: refused, by name, without much time or memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <ctime>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "dem/archive/restart.hpp"
#include "dem/archive/sealed_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using test::Folder;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr const char* positions = "particles/grains/position/value";
constexpr const char* radii = "particles/grains/radius/value";

long peak_kilobytes() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

class HostileRestart : public testing::Test {
 protected:
  HostileRestart() {
    Simulation simulation = test::scene(60);
    simulation.run(100);
    write_restart(file_, simulation.setup(), simulation.state(), {{"phase", "settling"}});
    good_ = test::read_bytes(file_);
    ::mkfifo(pipe_.c_str(), 0600);
  }

  /// What the restart is refused with once HDF5's own functions have changed it and it is sealed anew.
  std::string refusal(const std::function<void(hid_t)>& change) {
    const std::filesystem::path bare = folder_ / "bare.h5";
    test::write_bytes(bare, good_.substr(512));
    const hid_t open = H5Fopen(bare.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    EXPECT_GE(open, 0);
    change(open);
    EXPECT_GE(H5Fclose(open), 0);
    write_sealed(file_, {"restart", 2}, test::read_bytes(bare), Keep::nothing);
    const std::clock_t begin = std::clock();
    const long before = peak_kilobytes();
    const std::string why = soilbin::test::error_of([&] { read_restart(file_); });
    EXPECT_THAT(why, testing::AnyOf("", HasSubstr("run.h5")));
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 5);
    EXPECT_LT(peak_kilobytes() - before, 200'000);
    return why;
  }

  /// One number of a dataset of doubles.
  static void set_number(hid_t file, const char* name, std::size_t at, double value) {
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<double> numbers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), 0);
    numbers.at(at) = value;
    EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), 0);
    H5Sclose(space), H5Dclose(set);
  }
  static void set_attribute(hid_t file, const char* group, const char* name, hid_t type, const void* value) {
    const hid_t where = H5Gopen2(file, group, H5P_DEFAULT);
    EXPECT_GE(where, 0);
    const hid_t attribute = H5Aopen(where, name, H5P_DEFAULT);
    EXPECT_GE(attribute, 0);
    EXPECT_GE(H5Awrite(attribute, type, value), 0);
    H5Aclose(attribute), H5Gclose(where);
  }
  /// A dataset in place of one that was there, or new.
  static void make(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& lengths, hid_t how) {
    if (H5Lexists(file, name, H5P_DEFAULT) > 0) H5Ldelete(file, name, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(static_cast<int>(lengths.size()), lengths.data(), nullptr);
    const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    EXPECT_GE(set, 0);
    H5Dclose(set), H5Sclose(space), H5Pclose(how);
  }
  static hid_t in_chunks(hsize_t length) {
    const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(how, 1, &length);
    return how;
  }

  const Folder folder_;
  const std::filesystem::path file_ = folder_ / "run.h5", pipe_ = folder_ / "pipe";
  std::string good_;
};

TEST_F(HostileRestart, WithoutAChangeIsTaken) {
  EXPECT_EQ(refusal([](hid_t) {}), "");
}

TEST_F(HostileRestart, PlacesAndSizesThatAreNone) {
  for (const double value : {not_a_number, infinite, -infinite, 1e300})
    EXPECT_THAT(refusal([&](hid_t file) { set_number(file, positions, 7, value); }), HasSubstr("places and sizes"));
  for (const double value : {not_a_number, infinite, 0.0, -0.01})
    EXPECT_THAT(refusal([&](hid_t file) { set_number(file, radii, 3, value); }), HasSubstr("places and sizes"));
  for (const double value : {not_a_number, infinite, -1.0})
    EXPECT_THAT(refusal([&](hid_t file) { set_number(file, "soilbin/grains/inverse_mass", 3, value); }),
                HasSubstr("places and sizes"));
  EXPECT_NE(refusal([&](hid_t file) { set_number(file, "soilbin/state/searched_at", 4, not_a_number); }), "");
}

TEST_F(HostileRestart, StepsThatGetNowhere) {
  for (const double value : {1e-300, 1e-15, 0.0, -1e-5, not_a_number, infinite})
    EXPECT_NE(
        refusal([&](hid_t file) { set_attribute(file, "soilbin/setup/numerics", "dt", H5T_NATIVE_DOUBLE, &value); }),
        "")
        << value;
}

TEST_F(HostileRestart, NumbersOfRowsThatAreNotThere) {
  for (const std::uint64_t many : {std::uint64_t{1'000'000'000}, ~std::uint64_t{0}, std::uint64_t{0}}) {
    const auto told = [&](const char* group, const char* name) {
      return refusal([&](hid_t file) { set_attribute(file, group, name, H5T_NATIVE_UINT64, &many); });
    };
    EXPECT_THAT(told("soilbin/state", "grains"), HasSubstr("contradicts the rest"));
    EXPECT_NE(told("soilbin/state", "bodies"), "");
    EXPECT_NE(told("soilbin/state", "searched"), "");
    EXPECT_NE(told("soilbin/state/pairs", "numbers"), "");
    EXPECT_NE(told("soilbin/meshes", "count"), "");
    EXPECT_NE(told("soilbin/meshes/0", "vertices_count"), "");
    EXPECT_NE(told("soilbin/setup/materials", "count"), "");
  }
  const std::uint32_t ids = 4'000'000'000;
  EXPECT_NE(refusal([&](hid_t file) { set_attribute(file, "soilbin/state", "next_id", H5T_NATIVE_UINT32, &ids); }), "");
}

TEST_F(HostileRestart, NotesWithoutEnd) {
  EXPECT_THAT(
      refusal([](hid_t file) { make(file, "soilbin/notes/huge", H5T_STD_U8LE, {4'000'000'000}, in_chunks(1 << 20)); }),
      HasSubstr("larger than the file can hold"));
  EXPECT_THAT(refusal([](hid_t file) {
                for (int k = 0; k < 20'000; ++k) {
                  const std::string name = "soilbin/notes/" + std::to_string(k);
                  H5Gclose(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
                }
              }),
              HasSubstr("one object too many"));
  EXPECT_THAT(refusal([](hid_t file) {
                const hid_t notes = H5Gopen2(file, "soilbin/notes", H5P_DEFAULT), one = H5Screate(H5S_SCALAR);
                for (int k = 0; k < 20'000; ++k)
                  H5Aclose(H5Acreate2(notes, std::to_string(k).c_str(), H5T_STD_I32LE, one, H5P_DEFAULT, H5P_DEFAULT));
                H5Sclose(one), H5Gclose(notes);
              }),
              HasSubstr("too many attributes"));
}

TEST_F(HostileRestart, DataThatLieElsewhere) {
  EXPECT_THAT(refusal([](hid_t file) {
                const hsize_t lengths[] = {1, 60, 3};
                const hid_t how = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(3, lengths, nullptr);
                EXPECT_GE(H5Pset_virtual(how, space, ".", positions, space), 0);
                H5Sclose(space);
                make(file, positions, H5T_IEEE_F64LE, {1, 60, 3}, how);
              }),
              AllOf(HasSubstr(positions), HasSubstr("is a virtual dataset")));
  EXPECT_THAT(refusal([&](hid_t file) {
                const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
                H5Pset_external(how, pipe_.c_str(), 0, 8 * 60 * 3);
                make(file, positions, H5T_IEEE_F64LE, {1, 60, 3}, how);
              }),
              AllOf(HasSubstr(positions), HasSubstr("lies in another file")));
  EXPECT_THAT(refusal([&](hid_t file) {
                H5Ldelete(file, "soilbin/notes", H5P_DEFAULT);
                H5Lcreate_external(pipe_.c_str(), "/", file, "soilbin/notes", H5P_DEFAULT, H5P_DEFAULT);
              }),
              AllOf(HasSubstr("soilbin/notes"), HasSubstr("is a link")));
  EXPECT_THAT(refusal([&](hid_t file) {
                H5Lcreate_soft("/soilbin/notes", file, "soilbin/notes/again", H5P_DEFAULT, H5P_DEFAULT);
              }),
              HasSubstr("is a link"));
  EXPECT_NE(refusal([](hid_t file) {
              H5Lcreate_hard(file, "/soilbin", file, "soilbin/notes/round", H5P_DEFAULT, H5P_DEFAULT);
            }),
            "");
}

TEST_F(HostileRestart, DataOfAnotherKind) {
  EXPECT_THAT(refusal([](hid_t file) {
                const hid_t text = H5Tcopy(H5T_C_S1);
                H5Tset_size(text, H5T_VARIABLE);
                make(file, "soilbin/notes/text", text, {4}, H5Pcreate(H5P_DATASET_CREATE));
                H5Tclose(text);
              }),
              HasSubstr("has no numbers"));
}

// Files that are pipes, or names that lead to one, are refused without waiting.
TEST_F(HostileRestart, APipeIsNotRead) {
  EXPECT_THROW(read_restart(pipe_), InputError);
  std::filesystem::create_symlink(pipe_, folder_ / "link.h5");
  EXPECT_THROW(read_restart(folder_ / "link.h5"), InputError);
}

}  // namespace
}  // namespace soilbin::dem
