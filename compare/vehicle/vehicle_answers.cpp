#include "compare/vehicle/vehicle_answers.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <utility>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/gsl.hpp"
#include "compare/design/factor.hpp"
#include "compare/vehicle/vehicle.hpp"
#include "compare/vehicle/vehicle_errors.hpp"
#include "compare/vehicle/vehicle_speed.hpp"
#include "scenario/drive_soils.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

std::vector<double> degrees_up_to(double last, double step) {
  std::vector<double> all;
  for (int i = 0; i * step <= last; ++i) all.push_back(i * step * degree);
  return all;
}

double standard_normal_at(double share) { return std::sqrt(2.0) * boost::math::erf_inv(2.0 * share - 1.0); }

/// A drawn number held within its range; an open bound is kept away from by a thousandth of the way to the declared
/// one.
double held_within(const Range& range, double x, double declared) {
  constexpr double away = 1e-3;
  if (range.holds(x)) return x;
  if (x > range.lower) return range.upper_open ? range.upper - away * (range.upper - declared) : range.upper;
  return range.lower_open ? range.lower + away * (declared - range.lower) : range.lower;
}

bool goes(const SteadyVehicles& vehicles, const VehicleCondition& at) {
  try {
    vehicles.pulling(at);
    return true;
  } catch (const NoSolution&) {
    return false;
  }
}

/// How many of the slopes, from the first, it goes on: by halves.
std::size_t slopes_gone(const SteadyVehicles& vehicles, const VehicleCondition& asked, double heading,
                        const std::vector<double>& slopes) {
  std::size_t gone = 0, beyond = slopes.size();
  while (gone < beyond) {
    const std::size_t middle = (gone + beyond) / 2;
    if (goes(vehicles, heading_on(asked, slopes[middle], heading)))
      gone = middle + 1;
    else
      beyond = middle;
  }
  return gone;
}

}  // namespace

VehicleFailure as_failure(const VehicleGaveOut& error) {
  return {error.why(), error.wheel(), error.why() == GaveOut::wheel ? error.what() : ""};
}

VehicleCondition heading_on(const VehicleCondition& asked, double slope, double heading) {
  VehicleCondition at = asked;
  at.slope = std::asin(std::sin(slope) * std::cos(heading));
  at.cross_slope = std::asin(std::clamp(std::sin(slope) * std::sin(heading) / std::cos(at.slope), -1.0, 1.0));
  constexpr double none = 1e-12;  // straight down is straight
  if (std::abs(at.cross_slope) < none) at.cross_slope = 0.0;
  if (std::abs(at.slope) < none) at.slope = 0.0;
  return at;
}

GoMap go_map(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model, GoMapPlan plan) {
  if (plan.samples < 1) throw InputError("a map needs one sample or more");
  GoMap map;
  map.slopes = plan.slopes.empty() ? degrees_up_to(35.0, 5.0) : plan.slopes;
  map.headings = plan.headings.empty() ? degrees_up_to(180.0, 30.0) : plan.headings;
  const std::vector<DoubtfulNumber> doubtful = doubtful_numbers(wheels);
  map.samples = doubtful.empty() ? 1 : plan.samples;
  const Eigen::MatrixXd drawn = latin_hypercube(map.samples, std::max(1, static_cast<int>(doubtful.size())), plan.seed);
  map.cells.assign(map.slopes.size(), std::vector<GoCell>(map.headings.size()));
  for (int sample = 0; sample < map.samples; ++sample) {
    std::vector<VehicleWheel> changed = wheels;
    for (std::size_t i = 0; i < doubtful.size(); ++i) {
      const DoubtfulNumber& one = doubtful[i];
      const double z = standard_normal_at(drawn(sample, static_cast<int>(i)));
      changed = one.in(std::move(changed), held_within(one.range, one.value + one.sd * z, one.value));
    }
    const SteadyVehicles vehicles(question, changed, model);
    for (std::size_t k = 0; k < map.headings.size(); ++k) {
      const std::size_t gone = slopes_gone(vehicles, question.condition, map.headings[k], map.slopes);
      for (std::size_t i = 0; i < gone; ++i) map.cells[i][k].chance += 1.0;  // a count, until all are drawn
    }
    if (plan.progress) plan.progress(static_cast<std::size_t>(sample) + 1, static_cast<std::size_t>(map.samples));
  }
  for (std::vector<GoCell>& row : map.cells)
    for (GoCell& cell : row) {
      cell.chance /= map.samples;
      cell.std_error = std::sqrt(cell.chance * (1.0 - cell.chance) / map.samples);
    }
  return map;
}

namespace {

constexpr double steepest_asked = 1.2;  // [rad] 69 deg

/// Which way a slope is steep.
enum class SlopeWay { up, down, across };

VehicleCondition on(const VehicleCondition& asked, SlopeWay way, double angle) {
  VehicleCondition at = asked;
  at.slope = way == SlopeWay::up ? angle : way == SlopeWay::down ? -angle : 0.0;
  at.cross_slope = way == SlopeWay::across ? angle : 0.0;
  return at;
}

/// The search for the steepest slope one way. Slopes rise from gentle to steep; on one where it goes it may pull more
/// than is asked, its spare pull.
class SteepestSlope {
 public:
  /// What is referred to must outlive this.
  SteepestSlope(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model, SlopeWay way)
      : question_(question), wheels_(wheels), model_(model), way_(way), vehicles_(question, wheels, model) {}

  VehicleLimit find() {
    if (!starts()) return limit_;
    close_in();
    if (slides_ && low_ > *slides_) return end_where_the_soil_slides();
    if (high_ == steepest_asked) {
      limit_.on_all = true;
      return limit_;
    }
    constexpr double beside = 0.05 * degree;
    if (!travels(low_ - beside))  // at less slip than that of its largest pull a wheel gives out
      back_to_where_it_travels();
    else
      tell_end();
    return limit_;
  }

 private:
  static constexpr double close_ = 1e-6;  ///< [rad] between the slopes on which it goes and does not

  VehicleCondition on_slope(double angle) const { return on(question_.condition, way_, angle); }

  /// What it pulls more than is asked at its best: of all slips, or on the hill at a slip.
  double spare(double angle, const std::optional<double>& about = {}) {
    const VehicleCondition at = on_slope(angle);
    try {
      const SteadyVehicle most = vehicles_.at_most(at, braked_, about);
      const double left = sign_ * (most.pull - at.pull);
      if (left >= 0.0) best_slip_ = most.slip;
      return std::max(left, none_);
    } catch (const VehicleGaveOut& error) {
      limit_.beyond = as_failure(error);
      return none_;
    }
  }

  double spare_at_best_slip(double angle) const {
    const VehicleCondition at = on_slope(angle);
    try {
      return std::max(sign_ * (vehicles_.at_slip(at, best_slip_).pull - at.pull), none_);
    } catch (const VehicleGaveOut&) {
      return none_;
    }
  }

  /// Whether it has a balance at the pull that is asked; else what ends it stands in `beyond`.
  bool travels(double angle) {
    try {
      vehicles_.pulling(on_slope(angle));
      return true;
    } catch (const VehicleGaveOut& error) {
      limit_.beyond = as_failure(error);
      return false;
    }
  }

  /// From level ground; where it does not go there, from the gentlest descent on which it travels. False without one.
  bool starts() {
    at_low_ = spare(0.0);
    if (at_low_ >= 0.0) return true;
    if (way_ == SlopeWay::across) return false;
    constexpr double step = 1.0 * degree, gentle = 20.0 * degree;  // chosen
    const VehicleFailure on_level = limit_.beyond;
    double descent = step;
    while (descent < gentle && !travels(braked_ ? descent : -descent)) descent += step;
    if (descent >= gentle) {
      limit_.beyond = on_level;
      return false;
    }
    low_ = braked_ ? descent : -descent;
    if (!braked_) high_ = step - descent;
    return (at_low_ = spare(low_)) >= 0.0;
  }

  /// Where, from `low` on, what is spare at the best slip there ends, by secants; none where they meet a slope without
  /// a balance.
  std::optional<double> end_at_best_slip() const {
    constexpr int most_secants = 10;
    gsl::Sample before{low_, at_low_};
    double angle = low_ + at_low_ / vehicles_.weight();
    for (int i = 0; i < most_secants; ++i) {
      const gsl::Sample here{std::clamp(angle, low_, high_), spare_at_best_slip(std::clamp(angle, low_, high_))};
      if (std::abs(here.f) <= 0.01 * close_ * vehicles_.weight()) return here.x;
      if (here.f == none_ || here.f == before.f) break;
      angle = here.x - here.f * (here.x - before.x) / (here.f - before.f);
      before = here;
    }
    return {};
  }

  /// Brings `low`, on which it goes, and `high`, on which it does not, close together.
  void close_in() {
    bool other_slip = true;  // than the one whose end was looked for
    double reach = 0.1;      // from a slope on which it goes to the next that is asked, while none is known beyond
    while (high_ - low_ > close_) {
      // At the slip that is best on one slope it goes as far as a slope at or below the steepest, whose best slip is
      // asked next: Newton's method, by the envelope theorem.
      const std::optional<double> end = std::exchange(other_slip, false) ? end_at_best_slip() : std::nullopt;
      if (end && *end - 0.25 * close_ > low_) low_ = *end - 0.25 * close_, at_low_ = spare_at_best_slip(low_);
      // Elsewhere the chord is near as a rule; else halves: it ends at once where the vehicle tips over or slides.
      const double chord =
          at_high_ > none_ ? low_ + (high_ - low_) * at_low_ / (at_low_ - at_high_) : 0.5 * (low_ + high_);
      const double margin = 0.1 * (high_ - low_);
      double middle = std::clamp(chord, low_ + margin, high_ - margin);
      if (end)
        middle = std::min(*end + 0.25 * close_, high_);
      else if (high_ == steepest_asked)
        middle = std::min(low_ + std::exchange(reach, 1.5 * reach), middle);
      double f = spare(middle, best_slip_);
      if (f < 0.0 && middle - low_ <= close_) f = spare(middle);  // the last word is that of all slips
      if (f >= 0.0)
        low_ = middle, at_low_ = f, other_slip = true;
      else
        high_ = middle, at_high_ = f;
    }
  }

  /// The steepest slope below on which it has a balance at the pull that is asked, without an error.
  void back_to_where_it_travels() {
    constexpr double back = 0.5 * degree;
    double beyond = low_;
    while (!travels(low_ = beyond - back))
      if ((beyond = low_) < -steepest_asked) return;
    while (beyond - low_ > close_) {
      const double middle = 0.5 * (low_ + beyond);
      (travels(middle) ? low_ : beyond) = middle;
    }
    limit_.slip = vehicles_.pulling(on_slope(low_)).slip;
    limit_.angle = Estimate{low_, not_a_number};
  }

  VehicleLimit end_where_the_soil_slides() {
    limit_.angle = Estimate{*slides_, not_a_number};
    limit_.slip = travels(*slides_) ? vehicles_.pulling(on_slope(*slides_)).slip : not_a_number;
    limit_.beyond = {GaveOut::soil_slides};
    return limit_;
  }

  /// Slope, slip and what ends it there, where that is the pull with an error.
  void tell_end() {
    const SteadyVehicle last = vehicles_.at_most(on_slope(low_), braked_, best_slip_);
    limit_.slip = last.slip;
    limit_.angle = Estimate{low_, not_a_number};
    if (at_high_ == none_) {
      if (limit_.beyond.why == GaveOut::tips_over) limit_.angle->std_error = 0.0;
      return;
    }
    limit_.beyond = {why_too_little(last, braked_), weakest_wheel(last), ""};
    limit_.angle->std_error = error_at(last.slip);
  }

  /// The largest pull changes with soil and slope as the pull at its slip does (the envelope theorem). Not a number
  /// where a slope beside has no balance.
  double error_at(double slip) const {
    constexpr double step = 1e-4;
    try {
      const double rise =
          (vehicles_.at_slip(on_slope(low_ + step), slip).pull - vehicles_.at_slip(on_slope(low_ - step), slip).pull) /
          (2 * step);
      const VehicleNumbers error = errors_of(wheels_, 1, [&](const std::vector<VehicleWheel>& changed) {
        const SteadyVehicles other(question_, changed, model_);
        return VehicleNumbers{other.at_slip(on_slope(low_), slip).pull};
      });
      return error[0] / std::abs(rise);
    } catch (const VehicleGaveOut&) {
      return not_a_number;
    }
  }

  const VehicleCase& question_;
  const std::vector<VehicleWheel>& wheels_;
  const Model& model_;
  const SlopeWay way_;
  const SteadyVehicles vehicles_;
  const bool braked_ = way_ == SlopeWay::down;
  const double sign_ = braked_ ? -1.0 : 1.0;
  const double none_ = -vehicles_.weight();  ///< what is spare on a slope without a balance
  /// From which slope on the soil slides by itself [rad]; none where it stands at any.
  const std::optional<double> slides_ = bekker_wong::sliding_slope(question_.soil, question_.axles.front().tire);
  VehicleLimit limit_{};
  double low_ = 0.0, high_ = steepest_asked;  ///< slopes on which it goes and does not [rad]
  double at_low_ = 0.0, at_high_ = none_;     ///< what is spare on them [N]
  double best_slip_ = 0.0;                    ///< on `low`
};

VehicleLimit steepest(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                      SlopeWay way) {
  return SteepestSlope(question, wheels, model, way).find();
}

}  // namespace

std::array<VehicleLimit, 3> steepest_slopes(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                            const Model& model) {
  return {steepest(question, wheels, model, SlopeWay::up), steepest(question, wheels, model, SlopeWay::down),
          steepest(question, wheels, model, SlopeWay::across)};
}

VehicleLimit steepest_climb(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model) {
  return steepest(question, wheels, model, SlopeWay::up);
}

VehicleAnswers state_of(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model) {
  if (!question.soil.semi_empirical)
    throw InputError("soil '" + question.soil.name + "' has no semi_empirical values, which a vehicle needs");
  VehicleAnswers answers{question, wheels};
  answers.in_full = false;
  const SteadyVehicles vehicles(question, wheels, model);
  const VehicleCondition& at = question.condition;
  try {
    answers.steady = vehicles.pulling(at);
    if (question.power && answers.steady->power.into_wheels > 0.0)
      answers.power_speed = speed_at_power(*question.power, *answers.steady);
    answers.not_held = not_held_by(question, *answers.steady);
  } catch (const VehicleGaveOut& error) {
    answers.failure = as_failure(error);
  }
  for (const int percent : {0, 5, 10, 15, 20, 25, 30, 40, 50, 60, 70, 80, 90}) {
    VehiclePullRow row{percent / 100.0};
    try {
      row.vehicle = vehicles.at_slip(at, row.slip);
    } catch (const VehicleGaveOut& error) {
      row.failure = as_failure(error);
    }
    answers.pulls.push_back(std::move(row));
  }
  return answers;
}

VehicleAnswers answers_of(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model) {
  VehicleAnswers answers = state_of(question, wheels, model);
  answers.in_full = true;
  const VehicleCondition& at = question.condition;
  if (answers.steady) answers.errors = errors_of_steady(question, wheels, model, at);
  for (VehiclePullRow& row : answers.pulls)
    if (row.vehicle)
      row.pull_error = errors_of(wheels, 1, [&](const std::vector<VehicleWheel>& changed) {
        return VehicleNumbers{SteadyVehicles(question, changed, model).at_slip(at, row.slip).pull};
      })[0];
  const auto [up, down, across] = steepest_slopes(question, wheels, model);
  answers.up = up, answers.down = down, answers.across = across;
  if (is_limited(question)) add_speeds(answers, model);
  return answers;
}

namespace {

/// A number that is moved for the errors of a drive, and the soil that it is of where it is one of a soil.
struct DriveNumber {
  DoubtfulNumber number;
  std::optional<Soil> of{};
};

/// Those of the wheels, then those of the soils that begin on the way and are others than the ones before.
std::vector<DriveNumber> drive_numbers(VehicleCase question, const std::vector<VehicleWheel>& wheels) {
  std::vector<DriveNumber> all;
  for (const Soil* soil : soils_once(question.soil, question.drive.profile)) {
    if (!soil->semi_empirical) continue;
    const bool own = soil == &question.soil;
    for (DoubtfulNumber& number : doubtful_numbers(*soil)) {
      if (!own) number.title += " of " + soil->name;
      all.push_back({std::move(number), *soil});
    }
    if (own)
      for (DoubtfulNumber& number : doubtful_carcasses(wheels)) all.push_back({std::move(number)});
  }
  return all;
}

MovedVehicleDrive::Side moved_drive(VehicleCase question, std::vector<VehicleWheel> wheels, const DriveNumber& moved,
                                    double value) {
  MovedVehicleDrive::Side side{value};
  if (!moved.of || is_same_soil(question.soil, *moved.of)) wheels = moved.number.in(std::move(wheels), value);
  for (Waypoint& point : question.drive.profile)
    if (moved.of && point.soil && is_same_soil(*point.soil, *moved.of)) {
      Scenario there;
      there.soil = *point.soil;
      moved.number.set(there, value);
      point.soil = there.soil;
    }
  try {
    const VehicleDriveRecord record = drive_vehicle(question, wheels, 1);
    side.end = record.end, side.end_time = record.end_time, side.travelled = record.samples.back().travelled;
  } catch (const NoSolution&) {  // it does not stand
  }
  return side;
}

/// Standard error of a number of the drives' ends, by half of what lies between both sides of each value, as wide as
/// its standard deviation; none where a value has no drive on a side.
std::optional<double> error_over(const std::vector<MovedVehicleDrive>& moved, double MovedVehicleDrive::Side::*number) {
  double variance = 0.0;
  for (const MovedVehicleDrive& one : moved) {
    if (!one.lower.end || !one.higher.end) return {};
    const double width = one.higher.value - one.lower.value;
    if (width > 0.0) variance += std::pow(one.sd * (one.higher.*number - one.lower.*number) / width, 2);
  }
  return std::sqrt(variance);
}

}  // namespace

DrivenAnswers driven_answers(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                             int samples, const bekker_wong::DriveProgress& progress) {
  DrivenAnswers answers{question, wheels};
  answers.up = steepest_climb(question, wheels, model);
  try {
    answers.record = drive_vehicle(question, wheels, samples, {}, progress);
  } catch (const VehicleGaveOut& error) {
    answers.failure = {error.why(), error.wheel(), error.what()};
    return answers;
  }
  for (const DriveNumber& one : drive_numbers(question, wheels)) {
    const DoubtfulNumber& number = one.number;
    MovedVehicleDrive moved{number.title, number.value, number.sd};
    const Neighbours beside = neighbours(number.value, number.sd, number.range);
    moved.lower = moved_drive(question, wheels, one, beside.below);
    moved.higher = moved_drive(question, wheels, one, beside.above);
    answers.moved.push_back(moved);
    if (progress) progress(answers.record->end_time, question.drive.duration);
  }
  if (answers.moved.empty()) return answers;
  const auto ends_alike = [&](const MovedVehicleDrive& one) {
    return one.lower.end == answers.record->end && one.higher.end == answers.record->end;
  };
  if (!std::ranges::all_of(answers.moved, ends_alike)) return answers;  // stuck and not stuck: no slope between them
  answers.travelled_error = error_over(answers.moved, &MovedVehicleDrive::Side::travelled);
  answers.end_time_error = error_over(answers.moved, &MovedVehicleDrive::Side::end_time);
  return answers;
}

}  // namespace soilbin::compare
