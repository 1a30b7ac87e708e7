#include "compare/fit/wheel_predictor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bekker_wong/contact_stages.hpp"
#include "bekker_wong/model.hpp"
#include "scenario/errors.hpp"
#include "scenario/fitted_errors.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

using bekker_wong::EffectParameter;
using bekker_wong::RolledWheel;
using bekker_wong::RollingWheel;
using bekker_wong::SoilValues;

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Where a fit stays nearer than what a file may hold: strengths and lengths that no soil has, and stress angles that
/// the wheel holds where they pass it.
struct FitBounds {
  std::string_view parameter;
  double lower, upper;
};
constexpr std::array<FitBounds, 4> narrower = {{
    {"friction_angle", 0.0, 65 * degree},
    {"shear_modulus", 2e-4, unbounded},
    {"stress_angle_c1", 0.0, bekker_wong::max_stress_share},
    {"stress_angle_c2", -0.5, bekker_wong::max_stress_share},
}};

/// Never wider than what a file may hold: a model that is saved can be read.
FitBounds fit_bounds(const SoilParameter& parameter) {
  FitBounds bounds{parameter.name, parameter.range.lower, parameter.range.upper};
  for (const FitBounds& one : narrower)
    if (one.parameter == parameter.name)
      bounds.lower = std::max(bounds.lower, one.lower), bounds.upper = std::min(bounds.upper, one.upper);
  return bounds;
}

struct Extent {
  double mean, half_range;
};

Extent extent_of(const std::string& covariate, const Observations& observations, double fallback) {
  double sum = 0.0, least = unbounded, most = -unbounded;
  int count = 0;
  for (const OperatingCondition& at : observations.rows) {
    const auto value = covariate == "moisture"   ? at.moisture
                       : covariate == "position" ? at.position
                       : at.run                  ? std::optional<double>(*at.run)
                                                 : std::nullopt;
    if (value) sum += *value, ++count, least = std::min(least, *value), most = std::max(most, *value);
  }
  return count > 0 ? Extent{sum / count, 0.5 * (most - least)} : Extent{fallback, 0.0};
}

constexpr double most_shortfall = 1.6;     // ln 5
constexpr double least_shortfall = 1e-12;  // tells a row that gives way by less than the quadrature's error

bool all_finite(const bekker_wong::Reading& r) {
  return std::ranges::all_of(bekker_wong::reading_members, [&](auto member) { return std::isfinite(r.*member); });
}

}  // namespace

DeclaredValueWords words_of_declared(std::string_view name) {
  if (name == carcass_pressure_key)
    return {"p_c", "carcass pressure p_c", "kPa", 1e-3, "pressure that the tire's carcass itself carries"};
  const SoilParameter& p = soil_parameter(name);
  return {p.symbol, p.title, p.unit, p.per_si, p.meaning};
}

double channel_of(const bekker_wong::Reading& reading, int channel) {
  return reading.*bekker_wong::reading_members.at(channel);
}

Term make_term(const bekker_wong::EffectForm& form, const Observations& observations, bool free_shape) {
  Term term{.form = &form, .defaults = {}, .free = {0}, .spread = {}};
  for (std::size_t i = 0; i < form.parameters.size(); ++i) {
    const EffectParameter& p = form.parameters[i];
    const bool centre = !p.centred_on.empty();
    const Extent extent = centre ? extent_of(p.centred_on, observations, p.fallback) : Extent{p.fallback, 1.0};
    term.defaults.push_back(std::clamp(extent.mean, p.lower, p.upper));
    term.spread.push_back(p.spread * extent.half_range);
    if (free_shape && i > 0 && p.upper > p.lower && (!centre || term.spread.back() > 0.0))
      term.free.push_back(static_cast<int>(i));
  }
  return term;
}

bekker_wong::NearBalance BalanceMemory::near_of(int row) const {
  const std::size_t r = row;
  if (!near.empty()) return near[r];
  return {.angle = angles.empty() ? 0.0 : angles[r]};
}

void PredictionSlopes::take(Eigen::Index p, double times, Eigen::Index from, int row,
                            std::pair<Eigen::Index, Eigen::Index> cells) {
  for (Eigen::Index i = cells.first; i < cells.second; ++i) jacobian(i, p) = times * jacobian(i, from);
  shortfall_slopes(row, p) = times * shortfall_slopes(row, from);
  entry_angle_slopes(row, p) = times * entry_angle_slopes(row, from);
}

BalanceMemory BalanceMemory::moved_by(const Eigen::VectorXd& step, const PredictionSlopes& slopes) const {
  constexpr double farthest = 0.5;  // in ln(theta_1)
  BalanceMemory moved = *this;
  moved.near.clear();
  const Eigen::VectorXd turn = slopes.entry_angle_slopes * step;
  for (std::size_t r = 0; r < angles.size(); ++r)
    moved.near.push_back(
        {.angle = angles[r] * std::exp(std::clamp(turn[r], -farthest, farthest)), .steepness = slopes.steepness[r]});
  return moved;
}

WheelPredictor::WheelPredictor(const Campaign& campaign, const Observations& observations, std::vector<Term> terms)
    : campaign_(&campaign),
      observations_(&observations),
      terms_(std::move(terms)),
      declared_(bekker_wong::make_effects(campaign.effects)) {
  for (std::size_t i = 0; i < soilbin::soil_parameters.size(); ++i) {
    const SoilParameter& parameter = soilbin::soil_parameters[i];
    const Estimate& declared = campaign.soil.*parameter.value;
    if (!(declared.std_error > 0.0)) continue;
    const FitBounds bounds = fit_bounds(parameter);
    soil_members_.push_back(bekker_wong::soil_members[i]);
    parameters_.push_back(
        {parameter.name, declared.value, declared.std_error, bounds.lower, bounds.upper, declared.std_error});
  }
  frees_carcass_ = bekker_wong::errs_by_carcass(campaign.wheel, campaign.effects);
  if (frees_carcass_) {
    const Estimate& declared = *campaign.wheel.carcass_pressure;
    parameters_.push_back(
        {carcass_pressure_key, declared.value, declared.std_error, 0.0, unbounded, declared.std_error});
  }
  for (const Term& term : terms_) {
    first_of_term_.push_back(static_cast<int>(parameters_.size()));
    for (const int i : term.free) {
      const EffectParameter& p = term.form->parameters[i];
      const double start = term.defaults[i];
      const double reach = std::max(std::abs(p.fallback), 0.02 * (p.upper - p.lower));
      const double stated = term.spread[i];
      const double sd = i == 0 ? unbounded : stated > 0.0 ? stated : std::min(0.5 * reach, 0.25 * (p.upper - p.lower));
      parameters_.push_back({term.form->id + "." + p.name, start, sd, p.lower, p.upper, i == 0 ? reach : sd});
    }
  }
}

WheelPredictor WheelPredictor::with(const std::vector<Term>& more) const {
  std::vector<Term> terms = terms_;
  terms.insert(terms.end(), more.begin(), more.end());
  return {*campaign_, *observations_, std::move(terms)};
}

Eigen::VectorXd WheelPredictor::start() const {
  Eigen::VectorXd theta(parameters_.size());
  for (Eigen::Index i = 0; i < theta.size(); ++i) theta[i] = parameters_[i].prior;
  return within_bounds(std::move(theta));
}

Eigen::VectorXd WheelPredictor::within_bounds(Eigen::VectorXd theta) const {
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const FreeParameter& p = parameters_[i];
    theta[i] = std::clamp(theta[i], p.lower, p.upper);
  }
  return theta;
}

std::vector<Wall> WheelPredictor::walls() const {
  const Eigen::Index n = parameters_.size();
  std::vector<Wall> walls;
  double slip = 0.0;
  for (const OperatingCondition& at : observations_->rows)
    slip = std::max(slip, std::abs(bekker_wong::kinematics(at).slip));
  Eigen::VectorXd share = Eigen::VectorXd::Zero(n);  // what theta_m/theta_1 at that slip gains from each
  double fixed = campaign_->soil.stress_angle_c1.value + slip * campaign_->soil.stress_angle_c2.value;
  for (Eigen::Index i = 0; i < n; ++i) {
    const FreeParameter& p = parameters_[i];
    const Eigen::VectorXd along = Eigen::VectorXd::Unit(n, i);
    if (std::isfinite(p.lower)) walls.push_back({-along, -p.lower});
    if (std::isfinite(p.upper)) walls.push_back({along, p.upper});
    if (p.name == "stress_angle_c1") share[i] = 1.0, fixed -= p.prior;
    if (p.name == "stress_angle_c2") share[i] = slip, fixed -= slip * p.prior;
  }
  if (share.isZero()) return walls;
  const double declared = share.dot(start());
  walls.push_back({-share, std::max(fixed, -declared)});
  walls.push_back({share, std::max(bekker_wong::max_stress_share - fixed, declared)});
  return walls;
}

SoilValues WheelPredictor::soil(const Eigen::VectorXd& theta) const {
  SoilValues values = bekker_wong::values_of(campaign_->soil);
  for (std::size_t i = 0; i < soil_members_.size(); ++i) values.*soil_members_[i] = theta[i];
  const double follows = modulus_factor(campaign_->soil, campaign_->soil.exponent.value, values.exponent);
  values.k_c *= follows, values.k_phi *= follows;
  return values;
}

Tire WheelPredictor::wheel(const Eigen::VectorXd& theta) const {
  Tire wheel = campaign_->wheel;
  if (frees_carcass_) wheel.carcass_pressure->value = theta[std::ssize(soil_members_)];
  return wheel;
}

std::vector<double> WheelPredictor::term_values(std::size_t term, const Eigen::VectorXd& theta) const {
  std::vector<double> values = terms_[term].defaults;
  for (std::size_t k = 0; k < terms_[term].free.size(); ++k)
    values[terms_[term].free[k]] = theta[first_of_term_[term] + k];
  return values;
}

bekker_wong::EffectList WheelPredictor::effects(const Eigen::VectorXd& theta) const {
  bekker_wong::EffectList list = declared_;
  for (std::size_t t = 0; t < terms_.size(); ++t) list.push_back(terms_[t].form->make(term_values(t, theta)));
  return list;
}

std::vector<EffectChoice> WheelPredictor::choices(const Eigen::VectorXd& theta) const {
  std::vector<EffectChoice> list = campaign_->effects;
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    EffectChoice choice{terms_[t].form->id, terms_[t].form->form, {}};
    const std::vector<double> values = term_values(t, theta);
    for (std::size_t i = 0; i < values.size(); ++i) choice.parameters[terms_[t].form->parameters[i].name] = values[i];
    list.push_back(choice);
  }
  return list;
}

std::string WheelPredictor::name_among(const std::vector<EffectChoice>& choices, int parameter) const {
  if (parameter < soil_parameters()) return parameters_[parameter].name;
  const auto after = std::ranges::upper_bound(first_of_term_, parameter);
  const std::size_t t = after - first_of_term_.begin() - 1;
  const int i = terms_[t].free[parameter - first_of_term_[t]];
  return effect_parameter_name(choices, campaign_->effects.size() + t, terms_[t].form->parameters[i].name);
}

RollingWheel WheelPredictor::wheel_at(const Eigen::VectorXd& theta) const {
  return {wheel(theta), soil(theta), effects(theta), campaign_->bin};
}

bool WheelPredictor::predict(const Eigen::VectorXd& theta, Eigen::VectorXd& prediction) const {
  BalanceMemory memory;
  return predict(theta, prediction, memory);
}

bool WheelPredictor::predict(const Eigen::VectorXd& theta, Eigen::VectorXd& prediction, BalanceMemory& memory,
                             const RowWatch& watch) const {
  if (memory.order.size() != observations_->rows.size()) {
    memory.order.resize(observations_->rows.size());
    std::iota(memory.order.begin(), memory.order.end(), 0);
  }
  std::size_t tried = 0;
  const auto ends_at = [&] {
    const auto first = memory.order.begin(), here = first + static_cast<std::ptrdiff_t>(tried);
    if (tried > 0) std::rotate(first, here, here + 1);
    return false;
  };
  try {
    const RollingWheel wheel = wheel_at(theta);
    const std::vector<Cell>& cells = observations_->cells;
    prediction.resize(cells.size());
    std::vector<double> angles(memory.order.size()), shortfall(memory.order.size());
    for (; tried < memory.order.size(); ++tried) {
      const int row = memory.order[tried];
      auto cell = std::lower_bound(cells.begin(), cells.end(), row, [](const Cell& c, int r) { return c.row < r; });
      if (cell == cells.end() || cell->row != row) continue;
      const std::size_t r = row;
      const OperatingCondition& at = observations_->rows[r];
      const RolledWheel rolled = memory.gives_way ? wheel.roll_or_give_way(at, memory.near_of(row)) : wheel.roll(at);
      if (!all_finite(rolled.reading) || rolled.shortfall > most_shortfall) return ends_at();
      angles[r] = rolled.balance_angle;
      shortfall[r] = rolled.gives_way ? std::max(rolled.shortfall, least_shortfall) : 0.0;
      const Eigen::Index first = cell - cells.begin();
      for (; cell != cells.end() && cell->row == row; ++cell)
        prediction[cell - cells.begin()] = channel_of(rolled.reading, cell->channel);
      if (watch && !watch(first, cell - cells.begin() - first, prediction, shortfall[r])) return ends_at();
    }
    memory.angles = std::move(angles);
    memory.shortfall = std::move(shortfall);
    for (std::size_t r = 0; r < memory.near.size(); ++r)
      memory.near[r] = {memory.angles[r], memory.shortfall[r] > 0.0 ? 0.0 : memory.near[r].steepness};
    return true;
  } catch (const NoSolution&) {
    return ends_at();
  } catch (const InputError&) {
    return ends_at();  // a trial value outside what the wheel accepts
  } catch (const std::domain_error&) {
    return ends_at();
  }
}

/// Wheels with one parameter moved each.
struct WheelPredictor::Moved {
  std::vector<RollingWheel> wheels;
  std::vector<double> steps;
};

WheelPredictor::Moved WheelPredictor::moved_from(const Eigen::VectorXd& theta) const {
  Moved moved;
  const std::vector<Wall> walls = this->walls();
  for (Eigen::Index p = 0; p < theta.size(); ++p) {
    double step = 1e-5 * parameters_[p].scale;
    const auto crosses = [&](const Wall& w) {
      return w.normal[p] * step > 0.0 && w.normal.dot(theta) + w.normal[p] * step > w.limit;
    };
    if (std::ranges::any_of(walls, crosses)) step = -step;
    Eigen::VectorXd at = theta;
    at[p] += step;
    moved.steps.push_back(at[p] - theta[p]);
    moved.wheels.push_back(wheel_at(at));
  }
  return moved;
}

std::optional<PredictionSlopes> WheelPredictor::linearise(const Eigen::VectorXd& theta,
                                                          const BalanceMemory& known) const try {
  const RollingWheel wheel = wheel_at(theta);
  const Moved moved = moved_from(theta);
  const std::vector<Cell>& cells = observations_->cells;
  PredictionSlopes slopes{.jacobian = Eigen::MatrixXd::Zero(std::ssize(cells), theta.size()),
                          .shortfall_slopes = Eigen::MatrixXd::Zero(rows(), theta.size()),
                          .entry_angle_slopes = Eigen::MatrixXd::Zero(rows(), theta.size()),
                          .steepness = Eigen::VectorXd::Zero(rows())};
  std::size_t cell = 0;
  for (int row = 0; row < rows(); ++row) {
    const std::size_t first = cell, r = row;
    while (cell < cells.size() && cells[cell].row == row) ++cell;
    if (cell == first) continue;
    const OperatingCondition& at = observations_->rows[r];
    const double theta_1 = known.angles[r], turn = 1e-6 * theta_1;
    const bekker_wong::NodeLayout nodes = bekker_wong::coarse(wheel.nodes(at, theta_1));
    const RolledWheel here = wheel.at_entry_angle(at, theta_1, nodes);
    const RolledWheel turned = wheel.at_entry_angle(at, theta_1 - turn, nodes);
    if (!all_finite(here.reading)) return std::nullopt;
    const double stiffness = (here.forces.vertical - turned.forces.vertical) / turn;
    const bool gives_way = known.shortfall[r] > 0.0;
    if (!gives_way) slopes.steepness[row] = stiffness * theta_1 / here.forces.vertical;
    const auto difference = [&](Eigen::Index p) {
      const std::size_t q = p;
      const RolledWheel there = moved.wheels[q].at_entry_angle(at, theta_1, nodes);
      const double carries_more = there.forces.vertical - here.forces.vertical;
      const double roll_by = gives_way ? 0.0 : -carries_more / stiffness;
      if (gives_way) slopes.shortfall_slopes(row, p) = -carries_more / (here.forces.vertical * moved.steps[q]);
      slopes.entry_angle_slopes(row, p) = roll_by / (theta_1 * moved.steps[q]);
      for (std::size_t i = first; i < cell; ++i) {
        const int c = cells[i].channel;
        const double value = channel_of(here.reading, c);
        const double by_angle = (value - channel_of(turned.reading, c)) / turn;
        slopes.jacobian(i, p) = (channel_of(there.reading, c) - value + by_angle * roll_by) / moved.steps[q];
      }
    };
    for (Eigen::Index p = 0; p < soil_parameters(); ++p) difference(p);
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      const Eigen::Index begin = first_of_term_[t], size = std::ssize(terms_[t].free);
      const std::vector<double> products = terms_[t].basis_values ? terms_[t].basis_values(at) : std::vector<double>();
      const auto largest =
          std::ranges::max_element(products, [](double a, double b) { return std::abs(a) < std::abs(b); });
      if (largest == products.end() || *largest == 0.0) {
        for (Eigen::Index p = begin; p < begin + size; ++p) difference(p);
        continue;
      }
      const Eigen::Index leads = begin + (largest - products.begin());
      difference(leads);
      for (Eigen::Index p = begin; p < begin + size; ++p)
        if (p != leads) slopes.take(p, products[p - begin] / *largest, leads, row, {first, cell});
    }
  }
  return slopes.jacobian.allFinite() ? std::optional(std::move(slopes)) : std::nullopt;
} catch (const NoSolution&) {
  return std::nullopt;
} catch (const InputError&) {
  return std::nullopt;
} catch (const std::domain_error&) {
  return std::nullopt;
}

bekker_wong::Reading WheelPredictor::reading(const Eigen::VectorXd& theta, const OperatingCondition& at) const {
  return wheel_at(theta).roll(at).reading;
}

std::optional<Eigen::VectorXd> declared_prediction(const Campaign& campaign, const Observations& runs) {
  const WheelPredictor declared(campaign, runs);
  Eigen::VectorXd prediction;
  return declared.predict(declared.start(), prediction) ? std::optional(prediction) : std::nullopt;
}

}  // namespace soilbin::compare
