// Findings of a publication as rows of a file: what it says, word by word, and the statistic that would show it.
// The format soilbin-findings/1 is described in docs/reference/findings.md.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "compare/measured/condition_views.hpp"
#include "scenario/description.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

enum class FindingQuantity { drawbar_pull, torque, sinkage, tractive_efficiency };

constexpr std::array<Word<FindingQuantity>, 4> words_of(std::type_identity<FindingQuantity>) {
  using Q = FindingQuantity;
  return {{{"drawbar_pull", Q::drawbar_pull},
           {"torque", Q::torque},
           {"sinkage", Q::sinkage},
           {"tractive_efficiency", Q::tractive_efficiency}}};
}

/// What a curve varies with.
enum class FindingAxis { load, slip, longitudinal_incline, transverse_incline, yaw };

constexpr std::array<Word<FindingAxis>, 5> words_of(std::type_identity<FindingAxis>) {
  using A = FindingAxis;
  return {{{"load", A::load},
           {"slip", A::slip},
           {"longitudinal_incline", A::longitudinal_incline},
           {"transverse_incline", A::transverse_incline},
           {"yaw", A::yaw}}};
}

/// The statistic whose interval is held against the claim.
enum class FindingTest {
  slope,             ///< of the line of weighted least squares
  curvature,         ///< departure from a line in mid-range, over the rise
  slope_difference,  ///< slope less that of the curve `against`
  slope_ratio,       ///< slope over that of the curve `against`
  peak,              ///< where the largest value is
  lowest,            ///< where the smallest is
  peak_shift,        ///< peak less that of the curve `against`
  change,            ///< slope times `step`, over the mean
  mean,              ///< mean value
  largest            ///< largest value
};

constexpr std::array<Word<FindingTest>, 10> words_of(std::type_identity<FindingTest>) {
  using T = FindingTest;
  return {{{"slope", T::slope},
           {"curvature", T::curvature},
           {"slope_difference", T::slope_difference},
           {"slope_ratio", T::slope_ratio},
           {"peak", T::peak},
           {"lowest", T::lowest},
           {"peak_shift", T::peak_shift},
           {"change", T::change},
           {"mean", T::mean},
           {"largest", T::largest}}};
}

/// Conditions whose axes lie in these ranges, ends included [SI].
using Where = std::map<FindingAxis, std::pair<double, double>>;

struct Finding {
  std::string id;
  std::string title;  ///< what is claimed, as a sentence; "" where the file has none
  std::string section;
  std::string quote;   ///< the publication's own words
  std::string study;   ///< of the library, whose conditions are looked at
  std::string chosen;  ///< what of the test isn't in the publication
  FindingQuantity quantity = FindingQuantity::drawbar_pull;
  FindingAxis along = FindingAxis::slip;
  FindingTest test = FindingTest::slope;
  Where where;      ///< the curve: means over all else at each value of `along`
  Where against;    ///< the other curve, where the test compares two
  double step = 0;  ///< of change [SI]
  double at_least = -std::numeric_limits<double>::infinity();  ///< the claim, in the statistic's unit [SI]
  double at_most = std::numeric_limits<double>::infinity();

  bool compares() const {
    return test == FindingTest::slope_difference || test == FindingTest::slope_ratio || test == FindingTest::peak_shift;
  }
};

template <class Visitor>
void describe(Visitor& v, std::type_identity<Finding>) {
  v.text("id", &Finding::id, Need::required, "a name of its own");
  v.text("title", &Finding::title, Need::optional, "what is claimed, as a sentence");
  v.text("section", &Finding::section, Need::required, "of the publication");
  v.text("quote", &Finding::quote, Need::required, "the publication's own words");
  v.text("study", &Finding::study, Need::required, "of the library, whose conditions are looked at");
  v.choice("quantity", &Finding::quantity, Need::required, "what the curve shows");
  v.choice("along", &Finding::along, Need::required, "what the curve varies with");
  v.choice("test", &Finding::test, Need::required, "the statistic that is held against the claim");
  v.text("chosen", &Finding::chosen, Need::optional, "what of the test isn't in the publication");
}

struct Findings {
  std::string name, source;
  double level = 0.95;     ///< of the intervals
  std::uint64_t seed = 1;  ///< of the bootstrap
  std::vector<Finding> all;
};

inline constexpr const char* findings_format = "soilbin-findings/1";

/// Throws InputError with file, line, column and hint.
Findings parse_findings(const SourceText& source);
Findings read_findings(const std::filesystem::path& path);

/// Where an axis stands in an operating condition, and its unit.
const ConditionView& view_of(FindingAxis axis);
Measure measure_of(FindingAxis axis);

}  // namespace soilbin::compare
