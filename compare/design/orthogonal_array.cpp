#include "compare/design/orthogonal_array.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "bekker_wong/gsl.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {
namespace {

bool is_prime(int q) {
  for (int d = 2; d * d <= q; ++d)
    if (q % d == 0) return false;
  return q >= 2;
}

/// Product of two polynomials over GF(2), modulo x^2 + x + 1.
int product_in_gf4(int a, int b) {
  int product = ((b & 1) ? a : 0) ^ ((b & 2) ? a << 1 : 0);
  if (product & 4) product ^= 0b111;
  return product;
}

}  // namespace

GaloisField::GaloisField(int q) : size_(q) {
  if (q != 4 && (q > 31 || !is_prime(q)))
    throw std::invalid_argument(fmt::format("no table of a field with {} elements", q));
  for (int a = 0; a < q; ++a)
    for (int b = 0; b < q; ++b) {
      sums_.push_back(q == 4 ? a ^ b : (a + b) % q);
      products_.push_back(q == 4 ? product_in_gf4(a, b) : a * b % q);
    }
}

LevelTable orthogonal_array(int levels) {
  const GaloisField field(levels);
  LevelTable table{levels, {}};
  for (int a = 0; a < levels; ++a)
    for (int b = 0; b < levels; ++b) {
      std::vector<int> row{a, b};
      for (int m = 1; m < levels; ++m) row.push_back(field.sum(b, field.product(m, a)));
      table.rows.push_back(std::move(row));
    }
  return table;
}

LevelTable named_array(const std::string& name) {
  if (name == "L9") return orthogonal_array(3);
  if (name == "L16") return orthogonal_array(4);
  if (name == "L25") return orthogonal_array(5);
  const std::vector<std::string> names{"L9", "L16", "L25"};
  throw InputError(fmt::format("unknown orthogonal array '{}'{}\n  hint: there are {}", clipped(name),
                               did_you_mean(name, names), listed(names)));
}

LevelTable first_columns(const LevelTable& table, int columns) {
  if (columns > table.columns())
    throw InputError(
        fmt::format("{} factors need an array of as many columns, and this one has {}", columns, table.columns()));
  LevelTable part = table;
  for (std::vector<int>& row : part.rows) row.resize(static_cast<std::size_t>(columns));
  return part;
}

bool is_balanced(const LevelTable& table) {
  const std::size_t levels = static_cast<std::size_t>(table.levels),
                    columns = static_cast<std::size_t>(table.columns());
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = i + 1; j < columns; ++j) {
      std::vector<int> met(levels * levels, 0);
      for (const std::vector<int>& row : table.rows)
        ++met[static_cast<std::size_t>(row[i]) * levels + static_cast<std::size_t>(row[j])];
      if (std::ranges::adjacent_find(met, std::not_equal_to<>()) != met.end()) return false;
    }
  return true;
}

namespace {

double average_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double total_about_mean(const std::vector<double>& values) {
  const double mean = average_of(values);
  return std::accumulate(values.begin(), values.end(), 0.0,
                         [mean](double sum, double y) { return sum + (y - mean) * (y - mean); });
}

void give_f(VarianceRow& row, const AnalysisOfVariance& analysis) {
  row.f = row.mean_square / analysis.error_mean_square;
  row.p_value = std::isinf(analysis.error_freedom) ? gsl::chi_square_tail(row.f * row.freedom, row.freedom)
                                                   : gsl::f_tail(row.f, row.freedom, analysis.error_freedom);
}

/// Takes the lower half of the factors for error.
void pool(AnalysisOfVariance& analysis) {
  std::vector<std::size_t> rising(analysis.factors.size());
  std::iota(rising.begin(), rising.end(), 0);
  std::ranges::sort(rising, [&](std::size_t a, std::size_t b) {
    return analysis.factors[a].sum_of_squares < analysis.factors[b].sum_of_squares;
  });
  rising.resize(std::max<std::size_t>(1, rising.size() / 2));
  double sum = 0.0;
  for (const std::size_t j : rising) {
    analysis.factors[j].pooled = true;
    sum += analysis.factors[j].sum_of_squares;
    analysis.error_freedom += analysis.factors[j].freedom;
  }
  analysis.error_from = ErrorFrom::pooled_factors;
  analysis.error_mean_square = sum / analysis.error_freedom;
}

void find_error(AnalysisOfVariance& analysis, std::optional<double> noise_variance) {
  if (noise_variance) {
    analysis.error_from = ErrorFrom::known_noise;
    analysis.error_mean_square = *noise_variance;
    analysis.error_freedom = std::numeric_limits<double>::infinity();
  } else if (analysis.left.freedom > 0) {
    analysis.error_mean_square = analysis.left.mean_square;
    analysis.error_freedom = analysis.left.freedom;
  } else {
    pool(analysis);
  }
}

}  // namespace

RangeAnalysis range_analysis(const LevelTable& design, const std::vector<double>& responses) {
  if (responses.size() != design.rows.size() || !is_balanced(design))
    throw std::invalid_argument("range analysis needs a balanced design and a response for each of its runs");
  const std::size_t levels = static_cast<std::size_t>(design.levels);
  const double at_a_level = static_cast<double>(design.runs()) / design.levels;
  RangeAnalysis analysis;
  for (int j = 0; j < design.columns(); ++j) {
    FactorRange factor{std::vector<double>(levels, 0.0), {}, 0.0};
    for (std::size_t run = 0; run < responses.size(); ++run) factor.sums[design.rows[run][j]] += responses[run];
    for (const double sum : factor.sums) factor.means.push_back(sum / at_a_level);
    const auto [least, most] = std::ranges::minmax_element(factor.means);
    factor.range = *most - *least;
    analysis.factors.push_back(std::move(factor));
    analysis.order.push_back(j);
  }
  std::ranges::stable_sort(analysis.order,
                           [&](int a, int b) { return analysis.factors[a].range > analysis.factors[b].range; });
  return analysis;
}

AnalysisOfVariance analysis_of_variance(const LevelTable& design, const std::vector<std::string>& factors,
                                        const std::vector<double>& responses, std::optional<double> noise_variance) {
  const RangeAnalysis ranges = range_analysis(design, responses);
  const double mean = average_of(responses), at_a_level = static_cast<double>(design.runs()) / design.levels;
  AnalysisOfVariance analysis;
  analysis.total = total_about_mean(responses);
  analysis.left = {"left over", analysis.total, design.runs() - 1, 0.0, not_a_number, not_a_number, false};
  for (std::size_t j = 0; j < ranges.factors.size(); ++j) {
    VarianceRow row{factors.at(j), 0.0, design.levels - 1, 0.0, not_a_number, not_a_number, false};
    for (const double k : ranges.factors[j].means) row.sum_of_squares += at_a_level * (k - mean) * (k - mean);
    row.mean_square = row.sum_of_squares / row.freedom;
    analysis.left.sum_of_squares -= row.sum_of_squares;
    analysis.left.freedom -= row.freedom;
    analysis.factors.push_back(std::move(row));
  }
  analysis.left.sum_of_squares = std::max(0.0, analysis.left.sum_of_squares);  // rounding of what cancels
  if (analysis.left.freedom > 0) analysis.left.mean_square = analysis.left.sum_of_squares / analysis.left.freedom;
  find_error(analysis, noise_variance);
  for (VarianceRow& row : analysis.factors)
    if (!row.pooled) give_f(row, analysis);
  if (noise_variance && analysis.left.freedom > 0) give_f(analysis.left, analysis);
  return analysis;
}

}  // namespace soilbin::compare
