#include "compare/loop/wheel_predictor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

using bekker_wong::EffectParameter;
using bekker_wong::RolledWheel;
using bekker_wong::RollingWheel;
using bekker_wong::SoilValues;

namespace {

struct SoilSlot {
  const char* name;
  double SoilValues::*value;
  Estimate SemiEmpiricalSoil::*declared;
  double lower, upper;
};
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr std::array<SoilSlot, 8> soil_slots = {{
    {"exponent", &SoilValues::exponent, &SemiEmpiricalSoil::exponent, 0.05, 3.0},
    {"k_c", &SoilValues::k_c, &SemiEmpiricalSoil::k_c, -unbounded, unbounded},
    {"k_phi", &SoilValues::k_phi, &SemiEmpiricalSoil::k_phi, -unbounded, unbounded},
    {"cohesion", &SoilValues::cohesion, &SemiEmpiricalSoil::cohesion, 0.0, unbounded},
    {"friction_angle", &SoilValues::friction_angle, &SemiEmpiricalSoil::friction_angle, 0.0, 65 * degree},
    {"shear_modulus", &SoilValues::shear_modulus, &SemiEmpiricalSoil::shear_modulus, 2e-4, unbounded},
    {"stress_angle_c1", &SoilValues::c1, &SemiEmpiricalSoil::stress_angle_c1, 0.0, 0.98},
    {"stress_angle_c2", &SoilValues::c2, &SemiEmpiricalSoil::stress_angle_c2, -0.5, 0.98},
}};

/// Mean and half range of a covariate.
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

bool all_finite(const bekker_wong::Reading& r) {
  return std::isfinite(r.drawbar_pull) && std::isfinite(r.torque) && std::isfinite(r.sinkage) &&
         std::isfinite(r.lateral_force);
}

}  // namespace

double channel_of(const bekker_wong::Reading& reading, int channel) {
  switch (channel) {
    case drawbar_pull:
      return reading.drawbar_pull;
    case torque:
      return reading.torque;
    case sinkage:
      return reading.sinkage;
    default:
      return reading.lateral_force;
  }
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

WheelPredictor::WheelPredictor(const Campaign& campaign, const Observations& observations, std::vector<Term> terms)
    : campaign_(&campaign),
      observations_(&observations),
      terms_(std::move(terms)),
      declared_(bekker_wong::make_effects(campaign.effects)) {
  for (const SoilSlot& slot : soil_slots) {
    const Estimate& declared = campaign.soil.*slot.declared;
    if (!(declared.std_error > 0.0)) continue;
    soil_members_.push_back(slot.value);
    parameters_.push_back({slot.name, declared.value, declared.std_error, slot.lower, slot.upper, declared.std_error});
  }
  for (const Term& term : terms_) {
    first_of_term_.push_back(static_cast<int>(parameters_.size()));
    for (const int i : term.free) {
      const EffectParameter& p = term.form->parameters[static_cast<std::size_t>(i)];
      const double start = term.defaults[static_cast<std::size_t>(i)];
      const double reach = std::max(std::abs(p.fallback), 0.02 * (p.upper - p.lower));
      const double stated = term.spread[static_cast<std::size_t>(i)];
      const double sd = i == 0 ? unbounded : stated > 0.0 ? stated : std::min(0.5 * reach, 0.25 * (p.upper - p.lower));
      parameters_.push_back({term.form->id + "." + p.name, start, sd, p.lower, p.upper, i == 0 ? reach : sd});
    }
  }
}

Eigen::VectorXd WheelPredictor::start() const {
  Eigen::VectorXd theta(static_cast<Eigen::Index>(parameters_.size()));
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const FreeParameter& p = parameters_[static_cast<std::size_t>(i)];
    theta[i] = std::clamp(p.prior, p.lower, p.upper);
  }
  return theta;
}

SoilValues WheelPredictor::soil(const Eigen::VectorXd& theta) const {
  SoilValues values = bekker_wong::values_of(campaign_->soil);
  for (std::size_t i = 0; i < soil_members_.size(); ++i) values.*soil_members_[i] = theta[static_cast<Eigen::Index>(i)];
  return values;
}

std::vector<double> WheelPredictor::term_values(std::size_t term, const Eigen::VectorXd& theta) const {
  std::vector<double> values = terms_[term].defaults;
  for (std::size_t k = 0; k < terms_[term].free.size(); ++k)
    values[static_cast<std::size_t>(terms_[term].free[k])] = theta[first_of_term_[term] + static_cast<Eigen::Index>(k)];
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

bool WheelPredictor::predict(const Eigen::VectorXd& theta, Eigen::VectorXd& prediction) const {
  BalanceMemory memory;
  return predict(theta, prediction, memory);
}

bool WheelPredictor::predict(const Eigen::VectorXd& theta, Eigen::VectorXd& prediction, BalanceMemory& memory) const
    try {
  const RollingWheel wheel(campaign_->wheel, soil(theta), effects(theta), campaign_->bin);
  const std::vector<Cell>& cells = observations_->cells;
  const int rows = static_cast<int>(observations_->rows.size());
  prediction.resize(static_cast<Eigen::Index>(cells.size()));
  std::vector<double> angles(static_cast<std::size_t>(rows));
  for (int k = 0, first = memory.weakest; k < rows; ++k) {
    const int row = (first + k) % rows;
    auto cell = std::lower_bound(cells.begin(), cells.end(), row, [](const Cell& c, int r) { return c.row < r; });
    if (cell == cells.end() || cell->row != row) continue;
    memory.weakest = row;
    const RolledWheel rolled = wheel.roll(observations_->rows[static_cast<std::size_t>(row)]);
    if (!all_finite(rolled.reading)) return false;
    angles[static_cast<std::size_t>(row)] = rolled.balance_angle;
    for (; cell != cells.end() && cell->row == row; ++cell)
      prediction[cell - cells.begin()] = channel_of(rolled.reading, cell->channel);
    memory.weakest = first;
  }
  memory.angles = std::move(angles);
  return true;
} catch (const NoSolution&) {
  return false;
} catch (const InputError&) {
  return false;  // a trial value outside what the wheel accepts
} catch (const std::domain_error&) {
  return false;
}

bool WheelPredictor::linearise(const Eigen::VectorXd& theta, Eigen::VectorXd& prediction, Eigen::MatrixXd& jacobian,
                               const std::vector<double>& angles) const try {
  const auto wheel_at = [&](const Eigen::VectorXd& at) {
    return RollingWheel(campaign_->wheel, soil(at), effects(at), campaign_->bin);
  };
  const RollingWheel wheel = wheel_at(theta);
  std::vector<RollingWheel> moved;
  std::vector<double> steps;
  for (Eigen::Index p = 0; p < theta.size(); ++p) {
    const FreeParameter& parameter = parameters_[static_cast<std::size_t>(p)];
    double step = 1e-5 * parameter.scale;
    if (theta[p] + step > parameter.upper) step = -step;
    Eigen::VectorXd at = theta;
    at[p] += step;
    steps.push_back(at[p] - theta[p]);
    moved.push_back(wheel_at(at));
  }
  const std::vector<Cell>& cells = observations_->cells;
  prediction.resize(static_cast<Eigen::Index>(cells.size()));
  jacobian.resize(prediction.size(), theta.size());
  std::size_t cell = 0;
  for (int row = 0; row < static_cast<int>(observations_->rows.size()); ++row) {
    const std::size_t first = cell;
    while (cell < cells.size() && cells[cell].row == row) ++cell;
    if (cell == first) continue;
    const OperatingCondition& at = observations_->rows[static_cast<std::size_t>(row)];
    const double theta_1 = angles.empty() ? wheel.roll(at).balance_angle : angles[static_cast<std::size_t>(row)];
    const double turn = 1e-6 * theta_1;
    const RolledWheel here = wheel.at_entry_angle(at, theta_1);
    const RolledWheel turned = wheel.at_entry_angle(at, theta_1 - turn);
    if (!all_finite(here.reading)) return false;
    const double stiffness = (here.forces.vertical - turned.forces.vertical) / turn;
    for (std::size_t i = first; i < cell; ++i)
      prediction[static_cast<Eigen::Index>(i)] = channel_of(here.reading, cells[i].channel);
    for (Eigen::Index p = 0; p < theta.size(); ++p) {
      const std::size_t q = static_cast<std::size_t>(p);
      const RolledWheel there = moved[q].at_entry_angle(at, theta_1);
      const double roll_by = -(there.forces.vertical - here.forces.vertical) / stiffness;
      for (std::size_t i = first; i < cell; ++i) {
        const int c = cells[i].channel;
        const double value = channel_of(here.reading, c);
        const double by_angle = (value - channel_of(turned.reading, c)) / turn;
        jacobian(static_cast<Eigen::Index>(i), p) =
            (channel_of(there.reading, c) - value + by_angle * roll_by) / steps[q];
      }
    }
  }
  return jacobian.allFinite();
} catch (const NoSolution&) {
  return false;
} catch (const InputError&) {
  return false;
} catch (const std::domain_error&) {
  return false;
}

bekker_wong::Reading WheelPredictor::reading(const Eigen::VectorXd& theta, const OperatingCondition& at) const {
  return RollingWheel(campaign_->wheel, soil(theta), effects(theta), campaign_->bin).roll(at).reading;
}

}  // namespace soilbin::compare
