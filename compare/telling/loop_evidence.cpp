// What a verdict rests on in words: names, odds, shares, reasons.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/titles.hpp"
#include "compare/measured/channels.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/loop_report.hpp"

namespace soilbin::compare {
namespace {

constexpr double noise_level = 0.05;  // p below which noise alone is no explanation

/// "4,000"
std::string thousands_apart(long long value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

/// Whether none of the simulated campaigns looked like this.
bool in_none(const ResidualSignatures& signatures) { return signatures.p_value * (signatures.simulations + 1.0) < 1.5; }

/// Unnamed in words, by its value.
constexpr std::string_view unnamed_words[] = {
    "a smooth function of the conditions",       "waves in one of the conditions",  "waves of one channel",
    "a gain of all forces that waves",           "what the run before left behind", "a channel that is not linear",
    "a slip or load that is not the one written"};

/// What shows that something is left: beside the base model, or after the best set of known effects.
struct SignWords {
  bool after_the_best;

  std::string operator()(const UnexplainedShare& left) const {
    return fmt::format("but the best set of known effects leaves {:.0f} % of it", 100 * left.share);
  }
  std::string operator()(const UnnamedEvidence& unnamed) const {
    return fmt::format(
        "{}a function of the conditions unlike any of them explains the {} {} better than noise: most like {}",
        after_the_best ? "and after the best set of known effects " : "", after_the_best ? "rest" : "residual",
        times_likelier(unnamed.gain), unnamed_words[static_cast<std::size_t>(unnamed.most_likely)]);
  }
  std::string operator()(const LackOfFit& fit) const {
    return fmt::format("the residual is more than noise (p = {:.2g})", fit.p_value);
  }
  std::string operator()(const RerunTest& reruns) const {
    return fmt::format(
        "{}more than their re-runs scatter (p = {:.2g})",
        after_the_best ? "and after the best set of known effects setpoints still deviate " : "setpoints deviate ",
        reruns.p_value);
  }
  std::string operator()(const SerialTest& serial) const {
    return fmt::format("the residuals of the {} are correlated between successive runs (p = {:.2g})",
                       serial.channel ? channel_views[*serial.channel].title : "forces", serial.p_value);
  }
};

/// A reason as a clause; numbers that several reasons share are those of the judgement.
struct ReasonWords {
  const Attribution& found;

  std::string operator()(const NoiseUnknown& noise) const {
    return fmt::format("the noise of a channel has only {:.1f} degrees of freedom, too few to judge by", noise.freedom);
  }
  std::string operator()(const NothingVisible&) const {
    return "no known effect would be visible in these data, whatever its size";
  }
  std::string operator()(const NoneStandsOut&) const {
    return fmt::format("the strongest of all known effects reaches p = {:.3g}", found.signatures.p_value);
  }
  std::string operator()(const NoGain& no) const {
    return fmt::format(
        "the best effect fits ({}) but does not improve cross-validated predictions (gain in ln density a condition "
        "{:.2g} +- {:.2g})",
        p_words(found.signatures), no.gain.mean, no.gain.std_error);
  }
  std::string operator()(const Refuted& errors) const {
    return fmt::format(
        "the best effect fits ({}), but with the effects that are found without them conditions left out are predicted "
        "worse: {:.4g} standard deviations of the noise, root mean square, in place of {:.4g}",
        p_words(found.signatures), errors.with, errors.without);
  }
  std::string operator()(const StandsOut&) const { return p_words(found.signatures) + " among the whole catalogue"; }
  std::string operator()(const NoneAccepted& none) const {
    return fmt::format("no known effect is accepted ({}), but {}", noise_verdict(found.signatures),
                       std::visit(SignWords{false}, none.sign));
  }
  std::string operator()(const MoreThanNamed& more) const {
    return fmt::format("the residual is real ({}), {}", noise_verdict(found.signatures),
                       std::visit(SignWords{true}, more.sign));
  }
  std::string operator()(const BaseModelWrong&) const {
    return fmt::format(
        "the base model errs by a smooth function of load and slip, {}; of the known effects {} comes nearest",
        noise_verdict(found.signatures), named_effects(found.best().ids));
  }
};

}  // namespace

std::string joined_with_and(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string joined(const std::set<std::string>& ids) {
  return ids.empty() ? "no effect" : fmt::format("{}", fmt::join(ids, " + "));
}

std::string named_effects(const std::set<std::string>& ids) {
  std::vector<std::string> names;
  for (const std::string& id : ids) names.emplace_back(bekker_wong::effect_title(id).name);
  return names.empty() ? "no effect" : joined_with_and(names);
}

std::string times_likelier(double log_odds) {
  constexpr double million = 1e6;
  const double odds = std::exp(log_odds);
  if (odds > million) return "more than a million times";
  if (odds < 10) return fmt::format("{:.2g} times", odds);
  const double step = std::pow(10.0, std::floor(std::log10(odds)) - 1);
  return thousands_apart(std::llround(std::round(odds / step) * step)) + " times";
}

std::string p_words(const ResidualSignatures& signatures) {
  return fmt::format("p {} {:.2g}", in_none(signatures) ? "<" : "=", signatures.p_value);
}

std::string noise_verdict(const ResidualSignatures& signatures) {
  return fmt::format("{}explained by noise ({})", signatures.p_value < noise_level ? "not " : "", p_words(signatures));
}

std::string reason_words(const TooFewValues& few) {
  return fmt::format("{} measured values of {} are too few for {} soil values", few.values,
                     counted(few.conditions, "condition"), few.soil_values);
}

std::string reason_words(const Judgement& judgement) {
  return std::visit(ReasonWords{judgement.found}, judgement.reason);
}

std::string formula_text(const LearnedFormula& formula) {
  std::string text = "g =";
  for (std::size_t k = 0; k < formula.terms.size(); ++k) {
    const Estimate& w = formula.weights[k];
    const bool negative = w.value < 0.0;
    const std::string term = formula.terms[k].text == "1" ? "" : " " + formula.terms[k].text;
    text += fmt::format(" {}({}){}", k == 0 ? (negative ? "-" : "") : (negative ? "- " : "+ "),
                        number(Estimate{std::abs(w.value), w.std_error}), term);
  }
  return text;
}

std::string share_words(double weight) {
  return weight < least_share ? "< 1 %" : fmt::format("{:.0f} %", 100 * weight);
}

}  // namespace soilbin::compare
