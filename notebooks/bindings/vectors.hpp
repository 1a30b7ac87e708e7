// Vectors of the engine as arrays of three.
#pragma once

#include <array>

#include "dem/surface/vec3.hpp"
#include "notebooks/bindings/bindings.hpp"

namespace soilbin::python {

using Triple = std::array<double, 3>;

inline dem::Vec3 vec3_of(const Triple& a) { return {a[0], a[1], a[2]}; }

inline py::array_t<double> array_of(const dem::Vec3& a) {
  py::array_t<double> out(3);
  double* to = out.mutable_data();
  to[0] = a.x, to[1] = a.y, to[2] = a.z;
  return out;
}

/// The getter of a vector that is a member.
template <class T>
auto array_in(dem::Vec3 T::*member) {
  return [member](const T& self) { return array_of(self.*member); };
}

/// A vector of each row as an array of three columns that looks into the rows.
template <class Row>
py::array vectors(const std::vector<Row>& rows, dem::Vec3 Row::*member, py::handle owner) {
  if (rows.empty()) return py::array_t<double>(std::vector<py::ssize_t>{0, 3});
  py::array out(py::dtype::of<double>(), std::vector<py::ssize_t>{static_cast<py::ssize_t>(rows.size()), 3},
                std::vector<py::ssize_t>{sizeof(Row), sizeof(double)}, &(rows.front().*member).x, owner);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

}  // namespace soilbin::python
