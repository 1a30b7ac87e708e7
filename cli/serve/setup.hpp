// What a served page starts from, and the questions that its queries turn it into. A query speaks the flags of
// `soilbin estimate`, and is read by the same code.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/question.hpp"
#include "cli/serve/query.hpp"
#include "cli/workplace.hpp"

namespace soilbin::cli {

/// A question of one condition, and the words that ask `soilbin` the same: {"estimate", "paper-straight",
/// "--slip=20%"}.
struct Asked {
  Case question;
  std::vector<std::string> words;
  bool base_model = false;  ///< every effect was switched off by name
  TireFlags tire;           ///< what of the tire is left out
};

/// Soils of the library that the analytic model can take.
nlohmann::ordered_json soils_json(const Library& library);

/// The model of a question of one, in words: "resistive force theory".
std::string model_of(const Case& question);

class Setup {
 public:
  /// Starts from a case (a name, a path, or "") and flags of `soilbin estimate`: at the first of its conditions whose
  /// slip is nearest to 20 %, with the effects of its first model, on the analytic one, and with those that its tire
  /// declares, as of any one model. Throws InputError as `soilbin estimate` does.
  /// `place` must outlive this.
  Setup(const Workplace& place, std::string case_name, std::vector<Flag> flags);

  /// The start with the query's flags in place of its own; a tire or soil that the query names comes without the
  /// start's changes to its values. Throws InputError: an unknown flag, a value that is wrong, a soil or tire that is
  /// not of the library (a query reads no file that it names), more than one condition.
  Asked ask(const std::vector<Flag>& query) const;

  /// soilbin-serve/1: the numbers that a page moves, tires, soils and effects; where each starts, and its limits.
  nlohmann::ordered_json document() const;

  const Workplace& place() const { return place_; }

  /// The unit of the page's slider of the load, by the start's load: N or kN.
  const std::string& force_unit() const { return force_unit_; }

 private:
  Asked put_together(const std::vector<Flag>& query) const;

  const Workplace& place_;
  std::string case_name_, force_unit_ = "N";
  std::vector<Flag> start_;  ///< flags that make a single condition of the case
};

}  // namespace soilbin::cli
