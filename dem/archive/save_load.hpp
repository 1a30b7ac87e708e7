// Saver and Loader: values into an HDF5 archive and back. Both visit the same descriptions (restart_layout.hpp), so
// what is written and what is read cannot differ. A value becomes an attribute, a column of rows a dataset, an element
// what H5MD calls so.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "dem/archive/hdf5.hpp"
#include "dem/engine/laws/triple.hpp"
#include "dem/surface/vec3.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

/// The numbers that a value is made of. Exact both ways.
template <class T>
struct Parts {
  static_assert(std::is_arithmetic_v<T>);
  using Number = T;
  static constexpr std::size_t count = 1;
  static std::array<T, 1> of(const T& a) { return {a}; }
  static T from(const T* a) { return *a; }
};
template <>
struct Parts<bool> {
  using Number = std::uint8_t;
  static constexpr std::size_t count = 1;
  static std::array<Number, 1> of(bool a) { return {static_cast<Number>(a)}; }
  static bool from(const Number* a) { return *a != 0; }
};
template <>
struct Parts<Vec3> {
  using Number = double;
  static constexpr std::size_t count = 3;
  static std::array<double, 3> of(const Vec3& a) { return {a.x, a.y, a.z}; }
  static Vec3 from(const double* a) { return {a[0], a[1], a[2]}; }
};
template <>
struct Parts<Triple<double>> {
  using Number = double;
  static constexpr std::size_t count = 3;
  static std::array<double, 3> of(const Triple<double>& a) { return {a.x, a.y, a.z}; }
  static Triple<double> from(const double* a) { return {a[0], a[1], a[2]}; }
};
template <>
struct Parts<Rotation> {
  using Number = double;
  static constexpr std::size_t count = 4;
  static std::array<double, 4> of(const Rotation& a) { return {a.w, a.x, a.y, a.z}; }
  static Rotation from(const double* a) { return {a[0], a[1], a[2], a[3]}; }
};
template <class T, std::size_t n>
struct Parts<std::array<T, n>> {
  using Number = typename Parts<T>::Number;
  static constexpr std::size_t count = n;
  static std::array<Number, n> of(const std::array<T, n>& a) {
    std::array<Number, n> parts;
    for (std::size_t k = 0; k < n; ++k) parts[k] = Parts<T>::of(a[k])[0];
    return parts;
  }
  static std::array<T, n> from(const Number* a) {
    std::array<T, n> value;
    for (std::size_t k = 0; k < n; ++k) value[k] = Parts<T>::from(a + k);
    return value;
  }
};

/// The largest number of things that have a group each: bodies, meshes, materials.
inline constexpr std::uint64_t most_groups = 10'000;

/// The row itself, for columns of numbers.
inline constexpr auto itself = [](auto& row) -> auto& { return row; };

/// Lengths of a column's dataset: one frame where `framed`, rows, parts of a row.
template <class T>
hdf5::Shape column_shape(std::size_t rows, bool framed) {
  hdf5::Shape shape;
  if (framed) shape.push_back(1);
  shape.push_back(rows);
  if (Parts<T>::count > 1) shape.push_back(Parts<T>::count);
  return shape;
}

template <class T>
hdf5::Shape value_shape() {
  return Parts<T>::count > 1 ? hdf5::Shape{Parts<T>::count} : hdf5::Shape{};
}

class Saver {
 public:
  static constexpr bool loads = false;
  explicit Saver(hdf5::Group group) : group_(std::move(group)) {}
  const hdf5::Group& group() const { return group_; }
  Saver inner(const std::string& name) const { return Saver(group_.create(name)); }

  template <class T>
  void value(const std::string& name, const T& value) const {
    const auto parts = Parts<T>::of(value);
    group_.set_numbers(name, hdf5::number_of<typename Parts<T>::Number>(), value_shape<T>(), parts.data());
  }
  void text(const std::string& name, const std::string& text) const { group_.set_text(name, text); }
  template <class Choice, std::size_t n>
  void choice(const std::string& name, Choice choice, const std::array<const char*, n>& names) const {
    group_.set_text(name, names.at(static_cast<std::size_t>(choice)));
  }
  /// `column`: the dataset that has as many rows; none where each has a group of its own.
  template <class Rows>
  void length(const std::string& name, const Rows& rows, const std::string& = "") const {
    value(name, static_cast<std::uint64_t>(rows.size()));
  }
  template <class Rows, class Project>
  void column(const std::string& name, const Rows& rows, const Project& project, const std::string& unit = "") const {
    write_column(name, rows, project, unit, false);
  }
  /// A sample of one frame: value, step and time under `name`.
  template <class Rows, class Project>
  void element(const std::string& name, const Rows& rows, const Project& project, std::int64_t step, double time,
               const std::string& unit = "") const {
    const Saver element = inner(name);
    element.write_column("value", rows, project, unit, true);
    element.group_.write("step", hdf5::Number::i64, {1}, &step);
    element.group_.write("time", hdf5::Number::f64, {1}, &time);
    element.group_.set_free_text("unit", "s", "time");
  }

 private:
  template <class Rows, class Project>
  void write_column(const std::string& name, const Rows& rows, const Project& project, const std::string& unit,
                    bool framed) const {
    using T = std::remove_cvref_t<decltype(project(*rows.begin()))>;
    std::vector<typename Parts<T>::Number> numbers;
    numbers.reserve(rows.size() * Parts<T>::count);
    for (const auto& row : rows) {
      const auto parts = Parts<T>::of(project(row));
      numbers.insert(numbers.end(), parts.begin(), parts.end());
    }
    group_.write(name, hdf5::number_of<typename Parts<T>::Number>(), column_shape<T>(rows.size(), framed),
                 numbers.data());
    if (!unit.empty()) group_.set_free_text("unit", unit, name);
  }

  hdf5::Group group_;
};

class Loader {
 public:
  static constexpr bool loads = true;
  explicit Loader(hdf5::Group group) : group_(std::move(group)) {}
  const hdf5::Group& group() const { return group_; }
  Loader inner(const std::string& name) const { return Loader(group_.open(name)); }

  template <class T>
  void value(const std::string& name, T& value) const {
    std::array<typename Parts<T>::Number, Parts<T>::count> parts{};
    group_.get_numbers(name, hdf5::number_of<typename Parts<T>::Number>(), value_shape<T>(), parts.data());
    value = Parts<T>::from(parts.data());
  }
  void text(const std::string& name, std::string& text) const { text = group_.get_text(name); }
  template <class Choice, std::size_t n>
  void choice(const std::string& name, Choice& choice, const std::array<const char*, n>& names) const {
    const std::string found = group_.get_text(name);
    for (std::size_t k = 0; k < n; ++k)
      if (found == names[k]) {
        choice = static_cast<Choice>(k);
        return;
      }
    throw InputError({group_.place(name), 0, 0}, "'" + found + "' is not known", "",
                     "read it with the soilbin that wrote it");
  }
  /// Makes room for as many rows as the file says, once its column has them: what a file says takes no memory that the
  /// file doesn't fill.
  template <class Rows>
  void length(const std::string& name, Rows& rows, const std::string& column = "") const {
    std::uint64_t size = 0;
    value(name, size);
    const hdf5::Shape shape = column.empty() ? hdf5::Shape{} : group_.shape(column);
    if (column.empty() ? size > most_groups : shape.empty() || shape[0] != size)
      throw InputError({group_.place(name), 0, 0}, "contradicts the rest", "", "the file is of another program");
    rows.resize(size);
  }
  /// `rows` has its length already.
  template <class Rows, class Project>
  void column(const std::string& name, Rows& rows, const Project& project, const std::string& = "") const {
    read_column(name, rows, project, false);
  }
  template <class Rows, class Project>
  void element(const std::string& name, Rows& rows, const Project& project, std::int64_t, double,
               const std::string& = "") const {
    inner(name).read_column("value", rows, project, true);
  }

 private:
  template <class Rows, class Project>
  void read_column(const std::string& name, Rows& rows, const Project& project, bool framed) const {
    using T = std::remove_cvref_t<decltype(project(*rows.begin()))>;
    std::vector<typename Parts<T>::Number> numbers(rows.size() * Parts<T>::count);
    group_.read(name, hdf5::number_of<typename Parts<T>::Number>(), column_shape<T>(rows.size(), framed),
                numbers.data());
    const auto* next = numbers.data();
    for (auto& row : rows) {
      project(row) = Parts<T>::from(next);
      next += Parts<T>::count;
    }
  }

  hdf5::Group group_;
};

}  // namespace soilbin::dem
