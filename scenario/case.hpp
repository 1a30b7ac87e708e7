// A case: the question which tire, on which soil, at which conditions, by which models. Its file format soilbin-case/1
// is described in docs/reference/case-files.md.
//
//   const Case question = read_case("rover.yaml", Library({"cases"}), bekker_wong::CatalogueVocabulary());
//   const Scenario seen = seen_by(question.study.models.front(), question.scenario);  // with the model's effects
//   for (const OperatingCondition& at : question.study.conditions) model.evaluate(seen, at);
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "scenario/description.hpp"
#include "scenario/drive.hpp"
#include "scenario/effect_vocabulary.hpp"
#include "scenario/library.hpp"
#include "scenario/scenario.hpp"
#include "scenario/source_text.hpp"

namespace soilbin {

/// The models that a study can ask.
enum class ModelKind { bekker_wong, dem, rft, cone_index };

constexpr std::array<Word<ModelKind>, 4> words_of(std::type_identity<ModelKind>) {
  return {{{"bekker_wong", ModelKind::bekker_wong},
           {"dem", ModelKind::dem},
           {"rft", ModelKind::rft},
           {"cone_index", ModelKind::cone_index}}};
}

/// A model and the effects that it is to show.
struct ModelChoice {
  ModelKind model = ModelKind::bekker_wong;
  std::vector<EffectChoice> effects;     ///< forms and parameters resolved; none for the discrete element model
  std::string label;                     ///< for tables and plots; by default made of the model and the effects' ids
  std::vector<FittedError> errors = {};  ///< where soil and effects come from a fit: how they err together
  Misfit misfit = {};                    ///< of that fit
};

/// Whether a fit made the model: it answers as it was fitted.
inline bool is_fitted(const ModelChoice& choice) { return !choice.errors.empty() || choice.misfit != Misfit{}; }

/// The scenario as one of the models is to see it.
Scenario seen_by(const ModelChoice& choice, Scenario scenario);

/// What is asked of the models.
struct Study {
  std::string name;
  std::vector<ModelChoice> models;
  std::vector<OperatingCondition> conditions;
  /// Each condition's speed of rotation [rad/s], from which it got its speed; none where the file gives the speed.
  /// With it a change of slip can keep the rotation. Empty where no file was read; write_case leaves it out.
  std::vector<std::optional<double>> rotations = {};
};

/// Whether a study asks a model.
bool asks(const Study& study, ModelKind kind);

/// A whole question: a study, a drive or both. `scenario.effects` is empty: effects belong to the study's models and to
/// the drive.
struct Case {
  std::string name;
  std::string description;
  std::string source;
  Scenario scenario;
  Study study;  ///< without conditions where the file has none
  std::optional<Drive> drive;
  /// Keys that were given on the command line: "speed" and other keys of a condition, "bin". Who gives them there wants
  /// them to matter, and is told where they don't. A tire and a soil keep theirs in `sources`.
  std::set<std::string> on_command_line{};
};

void describe(auto& v, std::type_identity<Case>) {
  v.text("name", &Case::name, Need::required, "what to call the case");
  v.text("description", &Case::description, Need::optional, "what is asked, and why");
  v.text("source", &Case::source, Need::optional, "where the question comes from");
}

inline std::string contradiction(const Case& c) { return c.name.empty() ? "the name is empty" : ""; }

inline constexpr const char* case_format = "soilbin-case/1";
inline constexpr const char* tire_format = "soilbin-tire/1";
inline constexpr const char* soil_format = "soilbin-soil/1";

/// The question of the analytic wheel alone, with the scenario's effects and what a fit says of its errors: seen_by
/// gives the scenario back. Its model has its label; without conditions.
Case question_of(Scenario scenario);

/// Labels the models that have no label: "bekker_wong + slip_sinkage + exit_angle". An id that stands in several forms
/// among the models is told with its form, "slip_sinkage:ding", so that no two forms look alike.
void label_models(std::vector<ModelChoice>& models);

/// Reads a case file. A tire or soil that it names is looked up beside the file, then in the library.
/// Throws InputError with file, line, column, excerpt and hint for everything that is not a valid case.
Case read_case(const std::filesystem::path& path, const Library& library, const EffectVocabulary& effects);

/// Reads a case from a text in memory; `source.file` is the path to which relative paths in it refer.
Case parse_case(const SourceText& source, const Library& library, const EffectVocabulary& effects);

/// Reads a tire file (soilbin-tire/1). A tire without a name gets the file's.
Tire read_tire(const std::filesystem::path& path);
Tire parse_tire(const SourceText& source);

/// Reads a soil file (soilbin-soil/1), or one of Chrono's SCM (scm_soil.hpp). One without a name gets the file's.
Soil read_soil(const std::filesystem::path& path);
Soil parse_soil(const SourceText& source);

/// The tire or soil that a person names: of the library, or a path to a YAML file (it holds a '/' or ends in .yaml).
/// Throws InputError with the nearest name.
Tire find_tire(const std::string& name, const Library& library);
Soil find_soil(const std::string& name, const Library& library);

/// The case with everything resolved: tire and soil written out, defaults filled in, each condition a mapping of its
/// own. Reading it gives the same case to the bit; writing that gives the same bytes.
std::string write_case(const Case& value, const EffectVocabulary& effects);
std::string write_tire(const Tire& tire);
std::string write_soil(const Soil& soil);

}  // namespace soilbin
