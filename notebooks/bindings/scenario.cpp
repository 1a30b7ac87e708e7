// scenario/: what a question is made of.
#include "notebooks/bindings/scenario.hpp"

#include "bekker_wong/effect.hpp"
#include "compare/report/number_text.hpp"
#include "notebooks/bindings/fields.hpp"
#include "scenario/beds.hpp"
#include "scenario/case.hpp"
#include "scenario/drive.hpp"
#include "scenario/errors.hpp"

namespace soilbin::python {

EffectChoice effect_of(const EffectName& named) {
  if (const auto* choice = std::get_if<EffectChoice>(&named)) return *choice;
  const auto& text = std::get<std::string>(named);
  const auto colon = text.find(':');
  EffectChoice choice{text.substr(0, colon), colon == std::string::npos ? "" : text.substr(colon + 1), {}};
  bekker_wong::find_form(choice);
  return choice;
}

std::vector<EffectChoice> effects_of(const std::vector<EffectName>& named) {
  std::vector<EffectChoice> effects;
  for (const EffectName& name : named) effects.push_back(effect_of(name));
  return effects;
}

Tire tire_of(const TireName& named) {
  if (const auto* tire = std::get_if<Tire>(&named)) return *tire;
  return find_tire(std::get<std::string>(named), cases_library());
}

Soil soil_of(const SoilName& named) {
  if (const auto* soil = std::get_if<Soil>(&named)) return *soil;
  return find_soil(std::get<std::string>(named), cases_library());
}

namespace {

void bind_estimate(py::module_& module) {
  py::class_<Estimate> estimate(module, "Estimate",
                                "A number and its standard error (of an input: its standard deviation), in the same "
                                "unit. std_error 0: taken as exact. A plain number does where one is asked for.");
  estimate.def(py::init([](double value, double std_error) {
                 if (!(std_error >= 0.0)) throw InputError(fmt::format("std_error: {} is not 0 or more", std_error));
                 return Estimate{value, std_error};
               }),
               py::arg("value"), py::arg("std_error") = 0.0);
  estimate.def_readwrite("value", &Estimate::value);
  estimate.def_readwrite("std_error", &Estimate::std_error, "at least 0");
  estimate.def("__float__", [](const Estimate& e) { return e.value; });
  estimate.def("__repr__", [](const Estimate& e) { return "Estimate(" + compare::number(e) + ")"; });
  estimate.def("__str__", [](const Estimate& e) { return compare::number(e); });
  py::implicitly_convertible<double, Estimate>();
  py::implicitly_convertible<py::int_, Estimate>();
}

void bind_tire_and_soil(py::module_& module) {
  bind_words<LugPattern>(module, "LugPattern", "How the lugs run across the tread.");
  bind_words<Construction>(module, "Construction",
                           "How the plies of a tire run; the model cone_index alone asks for it.");
  bind_described<Lugs>(module, "Lugs", "Lugs of a tire or grousers of a rover wheel.");
  bind_described<TireDeflection>(module, "TireDeflection",
                                 "One row of a tire maker's load-deflection table, on firm flat ground.");
  bind_described<DeflectionTable>(module, "DeflectionTable", "A tire maker's load-deflection table.");
  bind_described<Tire>(module, "Tire",
                       "A wheel as the soil meets it. Radius and width are those of the tread base, without lugs.");
  bind_described<SemiEmpiricalSoil>(module, "SemiEmpiricalSoil",
                                    "Values of the Bekker / Wong-Reece model, each an Estimate. Pressure "
                                    "under a plate of smaller width b at depth z: p = (k_c/b + k_phi) z^n.");
  bind_described<ContactPair>(module, "ContactPair", "Contact of two materials in the discrete element model.");
  bind_words<RollingResistance>(module, "RollingResistance", "How grains resist rolling (docs/theory/dem-laws.md).");
  bind_words<TwistingResistance>(module, "TwistingResistance", "How grains resist twisting (docs/theory/dem-laws.md).");
  bind_words<GrainCohesion>(module, "GrainCohesion", "How grains pull each other together (docs/theory/dem-laws.md).");
  bind_words<GrainShape>(module, "GrainShape", "What a grain is made of: a sphere, or several joined for good.");
  bind_described<GrainFraction>(module, "GrainFraction",
                                "Grains of one size among others, by their share of the mass.");
  bind_described<GranularSoil>(module, "GranularSoil",
                               "A soil as grains: radii uniform between two bounds, or fractions of one size each.");
  bind_described<ResistiveForceSoil>(module, "ResistiveForceSoil",
                                     "A soil as resistive force theory knows it (model rft).");
  bind_described<Soil>(module, "Soil", "A soil, by what each model needs of it.");
  bind_described<Bin>(module, "Bin", "Inner measures of the soil bin; only some effects ask for them.");
}

void bind_condition(py::module_& module) {
  bind_words<SlipBy>(module, "SlipBy", "The speed from which slip is computed where the wheel is yawed.");
  bind_words<ForceFrame>(module, "ForceFrame", "Axes in which drawbar pull and lateral force are given.");
  bind_described<OperatingCondition>(module, "OperatingCondition",
                                     "What the wheel is asked to do. Signs: docs/reference/conventions.md.");
}

void bind_effects(py::module_& module) {
  using bekker_wong::EffectForm;
  using bekker_wong::EffectParameter;
  py::class_<EffectChoice>(module, "EffectChoice", "An effect switched on: its id, its form, its parameters in SI.")
      .def(py::init([](const std::string& id, const std::string& form, const py::kwargs& parameters) {
             EffectChoice choice{id, form, parameters.cast<std::map<std::string, double>>()};
             bekker_wong::make_effect(choice);  // refuses what is unknown or out of bounds
             return choice;
           }),
           py::arg("id"), py::arg("form") = "",
           "form '': the effect's first. Parameters by name, SI; those left out keep the form's defaults. Raises "
           "InputError with the nearest right word.")
      .def_readonly("id", &EffectChoice::id)
      .def_readonly("form", &EffectChoice::form)
      .def_readonly("parameters", &EffectChoice::parameters, "by name, SI")
      .def("__repr__", [](const EffectChoice& c) {
        std::string text = "'" + c.id + "'" + (c.form.empty() ? "" : ", '" + c.form + "'");
        for (const auto& [name, value] : c.parameters) text += fmt::format(", {}={:.6g}", name, value);
        return "EffectChoice(" + text + ")";
      });
  py::class_<EffectParameter>(module, "EffectParameter", "A parameter of an effect's form.")
      .def_readonly("name", &EffectParameter::name)
      .def_readonly("unit", &EffectParameter::unit, "as in files; the numbers here are SI")
      .def_readonly("default", &EffectParameter::fallback)
      .def_readonly("lower", &EffectParameter::lower)
      .def_readonly("upper", &EffectParameter::upper)
      .def_readonly("meaning", &EffectParameter::meaning);
  py::class_<EffectForm>(module, "EffectForm",
                         "One form of an effect: as published, after a source, or ours; its source says which.")
      .def_readonly("id", &EffectForm::id)
      .def_readonly("form", &EffectForm::form)
      .def_readonly("equation", &EffectForm::equation)
      .def_readonly("source", &EffectForm::source, "paper and equation")
      .def_readonly("parameters", &EffectForm::parameters,
                    "the first is the amplitude: at 0 the form is the base model")
      .def("__repr__", [](const EffectForm& f) { return "EffectForm(" + f.id + ":" + f.form + ")"; });
  module.def("effect_catalogue", &bekker_wong::effect_catalogue, "Every form of every effect.");
}

void bind_drive_words(py::module_& module) {
  bind_described<Controller>(module, "Controller",
                             "What turns the wheel: a motor that holds a rim speed or one that gives a torque. "
                             "Exactly one of the two is given.");
  bind_described<Waypoint>(module, "Waypoint",
                           "A place along the way. Angles and drawbar load go linearly from one to the next; a "
                           "soil holds from its place on.");
  py::class_<Drive> drive(module, "Drive",
                          "A wheel with mass and inertia, driven from rest (docs/theory/driven-wheel.md).");
  drive.def_property("effects", &effects_in<Drive>, &set_effects<Drive>, effects_meaning);
  described(drive, {"effects"});
}

void bind_cases(py::module_& module) {
  py::class_<Scenario>(module, "Scenario", "Everything but the operating condition.")
      .def(py::init([](const TireName& tire, const SoilName& soil, const std::optional<Bin>& bin,
                       const std::vector<EffectName>& effects) {
             return Scenario{tire_of(tire), soil_of(soil), bin, effects_of(effects)};
           }),
           py::arg("tire"), py::arg("soil"), py::arg("bin") = std::nullopt,
           py::arg("effects") = std::vector<EffectName>{},
           "Tire and soil: values, names of the library, or paths of YAML files. Effects: ids, 'id:form' or "
           "EffectChoice. Raises InputError with the nearest name.")
      .def_readwrite("tire", &Scenario::tire)
      .def_readwrite("soil", &Scenario::soil)
      .def_readwrite("bin", &Scenario::bin)
      .def_property("effects", &effects_in<Scenario>, &set_effects<Scenario>, effects_meaning)
      .def(
          "with_effects",
          [](Scenario s, const std::vector<EffectName>& effects) {
            set_effects(s, effects);
            return s;
          },
          py::arg("effects"), "A copy with these effects in place of its own.")
      .def("__copy__", [](const Scenario& s) { return s; })
      .def("__deepcopy__", [](const Scenario& s, const py::dict&) { return s; })
      .def("__repr__", [](const Scenario& s) { return fmt::format("Scenario({} on {})", s.tire.name, s.soil.name); });
  bind_words<ModelKind>(module, "ModelKind", "The models that a study can ask.");
  py::class_<ModelChoice>(module, "ModelChoice", "A model and the effects that it is to show.")
      .def_readonly("model", &ModelChoice::model)
      .def_readonly("effects", &ModelChoice::effects)
      .def_readonly("label", &ModelChoice::label);
  py::class_<Study>(module, "Study", "What is asked of the models.")
      .def_readonly("name", &Study::name)
      .def_readonly("models", &Study::models)
      .def_readwrite("conditions", &Study::conditions, "assign a new list to change them");
  py::class_<Case>(module, "Case", "A whole question: a study, a drive or both.")
      .def_readonly("name", &Case::name)
      .def_readonly("description", &Case::description)
      .def_readonly("source", &Case::source)
      .def_readonly("scenario", &Case::scenario, "without effects: these belong to the study's models and the drive")
      .def_readonly("study", &Case::study, "without conditions where the file has none")
      .def_readwrite("drive", &Case::drive)
      .def(
          "yaml", [](const Case& c) { return write_case(c, effect_vocabulary()); }, "The resolved case as YAML.")
      .def("__copy__", [](const Case& c) { return c; })
      .def("__deepcopy__", [](const Case& c, const py::dict&) { return c; })
      .def("__repr__", [](const Case& c) { return "Case('" + c.name + "')"; });
}

}  // namespace

void bind_scenario(py::module_& module) {
  bind_estimate(module);
  bind_tire_and_soil(module);
  bind_condition(module);
  bind_effects(module);
  bind_drive_words(module);
  bind_cases(module);
  module.def("cases_folders", &cases_folders, "Folders that are searched for cases: $SOILBIN_CASES first.");
  bind_library(module);
}

void bind_library(py::module_& module) {
  py::enum_<Shelf> shelves(module, "Shelf", "The folders of a library of cases.");
  for (const Shelf shelf : all_shelves) shelves.value(std::string(folder_of(shelf)).c_str(), shelf);
  module.def(
      "names", [](Shelf shelf) { return cases_library().names(shelf); }, py::arg("shelf"),
      "Every name on a shelf of the library, sorted.");
  module.def(
      "find_tire", [](const std::string& name) { return find_tire(name, cases_library()); }, py::arg("name"),
      "A tire of the library, or of a YAML file (a path holds '/' or ends in .yaml). Raises InputError with file, line "
      "and the nearest name.");
  module.def(
      "find_soil", [](const std::string& name) { return find_soil(name, cases_library()); }, py::arg("name"),
      "A soil of the library, or of a YAML file. Raises InputError.");
  module.def(
      "at_density",
      [](Soil soil, double density) {
        set_density(soil, density);
        return soil;
      },
      py::arg("soil"), py::arg("density"),
      "The soil with the values of a bed of this dry density [kg/m^3], interpolated between its `beds`. Raises "
      "InputError farther beyond them than they reach, and for a soil without beds.");
  module.def(
      "find_case",
      [](const std::string& name) {
        const Library library = cases_library();
        return read_case(find_file(library, Shelf::studies, name), library, effect_vocabulary());
      },
      py::arg("name"), "A study of the library, or of a YAML file. Raises InputError.");
  module.def(
      "parse_case",
      [](const std::string& text, const std::string& file) {
        return parse_case(make_source_text(text, file), cases_library(), effect_vocabulary());
      },
      py::arg("text"), py::arg("file") = "case.yaml",
      "A case from its YAML; `file` is what errors name and where relative paths start. Raises InputError.");
  module.def("write_tire", &write_tire, py::arg("tire"), "The tire as a YAML file's text.");
  module.def("write_soil", &write_soil, py::arg("soil"), "The soil as a YAML file's text.");
}

}  // namespace soilbin::python
