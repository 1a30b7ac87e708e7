// Warnings on several studies and campaigns together: each doubt once, with the names of all that it applies to.
//
//   NamedDoubts named;
//   for (...) named.add(question.study.name, question, study);
//   print_warnings(named.all());  // "paper-straight, paper-transverse: the tire's lugs change nothing: ..."
//
// Studies of the same wheel on the same grains differ only in the figures of the doubt about coarse grains: it is given
// once, with the worst figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/sweep/answers.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

class NamedDoubts {
 public:
  /// Those of a study and its answers.
  void add(const std::string& name, const Case& question, const std::vector<ModelAnswers>& study);
  /// Those that somebody else has found.
  void add(const std::string& name, const Doubts& doubts);
  /// In the order in which they came, each with its names (Doubt::of).
  Doubts all() const;

 private:
  struct OnGrains {
    Scenario scenario;
    std::vector<ModelAnswers> study;  ///< of all that share the doubt
  };
  struct Entry {
    Doubt doubt;
    std::optional<OnGrains> grains;  ///< the doubt is made from these
  };
  std::vector<Entry> entries_;
};

}  // namespace soilbin::compare
