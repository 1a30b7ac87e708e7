#include "compare/test_design/effect_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "compare/fit/factorizations.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Rows at these conditions, each a condition of its own, with the channels that `noise` has.
Observations runs_to_make(const std::vector<OperatingCondition>& conditions, const ExpectedNoise& noise) {
  Observations runs;
  runs.rows = conditions;
  runs.conditions = static_cast<int>(conditions.size());
  for (int row = 0; row < runs.conditions; ++row) {
    runs.condition.push_back(row), runs.source_row.push_back(row);
    for (int c = 0; c < channel_count; ++c)
      if (noise[c]) runs.cells.push_back({row, c, 0.0});
  }
  return runs;
}

/// The runs with what the declared soil predicts as their values.
Observations as_declared(const Campaign& campaign, Observations runs) {
  const auto prediction = declared_prediction(campaign, runs);
  if (!prediction) throw NoSolution("the declared soil does not carry the wheel at one of the conditions");
  for (std::size_t i = 0; i < runs.cells.size(); ++i) runs.cells[i].value = (*prediction)[static_cast<Index>(i)];
  return runs;
}

/// The declared model, as a fit to its own predictions.
FittedModel declared_model(const Campaign& campaign, Observations runs, const NoiseFloor& noise) {
  const VectorXd values = runs.values();
  const auto data = std::make_shared<const Dataset>(Dataset{.campaign = std::make_shared<const Campaign>(campaign),
                                                            .observations = runs,
                                                            .outlier = std::vector<bool>(runs.cells.size(), false),
                                                            .noise = noise,
                                                            .whitening = Whitening(runs, noise, values)});
  const WheelPredictor predictor = data->declared_model();
  auto model = fitted(data, predictor, predictor.start());
  if (!model) throw NoSolution("the declared soil does not carry the wheel at one of the conditions");
  return *model;
}

/// The signature at the larger size of each term.
std::vector<Signature> large_secants(std::vector<Signature> all) {
  std::vector<Signature> kept;
  for (Signature& s : all) {
    if (!(s.projected_norm > 0.0)) continue;
    const bool again =
        !kept.empty() && kept.back().term.form == s.term.form && kept.back().term.defaults == s.term.defaults;
    if (again) kept.pop_back();
    kept.push_back(std::move(s));
  }
  return kept;
}

bool is_among(const std::vector<std::string>& wanted, const std::string& id) {
  return wanted.empty() || std::ranges::find(wanted, id) != wanted.end();
}

/// Effects of the catalogue that the campaign does not declare.
std::vector<std::string> undeclared_effects(const Campaign& campaign) {
  std::vector<std::string> ids = bekker_wong::effect_ids();
  for (const EffectChoice& declared : campaign.effects) std::erase(ids, declared.id);
  return ids;
}

/// Rows of one condition, columns of the shapes and the soil.
std::vector<MatrixXd> by_condition(const Observations& runs, const MatrixXd& columns) {
  std::vector<MatrixXd> parts;
  for (std::size_t i = 0, first = 0; i < runs.rows.size(); ++i) {
    std::size_t last = first;
    while (last < runs.cells.size() && runs.cells[last].row == static_cast<int>(i)) ++last;
    parts.emplace_back(columns.middleRows(static_cast<Index>(first), static_cast<Index>(last - first)));
    first = last;
  }
  return parts;
}

/// D at amplitude 1 of a truth beside the nearest form of each effect, and beside none at the end.
std::vector<double> distances(const EffectShapes& shapes, const MatrixXd& s, Index truth) {
  std::vector<double> least(shapes.ids.size() + 1, std::max(0.0, s(truth, truth)));
  for (Index g = 0; g < s.cols(); ++g) {
    const EffectShape& other = shapes.shapes[g];
    const double along = s(truth, g);
    if (!(s(g, g) > 0.0) || (along < 0.0 && other.one_sided && shapes.shapes[truth].one_sided)) continue;
    double& d = least[other.effect];
    d = std::min(d, std::max(0.0, s(truth, truth) - along * along / s(g, g)));
  }
  return least;
}

double chance_named_right(double distance) { return 0.5 * std::erfc(-std::sqrt(distance) / (2 * std::sqrt(2.0))); }

}  // namespace

MatrixXd EffectShapes::information_of(std::size_t condition) const {
  return sensitivities[condition].transpose() * sensitivities[condition];
}

MatrixXd EffectShapes::off_soil(const MatrixXd& information) const {
  const Index k = static_cast<Index>(shapes.size());
  MatrixXd of_soil = information.bottomRightCorner(soil, soil);
  of_soil.diagonal().array() += 1.0;  // the priors
  const MatrixXd shared = information.bottomLeftCorner(soil, k);
  return information.topLeftCorner(k, k) - shared.transpose() * Cholesky(of_soil).solve(shared);
}

ExpectedNoise usual_noise(const Campaign& campaign, const std::vector<OperatingCondition>& conditions) {
  ExpectedNoise all;
  all.fill(0.0);
  const Observations runs = as_declared(campaign, runs_to_make(conditions, all));
  ExpectedNoise noise;
  for (int c = 0; c < channel_count; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Cell& cell : runs.cells)
      if (cell.channel == c) low = std::min(low, cell.value), high = std::max(high, cell.value);
    noise[c] = thresholds::typical_noise_share * std::max({high - low, 0.1 * std::abs(high), 0.1 * std::abs(low)});
  }
  const bool aside = std::ranges::any_of(
      conditions, [](const OperatingCondition& at) { return at.yaw != 0.0 || at.transverse_incline != 0.0; });
  if (!aside) noise[lateral_force].reset();
  return noise;
}

EffectShapes effect_shapes(const Campaign& campaign, const std::vector<OperatingCondition>& conditions,
                           std::size_t spread, const ExpectedNoise& noise, const std::vector<std::string>& wanted,
                           const ThreadPool& pool) {
  EffectShapes found;
  for (int c = 0; c < channel_count; ++c)
    if (noise[c]) found.noise.channels[c] = {.measured = true, .floor = *noise[c]};
  const Observations runs = as_declared(campaign, runs_to_make(conditions, noise));
  const FittedModel model = declared_model(campaign, runs, found.noise);
  const std::vector<Signature> signatures = large_secants(residual_signatures(model, problem_of(model), pool));
  const Index cells = model.data().cells(), k = static_cast<Index>(signatures.size());
  found.soil = model.fit().columns.cols();
  MatrixXd columns(cells, k + found.soil);
  for (Index i = 0; i < k; ++i) columns.col(i) = signatures[i].white;
  columns.rightCols(found.soil) = model.fit().columns.topRows(cells);

  // Sizes, and whether a form reaches them.
  found.shapes.resize(signatures.size());
  const std::vector<MatrixXd> whole = by_condition(runs, columns);
  MatrixXd information = MatrixXd::Zero(k + found.soil, k + found.soil);
  for (std::size_t i = 0; i < spread; ++i) information += whole[i].transpose() * whole[i];
  const VectorXd seen = found.off_soil(information).diagonal();
  std::vector<Index> kept;
  std::map<std::string, std::size_t> places;
  std::vector<EffectShape> shapes;
  for (Index i = 0; i < k; ++i) {
    const bekker_wong::EffectForm& form = *signatures[i].term.form;
    const bekker_wong::EffectParameter& p = form.parameters.front();
    const double amplitude = std::sqrt(static_cast<double>(spread) / std::max(seen[i], 1e-300));
    if (!is_among(wanted, form.id) || !(amplitude <= std::max(std::abs(p.lower), std::abs(p.upper)))) continue;
    const auto [place, is_new] = places.emplace(form.id, found.ids.size());
    if (is_new) found.ids.push_back(form.id);
    shapes.push_back({place->second, signatures[i].one_sided, amplitude});
    kept.push_back(i);
  }
  found.shapes = std::move(shapes);
  for (Index i = 0; i < found.soil; ++i) kept.push_back(k + i);
  for (const std::string& id : undeclared_effects(campaign))
    if (is_among(wanted, id) && !places.contains(id)) found.not_shown.push_back(id);
  // Columns at the size of each shape, so that S_ff is its D beside nothing.
  for (const MatrixXd& part : whole) {
    MatrixXd sensitivities = part(Eigen::all, kept);
    for (std::size_t f = 0; f < found.shapes.size(); ++f)
      sensitivities.col(static_cast<Index>(f)) *= found.shapes[f].amplitude;
    found.sensitivities.push_back(std::move(sensitivities));
  }
  return found;
}

std::vector<CandidatePair> candidate_pairs(const EffectShapes& shapes, const MatrixXd& information) {
  const MatrixXd s = shapes.off_soil(information);
  const std::size_t effects = shapes.ids.size();
  std::vector<CandidatePair> all;
  std::vector<double> forms(effects, 0.0);
  for (std::size_t truth = 0; truth < effects; ++truth)
    for (std::size_t other = 0; other <= effects; ++other)
      all.push_back({truth, other < effects ? std::optional(other) : std::nullopt, 0.0, 0.0});
  for (std::size_t f = 0; f < shapes.shapes.size(); ++f) {
    const std::size_t truth = shapes.shapes[f].effect;
    const std::vector<double> d = distances(shapes, s, static_cast<Index>(f));
    forms[truth] += 1.0;
    for (std::size_t other = 0; other <= effects; ++other) {
      CandidatePair& r = all[truth * (effects + 1) + other];
      r.separation += std::sqrt(d[other]), r.right += chance_named_right(d[other]);
    }
  }
  for (CandidatePair& r : all) r.separation /= forms[r.truth], r.right /= forms[r.truth];
  std::erase_if(all, [](const CandidatePair& r) { return r.other == r.truth; });
  return all;
}

double share_named_right(const EffectShapes& shapes, const MatrixXd& information) {
  const MatrixXd s = shapes.off_soil(information);
  std::vector<double> right(shapes.ids.size(), 0.0), forms(shapes.ids.size(), 0.0);
  for (std::size_t f = 0; f < shapes.shapes.size(); ++f) {
    const std::size_t truth = shapes.shapes[f].effect;
    const std::vector<double> d = distances(shapes, s, static_cast<Index>(f));
    double all = 1.0;
    for (std::size_t other = 0; other < d.size(); ++other)
      if (other != truth) all *= chance_named_right(d[other]);
    right[truth] += all, forms[truth] += 1.0;
  }
  double sum = 0.0;
  for (std::size_t e = 0; e < right.size(); ++e) sum += right[e] / forms[e];
  return right.empty() ? 0.0 : sum / static_cast<double>(right.size());
}

}  // namespace soilbin::compare
