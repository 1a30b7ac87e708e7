// The loop's second reading: a base model whose form isn't the soil's, and an effect beside that.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "compare/attribution/candidates.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {
namespace {

/// Runs of a soil that no pressure-sinkage curve describes: pull and sinkage are off by what bends over the loads and
/// slips and belongs to no effect.
Campaign odd_soil(const std::vector<EffectChoice>& effects) {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), effects, fine_noise, 41);
  for (Run& run : campaign.runs) {
    const double load = (run.at.load - 600) / 900, slip = run.at.slip / 0.7;
    *run.drawbar_pull += 40.0 * std::sin(4.0 * slip) * (1 - 1.6 * load);
    *run.sinkage += 2e-3 * std::cos(4.0 * slip) * (1 - 1.6 * load);
  }
  return campaign;
}

LoopAnswer asked(const Campaign& campaign) {
  LoopOptions options;
  options.attribution.simulations = 1000;
  options.validate = false;
  return run_loop(campaign, options);
}

/// Small data with a few cells a row, for identities.
FittedModel settled() {
  Campaign campaign = sand_campaign();
  measure(campaign, sweep(), {}, fine_noise, 43);
  return fit_base(campaign, observe(campaign), {});
}

// |W v|^2 = v' (C + U U')^-1 v, where U's columns had been whitened by C alone.
TEST(Whitening, BesideATermIsThatOfTheirJointCovariance) {
  const FittedModel base = settled();
  const Eigen::Index cells = base.data().cells();
  const Eigen::MatrixXd term = 0.5 * model_discrepancy_columns(base);
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(cells, -1.0, 2.0), white = base.data().whitening(v);
  const Eigen::MatrixXd joint = Eigen::MatrixXd::Identity(cells, cells) + term * term.transpose();
  EXPECT_NEAR(base.data().whitening.beside(term)(v).squaredNorm(), white.dot(joint.ldlt().solve(white)),
              1e-9 * white.squaredNorm());
}

// A trial point is given up once the rows read so far cost more than the best one in all: right only if no partial sum
// passes the whole, in whatever order rows are read, and the last one is the whole.
TEST(PartialChi2, NeverPassesTheWholeAndEndsAtIt) {
  const FittedModel base = settled();
  const Observations& seen = base.data().observations;
  const Eigen::VectorXd residual = Eigen::VectorXd::LinSpaced(base.data().cells(), -3.0, 2.0);
  for (const Whitening& whitening :
       {base.data().whitening, base.data().whitening.beside(0.5 * model_discrepancy_columns(base))}) {
    const double whole = whitening(residual).squaredNorm() + 4.0;
    PartialChi2 partial(whitening);
    partial.add(4.0);  // a prior's square
    const auto last = static_cast<Eigen::Index>(seen.cells.size());
    for (Eigen::Index end = last; end > 0;) {  // rows from the last to the first
      Eigen::Index first = end - 1;
      while (first > 0 && seen.cells[first - 1].row == seen.cells[first].row) --first;
      EXPECT_FALSE(partial.exceeds(whole * (1 - 1e-12)));
      partial.add(first, residual.segment(first, end - first));
      end = first;
    }
    EXPECT_TRUE(partial.exceeds(whole * (1 - 1e-9)));
    EXPECT_FALSE(partial.exceeds(whole * (1 + 1e-9)));
  }
}

// ln N(r; 0, 1 + s^2 U U') - ln N(r; 0, 1), by the joint covariance itself.
TEST(JoinedColumns, GainTheRatioOfNormalDensities) {
  const FittedModel base = settled();
  const Eigen::Index cells = base.data().cells();
  const Eigen::MatrixXd columns = model_discrepancy_columns(base);
  LinearProblem problem;
  problem.cells = cells;
  problem.residual = 2 * columns.col(1) + Eigen::VectorXd::LinSpaced(cells, -1.0, 1.0);
  problem.nuisance = Eigen::MatrixXd(cells, 0);
  for (const double size : thresholds::term_sizes) {
    const Eigen::MatrixXd joint = Eigen::MatrixXd::Identity(cells, cells) + size * size * columns * columns.transpose();
    const Eigen::LLT<Eigen::MatrixXd> factor(joint);
    const double quadratic = problem.residual.dot(factor.solve(problem.residual));
    const double log_determinant = 2 * factor.matrixLLT().diagonal().array().log().sum();
    EXPECT_NEAR(JoinedColumns(problem, columns).gain(size),
                0.5 * (problem.residual.squaredNorm() - quadratic - log_determinant),
                1e-8 * problem.residual.squaredNorm())
        << size;
  }
}

/// The share of a set in the answer's details; -1 where it isn't there.
double share_in_details(const LoopAnswer& answer, const std::set<std::string>& ids) {
  const auto details = details_json(answer);
  for (const auto& set : details.at("sets"))
    if (set.at("effects") == nlohmann::ordered_json(ids)) return set.at("weight").get<double>();
  return -1.0;
}

std::string all_words(const LoopAnswer& answer) {
  std::string words;
  for (const std::string& sentence : in_sentences(answer)) words += sentence + "\n";
  return words;
}

/// Each set's share is one number: in the list, the JSON with its details, the table and the sentence.
void expect_same_shares(const LoopAnswer& answer) {
  const auto sets = to_json(answer).at("ambiguity_set");
  const Table table = candidates_table(answer);
  const std::string words = all_words(answer);
  const std::size_t decided = answer.ambiguity_set().size();
  ASSERT_EQ(sets.size(), decided + (answer.second() ? answer.second()->sets.size() : 0));
  double sum = 0.0;
  for (std::size_t i = 0; i < decided; ++i) {
    const WeightedSet& w = answer.ambiguity_set()[i];
    SCOPED_TRACE(joined(w.ids));
    sum += w.weight;
    EXPECT_EQ(sets.at(i).at("effects"), nlohmann::ordered_json(w.ids));
    EXPECT_EQ(sets.at(i).at("weight").get<double>(), w.weight);
    EXPECT_EQ(share_in_details(answer, w.ids), w.weight);
    const std::string share = w.weight < 0.005 ? "< 1 %" : fmt::format("{:.0f} %", 100 * w.weight);
    EXPECT_EQ(table.rows.at(i).at(0).text, named_effects(w.ids));
    EXPECT_EQ(table.rows.at(i).at(0).note, joined(w.ids) == named_effects(w.ids) ? "" : joined(w.ids));
    EXPECT_EQ(table.rows.at(i).at(2).text, share);
    const double listed = answer.verdict() == Verdict::unknown_effect ? 0.05 : 0.005;  // smaller ones are counted
    const bool said = decided > 1 && (i == 0 || w.weight >= listed);
    EXPECT_EQ(words.find(fmt::format("{} ({})", named_effects(w.ids), share)) != std::string::npos, said) << words;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  for (std::size_t i = decided; i < table.rows.size(); ++i) EXPECT_EQ(table.rows[i][2].text, "-");
  for (std::size_t i = decided; i < sets.size(); ++i) {
    EXPECT_EQ(sets.at(i).at("weight"), 0.0);
    EXPECT_EQ(sets.at(i).at("of_other_reading"), true);
  }
}

/// The saved model is the set that the list puts first, or none; and what was learned beside it.
void expect_the_decided_model(const Campaign& campaign, const LoopAnswer& answer) {
  const Case model = resolved_model(campaign, answer);
  std::set<std::string> saved;
  for (const EffectChoice& choice : model.study.models.front().effects) saved.insert(choice.id);
  EXPECT_EQ(saved, ids_of(answer.proxy_effects()));
  EXPECT_EQ(saved.erase("learned"), answer.learned().empty() ? 0U : 1U);
  EXPECT_TRUE(saved.empty() || saved == answer.ambiguity_set().front().ids);
  const HeldOutErrors& all = answer.validation.overall;
  if (answer.learned().empty()) {
    EXPECT_EQ(answer.uses_effects(), all.after < all.before);
  }
}

// Beside the odd soil a second pass bears more. Read by the base model alone, named effects are bent to make up for the
// soil; read with a model discrepancy, what is left is the rut that was compacted. That reading explains the data
// better, so it decides all that is told; the other one is a note.
TEST(SlowModelDiscrepancy, ShowsTheEffectBesideAnOddSoil) {
  const Campaign campaign = odd_soil({{"multipass", "", {{"a", 0.3}}}});
  const LoopAnswer answer = asked(campaign);
  ASSERT_EQ(answer.verdict(), Verdict::unknown_effect);
  ASSERT_TRUE(answer.second() && answer.second()->decides);
  EXPECT_TRUE(std::holds_alternative<BaseModelWrong>(answer.judgement()->reason));
  ASSERT_TRUE(answer.judgement() && answer.found().candidates.best);
  EXPECT_EQ(answer.found().best().ids, std::set<std::string>{"multipass"});
  EXPECT_LT(answer.found().signatures.p_value, 0.01);
  EXPECT_EQ(answer.ambiguity_set().front().ids, std::set<std::string>{"multipass"});
  expect_same_shares(answer);
  expect_the_decided_model(campaign, answer);
  const auto json = to_json(answer);
  EXPECT_EQ(json.at("beside_inadequacy").at("effects"), nlohmann::ordered_json({"multipass"}));
  EXPECT_EQ(json.at("beside_inadequacy").at("decides"), true);
  const std::vector<std::string> words = in_sentences(answer);
  EXPECT_EQ(std::count_if(words.begin(), words.end(),
                          [](const std::string& sentence) {
                            return sentence.starts_with("Second analysis, with the base model taken as exact");
                          }),
            1);
}

// What the list puts first need not fit best: then the words say why it is taken.
TEST(SlowModelDiscrepancy, SaysWhyASetIsTakenThatAnotherOneOutweighs) {
  const LoopAnswer answer = asked(odd_soil({}));
  const WeightedSet& taken = answer.ambiguity_set().front();
  const WeightedSet& heaviest =
      *std::max_element(answer.ambiguity_set().begin(), answer.ambiguity_set().end(),
                        [](const WeightedSet& a, const WeightedSet& b) { return a.weight < b.weight; });
  ASSERT_LT(taken.weight, heaviest.weight);
  EXPECT_NE(all_words(answer).find(fmt::format("The model uses {}: what {} adds does not improve predictions.",
                                               named_effects(taken.ids), named_effects(heaviest.ids))),
            std::string::npos)
      << all_words(answer);
}

// Where there is nothing but the odd soil, the second reading names nothing, and the verdict says that it is unknown.
TEST(SlowModelDiscrepancy, NamesNothingBesideNothingButAnOddSoil) {
  const Campaign campaign = odd_soil({});
  const LoopAnswer answer = asked(campaign);
  ASSERT_EQ(answer.verdict(), Verdict::unknown_effect);
  ASSERT_TRUE(answer.second());
  EXPECT_FALSE(answer.second()->decides);
  EXPECT_FALSE(answer.second()->alternative.candidates.best);
  EXPECT_GT(answer.second()->alternative.signatures.p_value, 0.05);
  expect_same_shares(answer);
  expect_the_decided_model(campaign, answer);
  EXPECT_EQ(to_json(answer).at("beside_inadequacy").at("effects").size(), 0u);
}

}  // namespace
}  // namespace soilbin::compare
