// The question that flags and, where there is one, a case file put together.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli/described_flags.hpp"
#include "cli/workplace.hpp"
#include "compare/doubts/declared_tire.hpp"
#include "compare/doubts/doubt.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::cli {

/// Adds an effect as a flag spells it: 'id[:form][,parameter=value...]', values with units. Form and parameters left
/// out are filled in. Throws InputError with the nearest right word, and for an effect that is among them already. The
/// soil's exponent is in some units.
void add_effect(std::vector<EffectChoice>& effects, const std::string& text, const EffectVocabulary& vocabulary,
                const Soil& soil);

/// The effects that the texts of --effect name, as add_effect takes each; "none" or "declared" alone: no effect. Throws
/// InputError.
std::vector<EffectChoice> effects_named(const std::vector<std::string>& texts, const EffectVocabulary& vocabulary,
                                        const Soil& soil);
/// Whether one of them says "none": then what the tire declares is left out too.
inline bool switch_effects_off(const std::vector<std::string>& texts) {
  return std::ranges::find(texts, "none") != texts.end();
}

/// Flags that pick or override a study's conditions. Each takes one value or several (several_values).
class ConditionFlags {
 public:
  /// `without`: keys that a command looks for and does not take.
  void add_to(CLI::App& app, const std::vector<std::string>& without = {}) {
    flags_.add_to(app, "Condition (several values: 0,10,20%, or 0%..60%, or 0%..60%:5% in steps)", "", without);
  }
  bool given(const std::string& key) const { return flags_.given(key); }
  /// More combinations of the values given than these are refused; most_conditions.
  void allow(std::size_t most) { most_ = most; }

  /// A condition for each combination of the values given, slip varying fastest. Throws InputError that names the flag.
  std::vector<OperatingCondition> conditions() const;

  /// For each combination of the values given, flag by flag: keeps the study's conditions that agree with it; where
  /// none does, sets it in all that are left. A condition that got its speed from a rotation keeps the rotation: its
  /// speed follows slip, yaw and the tire, unless the speed itself is given. Conditions that overriding makes equal are
  /// kept once. Throws InputError that names the flag, or says why there is no such speed.
  void pick(Case& question) const;

  /// The keys of a condition that were given as flags.
  std::set<std::string> given_keys() const;

 private:
  using Flags = DescribedFlags<OperatingCondition>;
  static Study picked(const Flags& flags, const Study& study, const Tire& tire);
  std::vector<Flags> combinations() const { return flags_.combinations("slip", most_); }

  Flags flags_;
  std::size_t most_ = most_conditions;
};

/// --no-assumed-sd: values of the soil whose standard deviation its file only assumes count as exact.
class ErrorFlag {
 public:
  void add_to(CLI::App& app) {
    app.add_flag("--no-assumed-sd", exact_, "soil values whose standard deviation is only assumed count as exact");
  }
  /// Where no standard deviation is only assumed, the question keeps the key "no_assumed_sd" of what was given for
  /// nothing.
  void apply(Case& question) const;

 private:
  bool exact_ = false;
};

/// --rigid and --no-lugs; without them a tire with a declared inflation pressure is flexible where it flattens, and one
/// with lugs has their thrust.
class TireFlags {
 public:
  void add_to(CLI::App& app) {
    app.add_flag("--rigid", left_out_.pressure, "a rigid wheel, whatever inflation pressure the tire declares")
        ->group("Model");
    app.add_flag("--no-lugs", left_out_.lugs, "a smooth wheel, whatever lugs the tire declares")->group("Model");
  }
  /// What to tell of it. `base_model`: every effect was switched off by name. Throws InputError for a
  /// question that names the effect of what is left out.
  compare::Doubts apply(Case& question, bool base_model = false) const {
    compare::TireLeftOut left_out = left_out_;
    left_out.effects = base_model;
    return compare::as_declared(question, left_out);
  }

 private:
  compare::TireLeftOut left_out_;
};

/// Models that answer in milliseconds.
inline constexpr std::array quick_models = {ModelKind::bekker_wong, ModelKind::rft, ModelKind::cone_index};

/// --model of a quick answer: the analytic wheel's, or one of its own.
class QuickModelFlag {
 public:
  void add_to(CLI::App& app) {
    add_value(app, "--model", model_, "NAME", "only this model: bekker_wong, rft or cone_index")->group("Model");
  }
  /// Leaves the question with the model that is asked for. Throws InputError for one that takes no effects, where
  /// `names_effects`.
  void apply(Case& question, bool names_effects) const;

 private:
  std::string model_;
};

/// The notes, then what is doubtful in the answers.
compare::Doubts joined_doubts(compare::Doubts notes, const Case& question,
                              const std::vector<compare::ModelAnswers>& study);

/// --soil where the analytic wheel is set beside grains: its values are that soil's, the grains stay the study's.
class AnalyticSoil {
 public:
  /// Puts the values into `soil`; leaves it where none is named. Throws InputError with the nearest right name.
  AnalyticSoil(const std::string& named, const Library& library, Soil& soil);

  /// What a title calls the soil: both, where grains stand beside values of another soil.
  std::string title(bool grains) const;

 private:
  std::string own_, values_of_;
};

/// Asks about another bed of a soil (scenario/beds.hpp) by the text of --density. Throws InputError that names the
/// flag.
void pick_bed(Soil& soil, const std::string& density);

/// Flags for a soil's own values: "--friction-angle 30deg", "--k-phi '1500+-200 kN/m^(n+2)'", named as in a soil file.
class SoilFlags {
 public:
  /// Adds a flag for each of soil_parameters, and --density.
  void add_to(CLI::App& app, const std::string& heading);

  bool any_given() const;
  /// What was given for a key of a soil file; "" for nothing.
  const std::string& text(const std::string& key) const { return texts_.at(key); }

  /// Puts the values that were given in place of the soil's; of a soil with beds, --density first picks the bed. A
  /// value without "+-" (or "±") keeps the soil's standard deviation. The soil's name then ends in ", changed", and the
  /// values' source is the command line. Throws InputError that names the flag, or says that the soil has values for
  /// grains alone.
  void apply(Soil& soil) const;

 private:
  void put_exact_values(Soil& soil) const;

  std::map<std::string, std::string> texts_;  ///< by the key of a soil file
};

/// The inputs of `estimate`, `explain` and `serve`: a case, or a tire, a soil and a condition given by flags; or both,
/// the flags then going before what the case says.
class Question {
 public:
  /// `needed`: keys of the condition that must be given where no case is; `without`: those that have no flag.
  explicit Question(CLI::App& app, std::vector<std::string> needed = {"load", "slip"},
                    const std::vector<std::string>& without = {});

  /// As ConditionFlags::allow.
  void allow_conditions(std::size_t most) { condition_.allow(most); }

  /// Throws InputError that names the flag that is missing or wrong.
  Case ask(const Workplace& place) const;
  /// Whether --effect was given; whether as '--effect none', which leaves out what the tire declares too, as
  /// '--effect declared' does not.
  bool names_effects() const { return !effects_.empty(); }
  bool switches_effects_off() const { return switch_effects_off(effects_); }

 private:
  Case from_flags(const Workplace& place) const;
  void override_tire(Tire& tire, const Workplace& place) const;

  std::vector<std::string> needed_;
  std::string case_name_, tire_, soil_;
  std::vector<std::string> effects_;
  DescribedFlags<Tire> wheel_;
  DescribedFlags<Lugs> lugs_;
  DescribedFlags<Bin> bin_;
  SoilFlags soil_values_;
  ConditionFlags condition_;
  ErrorFlag errors_;
};

/// Throws InputError where the analytic model is asked on a soil that has values for grains alone.
void require_semi_empirical(const Case& question, const Library& library);

/// Throws InputError where grains are to be run on a soil without them.
void require_grains(const Case& question, const Library& library);

/// The rows of an answer under the names of its tire and soil, with the whole question as a case file's text.
nlohmann::ordered_json document_of(const char* format, const Case& question, nlohmann::ordered_json rows,
                                   const EffectVocabulary& effects);

}  // namespace soilbin::cli
