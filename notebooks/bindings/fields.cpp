#include "notebooks/bindings/fields.hpp"

#include <array>
#include <utility>

namespace soilbin::python {

std::string si_unit_of(const std::string& unit) {
  static constexpr std::array<std::pair<const char*, const char*>, 9> other = {{{"mm", "m"},
                                                                                {"kPa", "Pa"},
                                                                                {"MPa", "Pa"},
                                                                                {"deg", "rad"},
                                                                                {"%", "-"},
                                                                                {"rpm", "rad/s"},
                                                                                {"kJ/m^3", "J/m^3"},
                                                                                {"kN/m^(n+1)", "N/m^(n+1)"},
                                                                                {"kN/m^(n+2)", "N/m^(n+2)"}}};
  for (const auto& [file, si] : other)
    if (unit == file) return si;
  return unit;
}

std::string field_doc(const std::string& meaning, const Measure& measure) {
  const std::string unit = si_unit_of(measure.unit);
  const bool bounded = std::isfinite(measure.range.lower) || std::isfinite(measure.range.upper);
  const std::string range = bounded ? describe_range({unit, measure.range}) : "";
  return fmt::format("{} [{}]{}", meaning, unit, range.empty() ? "" : ", " + range);
}

void check_value(const char* key, double value, const Measure& measure) {
  if (!std::isfinite(value)) throw InputError(fmt::format("{}: {} is no number to work with", key, value));
  if (measure.range.holds(value)) return;
  throw InputError(fmt::format("{}: {} is out of range, which is {}", key, value,
                               describe_range({si_unit_of(measure.unit), measure.range})));
}

void set_attributes(py::handle self, const py::kwargs& given, const std::vector<std::string>& known) {
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw py::type_error(fmt::format("{} has no attribute '{}'{}",
                                       py::type::of(self).attr("__name__").cast<std::string>(), name,
                                       did_you_mean(name, known)));
    py::setattr(self, key, value);
  }
}

std::string described_text(py::handle self, py::handle plain, const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys) {
    const py::object value = self.attr(key.c_str());
    const auto shown = py::repr(value).cast<std::string>();
    if (shown == py::repr(plain.attr(key.c_str())).cast<std::string>()) continue;
    text += (text.empty() ? "" : ", ") + key + "=" + shown;
  }
  return py::type::of(self).attr("__name__").cast<std::string>() + "(" + text + ")";
}

}  // namespace soilbin::python
