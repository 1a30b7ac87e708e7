// The difference between two sides in one channel at one condition, with its standard error.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "compare/discrepancy/side.hpp"

namespace soilbin::compare {

/// What can be said of a difference d with standard error u, where one run of the reference scatters by s and k is
/// counting_errors.
enum class DifferenceFinding {
  difference,      ///< |d| > s and |d| > k u
  within_scatter,  ///< |d| <= s: smaller than what another run of the reference would move; not called a difference
  within_errors,   ///< s < |d| <= k u: the two sides' uncertainties cover it
  not_judged,      ///< neither side states any doubt, or both share theirs: a number without a verdict
};
std::string_view word(DifferenceFinding finding);
/// For people: "difference", "within the scatter", ...
std::string_view words(DifferenceFinding finding);

/// Standard errors beyond which a difference counts. Known errors: 2, which one row in twenty reaches by chance. Errors
/// estimated with few degrees of freedom: as many as chance reaches as seldom, of Student's t (2.13 at 21, 2.87
/// at 4, 14 at 1).
double counting_errors(double freedom);

/// Degrees of freedom of the root of two errors' squares, after Welch (1947) and Satterthwaite (1946); infinite where
/// both are known.
double joined_freedom(double a, double freedom_a, double b, double freedom_b);

/// What is compared: one side against another, in one channel.
struct ComparedChannel {
  std::size_t side = 0, reference = 0;  ///< of Comparison::sides
  std::size_t channel = 0;              ///< of channel_views

  bool is_of(const ComparedChannel& other) const {
    return side == other.side && reference == other.reference && channel == other.channel;
  }
};

/// At one condition [SI].
struct Difference : ComparedChannel {
  std::size_t condition = 0;  ///< of the study
  Estimate value, reference_value;
  double scatter = 0.0;     ///< of one run of the reference, or of the side where that one scatters more
  double difference = 0.0;  ///< value less reference value
  double std_error = 0.0;   ///< root of the sum of both standard errors' squares
  /// Degrees of freedom behind that error, of both sides by Welch and Satterthwaite; infinite where both are known.
  double freedom = std::numeric_limits<double>::infinity();
  double share = 0.0;  ///< of the load W: forces over W, torque over W r, sinkage over r
  double sigma = 0.0;  ///< difference over its standard error; NaN where that is 0
  DifferenceFinding finding = DifferenceFinding::not_judged;
};

/// `freedom`: of the standard error.
DifferenceFinding finding_of(double difference, double std_error, double scatter,
                             double freedom = std::numeric_limits<double>::infinity());

/// Standard errors add in squares, but for two analytic models, which share the soil's doubt: their rows have none and
/// are not judged. Each channel that both points speak of and that is not zero on both sides throughout (no lateral
/// force).
std::vector<Difference> differences(const std::vector<Side>& sides, std::size_t side, std::size_t reference,
                                    const std::vector<OperatingCondition>& conditions, const Tire& tire);

}  // namespace soilbin::compare
