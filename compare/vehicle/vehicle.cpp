#include "compare/vehicle/vehicle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bekker_wong/presumption.hpp"
#include "scenario/effect_choices.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/named_parts.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {

std::string without_differentials(DriveLine line) {
  if (line == DriveLine::motors) return "the drive_line 'motors' has a motor a wheel and no differentials";
  if (line == DriveLine::sides) return "the drive_line 'sides' turns each side by itself and has no differentials";
  return "";
}

namespace {

/// Whether the wheels of a vehicle stand in more than one place along an axis.
bool spread(const std::vector<VehicleWheel>& wheels, double VehiclePoint::*axis) {
  return std::ranges::any_of(wheels, [&](const VehicleWheel& wheel) {
    return std::abs(wheel.place.*axis - wheels[0].place.*axis) > in_one_place;
  });
}

/// Whether the wheels stand in one slanting line: then nothing tells how the vehicle stands on it.
bool in_a_slanting_line(const std::vector<VehicleWheel>& wheels) {
  if (!spread(wheels, &VehiclePoint::x) || !spread(wheels, &VehiclePoint::y)) return false;
  const auto far = std::ranges::max_element(wheels, {}, [&](const VehicleWheel& wheel) {
    return std::hypot(wheel.place.x - wheels[0].place.x, wheel.place.y - wheels[0].place.y);
  });
  const double along = far->place.x - wheels[0].place.x, across = far->place.y - wheels[0].place.y;
  return std::ranges::all_of(wheels, [&](const VehicleWheel& wheel) {
    return std::abs((wheel.place.x - wheels[0].place.x) * across - (wheel.place.y - wheels[0].place.y) * along) < 1e-9;
  });
}

std::string contradiction_in_centre(const VehicleCase& vehicle) {
  if (!vehicle.centre_differential) return "";
  if (const std::string none = without_differentials(vehicle.drive_line); !none.empty())
    return none + ": leave out 'centre_differential', or say 'locked' or 'open_axles'";
  const auto driven = std::ranges::count(vehicle.axles, YesNo::yes, &VehicleAxle::driven);
  if (vehicle.has_open_centre() && driven != 2)
    return fmt::format(
        "an open centre_differential lies between two driven axles, and {} driven: drive two, or say 'locked'",
        driven == 1 ? "1 is" : fmt::format("{} are", driven));
  return "";
}

std::string contradiction_in(const VehicleAxle& axle, const VehicleCase& vehicle) {
  const bool motors = vehicle.drive_line == DriveLine::motors, driven = axle.driven == YesNo::yes;
  if (axle.motor && !motors)
    return fmt::format("axle '{}' has a motor, which belongs to the drive_line 'motors': give it to the vehicle",
                       axle.name);
  if (axle.motor && !driven) return fmt::format("axle '{}' has a motor and is not driven", axle.name);
  if (axle.motor && axle.largest_torque)
    return fmt::format("axle '{}' has a motor and a largest_torque: give one of the two", axle.name);
  if (axle.largest_steer && axle.steered == YesNo::no)
    return fmt::format("axle '{}' has a largest_steer and is not steered", axle.name);
  if (axle.largest_torque && !motors)
    return fmt::format("axle '{}' has a largest_torque, which belongs to the drive_line 'motors'", axle.name);
  if (axle.largest_torque && !driven) return fmt::format("axle '{}' has a largest_torque and is not driven", axle.name);
  if (axle.differential) {
    if (const std::string none = without_differentials(vehicle.drive_line); !none.empty())
      return fmt::format("{}: leave out 'differential' of axle '{}', or say 'locked' or 'open_axles'", none, axle.name);
    if (!driven) return fmt::format("axle '{}' has a differential and is not driven", axle.name);
    if (!axle.track)
      return fmt::format("axle '{}' has a differential and one wheel: give it a 'track', or leave it out", axle.name);
  }
  if (axle.torque_share && !vehicle.has_open_centre())
    return fmt::format("axle '{}' has a torque_share, which belongs to 'centre_differential: open' of the vehicle",
                       axle.name);
  if (axle.torque_share && !driven) return fmt::format("axle '{}' has a torque_share and is not driven", axle.name);
  if (std::ranges::count(vehicle.axles, axle.name, &VehicleAxle::name) > 1)
    return fmt::format("two axles are called '{}'", axle.name);
  return "";
}

VehicleAxle read_axle(const YamlNode& node, std::size_t number, const Library& library, const Reading& reading) {
  VehicleAxle axle = read_mapping<VehicleAxle>(node, reading, {"tire"});
  axle.tire =
      read_tire_part(*value_of(node, "tire", Need::required, "a mapping, a name of the library, or a path", reading),
                     library, reading);
  if (axle.name.empty()) axle.name = fmt::format("axle {}", number);
  return axle;
}

VehicleDrive read_vehicle_drive(const YamlNode& node, const Library& library, Reading reading) {
  const SoilReader soils = [&](const YamlNode& part, const Reading& at) { return read_soil_part(part, library, at); };
  reading.soils = &soils;
  return read_mapping<VehicleDrive>(node, reading);
}

}  // namespace

std::string contradiction(const VehicleDrive& drive) {
  Drive alike;
  alike.profile = drive.profile;
  for (const Waypoint& point : drive.profile)
    if (point.yaw != 0.0 || point.transverse_incline != 0.0)
      return "a vehicle is driven straight up or down: its way has no yaw and no transverse_incline";
  return contradiction(alike);
}

std::string contradiction(const VehicleCase& vehicle) {
  if (vehicle.axles.empty()) return "";  // they are read after the rest
  if (std::ranges::none_of(vehicle.axles, [](const VehicleAxle& axle) { return axle.driven == YesNo::yes; }))
    return "no axle is driven";
  const auto stiff = [](const VehicleAxle& axle) { return axle.stiffness.has_value(); };
  if (std::ranges::any_of(vehicle.axles, stiff) && !std::ranges::all_of(vehicle.axles, stiff))
    return "some axles have a stiffness and others none: give it for all, or for none";
  if (vehicle.motor && vehicle.drive_line == DriveLine::motors)
    return "the drive_line 'motors' has a motor a wheel: give 'motor' to the axles, not to the vehicle";
  for (const VehicleAxle& axle : vehicle.axles)
    if (const std::string wrong = contradiction_in(axle, vehicle); !wrong.empty()) return wrong;
  if (const std::string wrong = contradiction_in_centre(vehicle); !wrong.empty()) return wrong;
  if (in_a_slanting_line(wheels_of(vehicle))) return "all wheels stand in one slanting line, on which nothing stands";
  return "";
}

VehicleCase parse_vehicle_case(const SourceText& source, const Library& library, const EffectVocabulary& effects) {
  const YamlNode document = parse_yaml(source);
  Reading reading{&source, std::nullopt, nullptr, ""};
  expect_format(document, vehicle_case_format, reading);
  VehicleCase vehicle = read_mapping<VehicleCase>(document, reading, {"format", "axles", "soil", "effects", "drive"});
  const Library near = library.beside(source.file);
  const YamlNode& soil =
      *value_of(document, "soil", Need::required, "a mapping, a name of the library, or a path", reading);
  vehicle.soil = read_soil_part(soil, near, reading);
  if (!vehicle.soil.semi_empirical)
    reading.refuse(soil, fmt::format("a vehicle needs the soil's 'semi_empirical' section; '{}' has none",
                                     clipped(vehicle.soil.name)));
  reading.n = vehicle.soil.semi_empirical->exponent.value;
  const YamlNode& axles = *value_of(document, "axles", Need::required, "list of axles", reading);
  if (!axles.is_sequence()) reading.refuse(axles, "expected a list of axles, not " + axles.kind_name());
  for (const YamlNode& axle : axles.items)
    vehicle.axles.push_back(read_axle(axle, vehicle.axles.size() + 1, near, reading));
  if (vehicle.axles.empty()) reading.refuse(axles, "the list of axles is empty");
  if (const YamlNode* list = value_of(document, "effects", Need::optional, "list of effects; [] for none", reading))
    vehicle.effects = read_effects(*list, effects, reading);
  if (const YamlNode* drive = value_of(document, "drive", Need::optional, "how it is driven in time", reading))
    vehicle.drive = read_vehicle_drive(*drive, near, reading);
  for (std::size_t i = 0; i < vehicle.axles.size(); ++i)
    if (const std::string wrong = contradiction_in(vehicle.axles[i], vehicle); !wrong.empty())
      reading.refuse(axles.items[i], wrong);
  if (const std::string wrong = contradiction_in_centre(vehicle); !wrong.empty())
    reading.refuse(*document.find("centre_differential"), wrong);
  if (const std::string wrong = contradiction(vehicle); !wrong.empty()) reading.refuse(axles, wrong);
  return vehicle;
}

std::string write_vehicle_case(const VehicleCase& vehicle, const EffectVocabulary& effects) {
  YamlLines lines;
  lines.value("format", vehicle_case_format);
  Writing writing{&lines, std::nullopt, nullptr, ""};
  write_members(vehicle, writing);
  lines.open("axles");
  for (const VehicleAxle& axle : vehicle.axles) {
    lines.open_item();
    write_members(axle, writing);
    write_group("tire", axle.tire, lines);
    lines.close();
  }
  lines.close();
  write_group("soil", vehicle.soil, lines);
  std::optional<double> n;
  if (vehicle.soil.semi_empirical) n = vehicle.soil.semi_empirical->exponent.value;
  write_effects(vehicle.effects, effects, n, lines);
  write_group("drive", vehicle.drive, lines);
  return lines.text();
}

VehicleCase find_vehicle_case(const std::string& name, const Library& library, const EffectVocabulary& effects) {
  return parse_vehicle_case(read_source_text(find_file(library, Shelf::vehicles, name), largest_yaml), library,
                            effects);
}

std::vector<VehicleWheel> wheels_of(const VehicleCase& vehicle) {
  std::vector<VehicleWheel> wheels;
  for (std::size_t i = 0; i < vehicle.axles.size(); ++i) {
    const VehicleAxle& axle = vehicle.axles[i];
    const auto add = [&](const std::string& name, double y) {
      wheels.push_back({name, i, {axle.x, y, axle.tire.radius}, {axle.tire, vehicle.soil, {}, vehicle.effects}});
    };
    if (axle.track) {
      add(axle.name + " left", axle.y + *axle.track / 2);
      add(axle.name + " right", axle.y - *axle.track / 2);
    } else {
      add(axle.name, axle.y);
    }
  }
  std::ranges::stable_sort(wheels, [](const VehicleWheel& a, const VehicleWheel& b) { return a.place.x > b.place.x; });
  for (VehicleWheel& wheel : wheels)
    for (std::size_t i = 0; i < wheels.size(); ++i)
      if (const VehicleWheel& before = wheels[i];
          before.place.x > wheel.place.x + in_one_place &&
          std::abs(before.place.y - wheel.place.y) < before.scenario.tire.width / 2)
        wheel.in_rut_of.push_back(i);
  return wheels;
}

Doubts declare_tires(std::vector<VehicleWheel>& wheels, const TireLeftOut& left_out) {
  Doubts told;
  for (VehicleWheel& wheel : wheels) {
    Case question = question_of(wheel.scenario);
    question.study.conditions.push_back({.load = 1.0, .pass = wheel.pass()});
    Doubts doubts = as_declared(question, left_out);
    wheel.scenario.tire = question.scenario.tire;
    wheel.scenario.effects = question.study.models.front().effects;
    for (Doubt& doubt : doubts)
      if (std::ranges::find(told, doubt) == told.end()) told.push_back(std::move(doubt));
  }
  return told;
}

std::vector<DoubtfulNumber> doubtful_numbers(const Soil& of) {
  std::vector<DoubtfulNumber> all;
  const SemiEmpiricalSoil& soil = *of.semi_empirical;
  for (const SoilParameter& p : soil_parameters)
    if (const Estimate& value = soil.*p.value; value.std_error > 0.0)
      all.push_back({value.value, value.std_error, p.range,
                     [&p, n = soil.exponent.value](Scenario& scenario, double x) {
                       move_value(*scenario.soil.semi_empirical, p, x, n);
                     },
                     p.title});
  return all;
}

namespace {

/// What a tire's carcass is known by, whatever its inflation.
auto carcass_of(const Tire& tire) {
  const Estimate pressure = tire.carcass_pressure.value_or(Estimate{});
  return std::tuple(tire.name, tire.radius, tire.width, pressure.value, pressure.std_error);
}

/// "carcass pressure of 11.00 R20"; by its wheel where other tires have the same name, or it has none.
std::string carcass_title(const VehicleWheel& wheel, const std::vector<VehicleWheel>& wheels) {
  const Tire& tire = wheel.scenario.tire;
  const bool named = !tire.name.empty() && std::ranges::all_of(wheels, [&](const VehicleWheel& other) {
    return other.scenario.tire.name != tire.name || carcass_of(other.scenario.tire) == carcass_of(tire);
  });
  return "carcass pressure of " + (named ? tire.name : "the tire " + wheel.name);
}

}  // namespace

std::vector<DoubtfulNumber> doubtful_carcasses(const std::vector<VehicleWheel>& wheels) {
  std::vector<DoubtfulNumber> all;
  std::vector<decltype(carcass_of({}))> told;
  for (const VehicleWheel& wheel : wheels) {
    const Tire& tire = wheel.scenario.tire;
    const auto carcass = carcass_of(tire);
    if (std::ranges::find(told, carcass) != told.end()) continue;
    told.push_back(carcass);
    if (bekker_wong::errs_by_carcass(tire, wheel.scenario.effects))
      all.push_back({tire.carcass_pressure->value, tire.carcass_pressure->std_error, zero_or_more,
                     [carcass](Scenario& scenario, double x) {
                       if (carcass_of(scenario.tire) == carcass) scenario.tire.carcass_pressure->value = x;
                     },
                     carcass_title(wheel, wheels)});
  }
  return all;
}

std::vector<DoubtfulNumber> doubtful_numbers(const std::vector<VehicleWheel>& wheels) {
  std::vector<DoubtfulNumber> all = doubtful_numbers(wheels.front().scenario.soil);
  std::ranges::move(doubtful_carcasses(wheels), std::back_inserter(all));
  return all;
}

}  // namespace soilbin::compare
