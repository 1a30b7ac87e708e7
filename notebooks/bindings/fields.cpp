#include "notebooks/bindings/fields.hpp"

#include "scenario/source_text.hpp"

namespace soilbin::python {

std::string field_doc(const std::string& meaning, const Measure& measure) {
  const std::string unit = si_unit_of(measure.unit);
  const bool bounded = std::isfinite(measure.range.lower) || std::isfinite(measure.range.upper);
  const std::string range = bounded ? describe_range({unit, measure.range}) : "";
  return fmt::format("{} [{}]{}", meaning, unit, range.empty() ? "" : ", " + range);
}

namespace {

/// "N m" as pint spells it.
std::string pint_unit(const std::string& key, const std::string& si) {
  if (si == "-") return "dimensionless";
  if (key == "k_c" || key == "k_phi") return "";  // depends on n: base units
  std::string text = si;
  if (const std::size_t blank = text.find(' '); blank != std::string::npos) text.replace(blank, 1, " * ");
  return text;
}

py::object from_pint(const std::string& key, const py::object& value, const Measure& measure) {
  const std::string unit = pint_unit(key, si_unit_of(measure.unit));
  try {
    const py::object si = unit.empty() ? value.attr("to_base_units")() : value.attr("to")(unit);
    return si.attr("magnitude");
  } catch (const py::error_already_set& error) {
    throw InputError(fmt::format("{}: expected {}, not {} ({})", key, dimension_name(parse_unit(measure.unit, 1.0)),
                                 py::str(value).cast<std::string>(), py::str(error.value()).cast<std::string>()));
  }
}

/// "; write 65" where the text is a quantity of that kind.
std::string number_meant(const std::string& text, const Measure& measure) {
  try {
    return fmt::format("; write {:.10g}", read_quantity(text, measure, 1.0));
  } catch (const InputError&) {
    return "";
  }
}

/// What an attribute takes, in words: "a number in m", "a text", "a ContactPair".
std::string expected(const py::object& self, const std::string& key, const Measures& measures) {
  if (const auto measured = measures.find(key); measured != measures.end()) {
    if (measured->second.whole) return "a whole number";
    const std::string unit = si_unit_of(measured->second.measure.unit);
    return unit == "-" ? "a number" : "a number in " + unit;
  }
  const py::object now = self.attr(key.c_str());
  if (now.is_none()) return "another value";
  if (py::isinstance<py::str>(now)) return "a text";
  if (py::isinstance<py::list>(now)) return "a list";
  return "a " + py::type::of(now).attr("__name__").cast<std::string>();
}

}  // namespace

void check_text(const std::string& key, const std::string& text) {
  if (find_control(text) != std::string::npos) throw InputError(key + ": a text has no control characters");
  if ((key == "name" || key == "label") && text.find_first_of("\n\r\t") != std::string::npos)
    throw InputError(key + ": a name is one line, without tabs");
}

py::object in_si(const std::string& key, const py::object& value, const Measures& measures) {
  const auto measured = measures.find(key);
  if (measured == measures.end()) return value;
  const Measure& measure = measured->second.measure;
  if (py::hasattr(value, "magnitude") && py::hasattr(value, "to_base_units")) return from_pint(key, value, measure);
  if (!py::isinstance<py::str>(value)) return value;
  const auto text = value.cast<std::string>();
  const std::string unit = si_unit_of(measure.unit);
  throw py::type_error(fmt::format("{}: expected a number{}, not the text '{}'{}", key,
                                   unit == "-" ? "" : " in " + unit, text, number_meant(text, measure)));
}

void set_attribute(const py::object& self, const std::string& key, const py::object& value,
                   const std::vector<std::string>& known, const Measures& measures) {
  if (!key.starts_with("_") && std::find(known.begin(), known.end(), key) == known.end())
    throw py::attribute_error(fmt::format("{} has no attribute '{}'{}",
                                          py::type::of(self).attr("__name__").cast<std::string>(), key,
                                          did_you_mean(key, known)));
  try {
    py::module_::import("builtins").attr("object").attr("__setattr__")(self, key, in_si(key, value, measures));
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError)) throw;
    throw py::type_error(fmt::format("{}: expected {}, not {}", key, expected(self, key, measures),
                                     py::repr(value).cast<std::string>()));
  }
}

void check_keywords(py::handle type, const py::kwargs& given, const std::vector<std::string>& known) {
  for (const auto& [key, value] : given)
    if (const auto name = key.cast<std::string>(); std::find(known.begin(), known.end(), name) == known.end())
      throw py::type_error(fmt::format("{} has no attribute '{}'{}", type.attr("__name__").cast<std::string>(), name,
                                       did_you_mean(name, known)));
}

void set_attributes(py::handle self, const py::kwargs& given, const std::vector<std::string>& known) {
  check_keywords(py::type::of(self), given, known);
  for (const auto& [key, value] : given) py::setattr(self, key, value);
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
