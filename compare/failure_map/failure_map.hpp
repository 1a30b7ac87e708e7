// Where one model can stand for another: a map of their difference over conditions, learnt from few runs of both, its
// boundary, and sentences that each rest on a row of the map.
//
//   const FailureQuestion question{.name = "straight", .factors = {{"load", 2000, 8000, "N"}, {"slip", 0.05, 0.6}},
//                                  .difference = difference, .tolerance = 0.1};  // of the load
//   FailureMap map = map_failures(question, {.first = 24});
//   if (const auto clause = agreement(question, map, {Role::limited, Role::whole})) fmt::print("up to {}\n",
//   clause->upper[0]);
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/design/factor.hpp"
#include "compare/design/gaussian_process.hpp"
#include "compare/recorded/watch.hpp"
#include "scenario/description.hpp"

namespace soilbin::compare {

/// A share of the load at a condition, and its standard error: by how much two models' pulls differ there, or how far
/// that is off for the size of the grains.
using PullDifference = std::function<std::optional<Estimate>(const Eigen::VectorXd& values)>;

/// What is compared: one kind of incline, say, over load, lug height, angle and slip. Several kinds are several
/// questions.
struct FailureQuestion {
  std::string name;             ///< "longitudinal incline"
  std::vector<Factor> factors;  ///< values in SI
  PullDifference difference;    ///< nothing where either model has no answer
  /// The difference less that from infinitely fine grains; nothing where it is not known. Empty: known nowhere.
  PullDifference resolution_error{};
  double tolerance = 0.10;  ///< share of the load beyond which the models disagree
  /// Whether differences that were asked for are still to come from elsewhere: then no other is asked for.
  std::function<bool()> waits = [] { return false; };
  /// Called again and again while the map is learnt and searched; may throw to stop.
  std::function<void()> look = [] {};
};

struct FailureMapOptions {
  int first = 24;        ///< runs of the maximin Latin hypercube
  int at_boundary = 16;  ///< further runs, each where the boundary may be (straddle)
  /// Size of a batch: after its first run the others are chosen as if the surrogate's predictions at the places before
  /// had been measured, its hyperparameters held (kriging believer; Ginsbourger, Le Riche and Carraro
  /// 2010, Kriging is well-suited to parallelize optimization). 1: each is chosen when the one before is known.
  int at_once = 1;
  std::uint64_t seed = 1;
  int cloud = 2000;  ///< points among which these are chosen
  Watch watch{};     ///< of each run: "condition 3 of 36"
};

/// A condition that was run.
struct FailureRow {
  Eigen::VectorXd values;                      ///< [SI]
  std::optional<Estimate> difference;          ///< of both models; nothing where one has no answer
  std::optional<Estimate> resolution_error{};  ///< it less that from infinitely fine grains, where that is known
  bool beyond(double tolerance) const;         ///< |difference| above the tolerance and above 2 standard errors
};

/// What a map says of two models at a condition.
enum class Judged { agree, differ, undecided };
constexpr std::array<Word<Judged>, 3> words_of(std::type_identity<Judged>) {
  return {{{"agree", Judged::agree}, {"differ", Judged::differ}, {"undecided", Judged::undecided}}};
}

struct FailureMap {
  std::uint64_t seed = 1;  ///< of its surrogates
  std::vector<FailureRow> rows{};
  std::optional<Surrogate> surrogate{};         ///< of all rows with an answer, once they are run
  LeaveOneOut held_out{};                       ///< the surrogate's own test, in shares of the load
  std::optional<Surrogate> resolution_error{};  ///< none where too few rows know theirs
  /// Difference at values of the factors, as the surrogate has it.
  Estimate at(const FailureQuestion& question, const Eigen::VectorXd& values) const;
  /// at() less the resolution error: the difference from infinitely fine grains; at() alone where no row knows it.
  Estimate at_fine(const FailureQuestion& question, const Eigen::VectorXd& values) const;
  /// Whether the models agree to the tolerance, or differ by more, with one-sided confidence 95 %, against the grains
  /// as they are and against infinitely fine ones alike. Where the two don't say the same, the grains are too coarse
  /// for a decision.
  Judged judged(const FailureQuestion& question, const Eigen::VectorXd& values) const;
  /// Largest |difference| that is to be reckoned with there: the upper end of one-sided 95 %, of both kinds of grains.
  double largest_at(const FailureQuestion& question, const Eigen::VectorXd& values) const;
};

/// Throws NoSolution where too few conditions have an answer of both models. Where the question waits, after all
/// `first` runs or one batch, the map is not finished.
FailureMap map_failures(const FailureQuestion& question, const FailureMapOptions& options = {});

/// What the box does with a factor.
enum class Role {
  limited,  ///< "up to ...": the box reaches from the lower bound to a limit that is sought
  bounded,  ///< "from ... to ...": both ends are sought
  held,     ///< at its lower bound: "without lugs"
  whole,    ///< over all of its range, not mentioned
};

/// The largest box of conditions in which the models agree, and what it rests on.
struct AgreementClause {
  std::vector<Role> roles;                   ///< of each factor
  std::vector<double> lower, upper;          ///< of each factor [SI]
  int rows = 0;                              ///< that were run in the box
  double largest = 0.0;                      ///< |difference| among them, share of the load
  std::optional<Eigen::VectorXd> witness{};  ///< the row with it
};

/// The box of the largest share of the limited and bounded factors' ranges in which the models are judged to agree
/// (FailureMap::judged) at every node of a grid of `nodes` a factor. roles: one a factor.
/// The box's most doubtful node is run (and added to the map) and the box found again, until that node is a row that
/// agrees, at most `rounds` times: so a clause rests on the row that was likeliest to overturn it. Nothing where there
/// is no such box (of limited factors: where the models may disagree in the lower corner), or no row lies in it.
std::optional<AgreementClause> agreement(const FailureQuestion& question, FailureMap& map,
                                         const std::vector<Role>& roles, int nodes = 13, int rounds = 8);

}  // namespace soilbin::compare
