// What a form of an effect takes for a value of the tire that it reads and the tire does not declare.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.hpp"
#include "scenario/tire.hpp"

namespace soilbin::bekker_wong {

struct EffectForm;

/// A value of the tire that an effect reads and a tire may leave out. The effect reads it by this alone, so that what
/// it takes instead can be stated wherever the effect is.
struct Presumption {
  std::string_view key;                            ///< of tire files: "lugs.height"
  std::string_view name;                           ///< for people: "lug height"
  std::string_view unit;                           ///< as in files; "-" for a count
  std::string_view rule;                           ///< what is taken instead: "5 % of the radius"
  std::optional<double> (*declared)(const Tire&);  ///< [SI]; nothing where the tire leaves it out
  double (*presumed)(const Tire&);                 ///< [SI]
  std::string_view else_do = {};                   ///< for a tire that has none of it: "leave the effect out ..."

  /// What the effect reads: the declared value, else the presumed one [SI].
  double operator()(const Tire& tire) const;
};

/// A value that a form takes although this tire does not declare it.
struct Presumed {
  std::string key;
  double value = 0.0;   ///< [SI]
  std::string words;    ///< "lug height = 12.5 mm (5 % of the radius)"
  std::string else_do;  ///< of its presumption
};

/// All that a form presumes of this tire; empty where the tire declares whatever the form reads.
std::vector<Presumed> presumed(const EffectForm& form, const Tire& tire);

/// Whether the tire's carcass pressure has a standard deviation that these effects make felt.
bool errs_by_carcass(const Tire& tire, const std::vector<EffectChoice>& effects);

/// What these choices presume of the tire, one sentence an effect: "lug thrust presumes lug height = 12.5 mm (5 % of
/// the radius), which the tire does not declare." Throws InputError as find_form.
std::vector<std::string> presumptions(const std::vector<EffectChoice>& choices, const Tire& tire);

}  // namespace soilbin::bekker_wong
