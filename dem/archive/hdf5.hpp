// HDF5, wrapped once. Files are built and read in memory: what reaches the disk, and whether it came back whole, is
// decided in sealed_file.hpp, so HDF5's parser never sees a damaged byte.
//
// Writing throws std::runtime_error, reading InputError; both name the file and the place in it. HDF5 prints nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace soilbin::dem::hdf5 {

/// What an array is made of; in files always lowest byte first.
enum class Number : std::uint8_t { f64, f32, i64, i32, u64, u32, u16, u8 };

template <class T>
consteval Number number_of() {
  if constexpr (std::is_same_v<T, double>) return Number::f64;
  if constexpr (std::is_same_v<T, float>) return Number::f32;
  if constexpr (std::is_same_v<T, std::int64_t>) return Number::i64;
  if constexpr (std::is_same_v<T, std::int32_t>) return Number::i32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return Number::u64;
  if constexpr (std::is_same_v<T, std::uint32_t>) return Number::u32;
  if constexpr (std::is_same_v<T, std::uint16_t>) return Number::u16;
  if constexpr (std::is_same_v<T, std::uint8_t>) return Number::u8;
}

/// Lengths along each dimension; empty: a scalar.
using Shape = std::vector<std::uint64_t>;

/// A group of a file; copies are the same group. Keeps its file open.
class Group {
 public:
  Group create(const std::string& name) const;
  Group open(const std::string& name) const;
  bool has(const std::string& name) const;

  /// A dataset. From a kilobyte on in chunks: shuffled, deflated at the fastest level, with fletcher32.
  void write(const std::string& name, Number number, const Shape& shape, const void* data) const;
  Shape shape(const std::string& name) const;
  /// Refuses a dataset of other numbers or another shape.
  void read(const std::string& name, Number number, const Shape& shape, void* data) const;
  /// Names of the datasets and groups in it.
  std::vector<std::string> names() const;

  /// Attributes of the group.
  void set_numbers(const std::string& name, Number number, const Shape& shape, const void* data) const;
  void get_numbers(const std::string& name, Number number, const Shape& shape, void* data) const;
  void set_text(const std::string& name, const std::string& text) const;
  std::string get_text(const std::string& name) const;
  std::vector<std::string> text_names() const;
  /// Texts of one length, filled up with zeros.
  void set_texts(const std::string& name, const std::vector<std::string>& texts) const;
  /// A string of variable length, which H5MD wants for units; of the group, or of its dataset `of`.
  void set_free_text(const std::string& name, const std::string& text, const std::string& of = "") const;

  /// "file: /path/name", for messages.
  std::string place(const std::string& name = "") const;

 private:
  friend class OutputFile;
  friend class InputFile;
  struct Handle;
  explicit Group(std::shared_ptr<Handle> handle) : handle_(std::move(handle)) {}
  std::shared_ptr<Handle> handle_;
};

/// A file that is being built in memory. `name` is for messages.
class OutputFile {
 public:
  explicit OutputFile(const std::string& name);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();
  const Group& root() const { return root_; }
  /// Ends the file, its groups can't be used any more, and gives it as it would lie on the disk; lives as long as this.
  /// Ends the file and gives its bytes: equal content gives equal bytes, since no times are in it.
  std::string_view finish();

 private:
  struct Building;
  std::unique_ptr<Building> building_;
  Group root_;
};

/// A file that lies in memory. `name` is for messages.
///
/// Its whole is looked over before anything is read: InputError for links other than hard ones and for data outside the
/// file or made of other data (external, virtual), which would have other files opened; for filters other than ours;
/// for what is no number; for more than 10,000 objects, or 1,000 attributes of one; for a dataset that is larger than
/// what is stored of it can unpack to, and where all of them together have more than 64 MiB and 128 times the file.
class InputFile {
 public:
  InputFile(std::string_view image, const std::string& name);
  const Group& root() const { return root_; }

 private:
  Group root_;
};

}  // namespace soilbin::dem::hdf5
