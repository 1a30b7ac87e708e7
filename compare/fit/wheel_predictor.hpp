// Predictions of every cell of a campaign, and their derivatives, by the Bekker / Wong-Reece wheel with some effects.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "compare/fit/observations.hpp"

namespace soilbin::compare {

/// One channel of a reading, by Channel.
double channel_of(const bekker_wong::Reading& reading, int channel);

/// A number that a fit may move. Prior: normal about `prior` with `prior_sd`; infinite sd: none.
struct FreeParameter {
  std::string name;
  double prior = 0.0;
  double prior_sd = std::numeric_limits<double>::infinity();
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double scale = 1.0;  ///< typical size of a change [SI]
};

/// How files and people call a value that a campaign declares of the soil or of the carcass, by FreeParameter::name.
struct DeclaredValueWords {
  const char *symbol, *title, *unit;
  double per_si;
  const char* meaning;
};
DeclaredValueWords words_of_declared(std::string_view name);

/// normal . theta <= limit: a bound, or a kink of the model beyond which theta means nothing else.
struct Wall {
  Eigen::VectorXd normal;
  double limit = 0.0;
};

/// A form of an effect as a term of a model: its amplitude is free, its shape parameters too where they have room,
/// with a prior about their defaults.
struct Term {
  const bekker_wong::EffectForm* form = nullptr;
  std::vector<double> defaults;  ///< parameters' values to start from [SI], reference values already centred
  std::vector<int> free;         ///< indices of the parameters that a fit moves; 0 is the amplitude
  std::vector<double> spread;    ///< sd of each parameter's prior about its default [SI]; 0: none stated
  /// Where the free ones are the weights of one function of the condition: what each of them multiplies there. Their
  /// slopes are then one slope, times that.
  std::function<std::vector<double>(const OperatingCondition&)> basis_values = {};
};

/// A form with its reference values set to the observations' means (moisture, position, run). free_shape: the other
/// parameters move as well, a reference value where its form says that nobody knows it.
Term make_term(const bekker_wong::EffectForm& form, const Observations& observations, bool free_shape);

/// The predictions' first derivatives over theta, at one theta.
struct PredictionSlopes {
  Eigen::MatrixXd jacobian;          ///< cells x parameters
  Eigen::MatrixXd shortfall_slopes;  ///< of ln(load/most carried), rows x parameters; zero but where the soil gives way
  Eigen::MatrixXd entry_angle_slopes;  ///< of ln(theta_1), rows x parameters; zero where the soil gives way
  Eigen::VectorXd steepness;           ///< d ln(load carried)/d ln(theta_1) of each row; zero where the soil gives way

  /// Sets a parameter's slopes in one row, its cells from .first to before .second: those of `from`, times `times`.
  void take(Eigen::Index parameter, double times, Eigen::Index from, int row,
            std::pair<Eigen::Index, Eigen::Index> cells);
};

/// What one prediction tells the next.
struct BalanceMemory {
  bool gives_way = false;                      ///< rows that no sinkage carries are read where the soil carries most
  std::vector<int> order;                      ///< rows as they are predicted: those that may end a prediction first
  std::vector<double> angles;                  ///< theta_1 of each row, of the last prediction that succeeded [rad]
  std::vector<double> shortfall;               ///< of each row, of that prediction: ln(load/most carried); 0: balanced
  std::vector<bekker_wong::NearBalance> near;  ///< where the next prediction looks first; empty: at `angles`

  bekker_wong::NearBalance near_of(int row) const;
  /// The memory of a prediction, with what its slopes expect of one that is `step` away in theta.
  BalanceMemory moved_by(const Eigen::VectorXd& step, const PredictionSlopes& slopes) const;
};

/// For predictions that go on where the soil gives way.
inline BalanceMemory giving_way() {
  BalanceMemory memory;
  memory.gives_way = true;
  return memory;
}

/// Hears each row of a prediction: where its cells stand, how many, and ln(load/most carried). False ends it.
using RowWatch =
    std::function<bool(Eigen::Index first, Eigen::Index count, const Eigen::VectorXd& prediction, double shortfall)>;

/// What the declared campaign and some terms predict. theta: the soil's free values in the order of soil_parameters
/// (those declared with sd > 0), the carcass pressure where it has a standard deviation and a declared effect reads it,
/// then each term's free parameters. All const members may be called from any thread.
class WheelPredictor {
 public:
  WheelPredictor(const Campaign& campaign, const Observations& observations, std::vector<Term> terms = {});

  /// A predictor of these runs with further terms.
  WheelPredictor with(const std::vector<Term>& more) const;
  /// This model over other runs, which outlive it.
  WheelPredictor over(const Observations& runs) const { return {*campaign_, runs, terms_}; }

  const std::vector<FreeParameter>& parameters() const { return parameters_; }
  /// How many of them the campaign declares: the soil's, and the carcass pressure.
  int soil_parameters() const { return static_cast<int>(soil_members_.size()) + (frees_carcass_ ? 1 : 0); }
  const std::vector<Term>& terms() const { return terms_; }
  int rows() const { return static_cast<int>(observations_->rows.size()); }
  /// Index in theta of a term's amplitude.
  int amplitude_index(int term) const { return first_of_term_[term]; }
  Eigen::VectorXd start() const;
  /// theta with each parameter that is beyond a bound put on it, to the last digit.
  Eigen::VectorXd within_bounds(Eigen::VectorXd theta) const;
  /// The parameters' bounds, and 0 <= c1 + c2 |s| <= max_stress_share for the largest slip of the rows, so that theta_m
  /// is where that law puts it and not where it is held; a declared soil beyond that is a bound itself.
  std::vector<Wall> walls() const;

  /// Predictions of all cells; false where any row has no balance at theta, or with memory.gives_way where the soil
  /// carries less than a fifth of any row's load, or where the watch ends it. The row that ended it stands first in
  /// memory.order then, for it is the likeliest to end the next one.
  bool predict(const Eigen::VectorXd& theta, Eigen::VectorXd& prediction) const;
  bool predict(const Eigen::VectorXd& theta, Eigen::VectorXd& prediction, BalanceMemory& memory,
               const RowWatch& watch = {}) const;

  /// The predictions' slopes over theta by implicit differentiation of the balance: at fixed theta_1 the forces and
  /// the carried load are differenced, then dtheta_1 = -dV/(dV/dtheta_1). All on the same nodes, half as many as a
  /// prediction's: slopes to about 1e-4, less well near a fold, where dV/dtheta_1 is small. known: of a prediction at
  /// this theta; its rows that give way stay at their theta_1, as the envelope theorem says of what they carry
  /// at most: d ln(load/V) = -dV/V. Nothing where a derivative is not finite.
  std::optional<PredictionSlopes> linearise(const Eigen::VectorXd& theta, const BalanceMemory& known) const;

  /// One condition's four channels at theta. Throws NoSolution.
  bekker_wong::Reading reading(const Eigen::VectorXd& theta, const OperatingCondition& at) const;

  /// The choices that theta stands for, for a resolved model: the campaign's effects, then the terms.
  std::vector<EffectChoice> choices(const Eigen::VectorXd& theta) const;
  /// What a file calls a parameter where these choices stand (scenario/fitted_errors.hpp).
  std::string name_among(const std::vector<EffectChoice>& choices, int parameter) const;
  bekker_wong::SoilValues soil(const Eigen::VectorXd& theta) const;
  Tire wheel(const Eigen::VectorXd& theta) const;

 private:
  struct Moved;
  bekker_wong::EffectList effects(const Eigen::VectorXd& theta) const;
  bekker_wong::RollingWheel wheel_at(const Eigen::VectorXd& theta) const;
  Moved moved_from(const Eigen::VectorXd& theta) const;
  std::vector<double> term_values(std::size_t term, const Eigen::VectorXd& theta) const;

  const Campaign* campaign_;
  const Observations* observations_;
  std::vector<Term> terms_;
  std::vector<FreeParameter> parameters_;
  std::vector<double bekker_wong::SoilValues::*> soil_members_;
  bool frees_carcass_ = false;
  std::vector<int> first_of_term_;
  bekker_wong::EffectList declared_;
};

/// What a campaign's declared soil and effects predict of runs, cell by cell; nothing where it does not carry one.
std::optional<Eigen::VectorXd> declared_prediction(const Campaign& campaign, const Observations& runs);

}  // namespace soilbin::compare
