#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <utility>

#include "bekker_wong/effects/titles.hpp"
#include "bekker_wong/learned.hpp"
#include "compare/attribution/choice.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/soil_parameters.hpp"

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

namespace {

std::string condition_words(const LoopAnswer& answer) {
  std::string text;
  for (const std::string& name : answer.next()->quantities) {
    const auto [value, unit] = next_setting(answer, answer.next()->at, name);
    if (value.empty()) continue;
    text += fmt::format("{}{} {}{}{}", text.empty() ? "" : ", ", condition_view(name).title, value,
                        unit.empty() ? "" : " ", unit);
  }
  return text;
}

/// What to do where no condition shows on which the rest depends.
std::vector<std::string> without_a_condition(const LoopAnswer& answer) {
  const UnnamedEvidence& unnamed = answer.found().unnamed;
  if (unnamed.gain > thresholds::unnamed_instead && unnamed.most_likely == Unnamed::misread_condition)
    return {"Before more runs, check how slip and load are measured, and at which conditions.",
            "The unexplained part looks like a misread slip or load."};
  if (answer.judgement()->before.serial.p_value <= thresholds::serial_level)
    return {"Measure one setpoint, repeated through the whole campaign.",
            "The unexplained part changes from run to run, not by chance."};
  return {"Vary one condition alone, each setting run twice.", "The cause of the unexplained part is not visible yet."};
}

/// What has no name predicts nothing; but where it shows can be said.
std::vector<std::string> to_show_its_shape(const LoopAnswer& answer) {
  const std::vector<Dependence> sure = sure_dependences(answer);
  if (sure.empty()) return without_a_condition(answer);
  const Dependence& on = sure.front();
  const std::string variable = spaced(condition_view(on.variable).title);
  return {on.variable == "run"
              ? "Measure one setpoint, repeated through the whole campaign."
              : fmt::format("Measure several settings of the {} alone, each one twice, all else kept.", variable),
          fmt::format("The unexplained part of the {} depends most on the {} (p = {:.2g}; false-discovery rate over {} "
                      "pairs of channel and variable: {}).",
                      channel_views[on.channel].title, variable, on.p_value, dependences_left(answer).size(),
                      share_words(on.false_discovery_rate))};
}

std::string next_behind(const LoopAnswer& answer) {
  const WeightedSet* next = next_standing(answer.found().candidates, answer.found().best().ids);
  return named_effects(next ? next->ids : std::set<std::string>());
}

/// The run that sets the candidates apart: what to do, then why.
std::vector<std::string> to_set_apart(const LoopAnswer& answer) {
  const NextRun& next = *answer.next();
  const std::string ahead = named_effects(next.separates.front()), behind = named_effects(next.separates.back());
  std::vector<std::string> sentences;
  if (answer.verdict() == Verdict::unknown_effect)
    sentences = {fmt::format("To choose between the nearest known effects, measure {}.", condition_words(answer))};
  else if (answer.ambiguity_set().size() == 1)
    sentences = {fmt::format("To confirm, measure {}.", condition_words(answer)),
                 fmt::format("There it differs most from the next candidate, {}: by {:.1f} standard deviations of one "
                             "run.",
                             behind, std::sqrt(next.distance))};
  else
    sentences = {fmt::format("Measure {}.", condition_words(answer))};
  if (sentences.size() == 1)
    sentences.push_back(
        fmt::format("{} run{} there should decide: {} or {}.", next.runs, next.runs == 1 ? "" : "s", ahead, behind));
  std::vector<std::string> names, beyond = beyond_what_is_known(next);
  if (beyond.empty()) return sentences;
  for (const std::string& name : beyond) names.push_back(spaced(name));
  sentences.push_back(
      fmt::format("Its {} lie{} beyond the measured range; if your rig cannot reach it, give --limit {}=LOW..HIGH.",
                  joined_with_and(names), names.size() == 1 ? "s" : "", beyond.front()));
  return sentences;
}

}  // namespace

std::vector<std::string> what_next(const LoopAnswer& answer) {
  std::vector<std::string> sentences;
  if (answer.verdict() == Verdict::unknown_effect) {
    sentences = to_show_its_shape(answer);
  } else if (!proposes_next(answer)) {
    if (answer.verdict() == Verdict::effect_found && is_settled(answer.found().candidates))
      return {fmt::format("No further run is needed to choose the effect: the next candidate, {}, is {} less likely.",
                          next_behind(answer), times_likelier(lead(answer.found().candidates)))};
    if (answer.ambiguity_set().size() > 1)
      return {"No condition within the limits separates these candidates in 50 runs."};
    if (answer.verdict() == Verdict::effect_found && answer.ambiguity_set().size() == 1)
      return {"One candidate is left; no condition within the limits confirms it further in one run."};
  }
  if (proposes_next(answer))
    for (std::string& sentence : to_set_apart(answer)) sentences.push_back(std::move(sentence));
  return sentences;
}

std::string setting(double value) {
  if (std::abs(value) < 1e-9) return "0";
  return fmt::format("{:.10g}", three_digits(value));
}

std::pair<std::string, std::string> next_setting(const LoopAnswer& answer, const OperatingCondition& at,
                                                 const std::string& condition) {
  const auto [unit, per_si] = own_unit(answer.found().base.data().campaign->columns, condition_view(condition));
  const double set = rig_setting_of(answer, at, condition);
  return {std::isfinite(set) ? fmt::format("{:.6g}", per_si * set) : "", unit};
}

namespace {

using bekker_wong::effect_title;

constexpr double worth_listing = 0.05;  // share of the evidence, in a sentence, where a table lists them all

// What is missing.

/// "slip 5 to 70 %, load 40 to 90 N": where learned changes hold.
std::string learned_ranges(const std::vector<EffectChoice>& learned) {
  std::vector<std::string> ranges;
  for (const EffectChoice& choice : learned)
    for (const auto& variable : bekker_wong::learned_function(bekker_wong::find_form(choice)).variables) {
      const std::string name(variable.name);
      const ConditionView& view = condition_view(name);
      std::string range = fmt::format(
          "{} {} to {}{}{}", view.title, setting(view.per_si * choice.parameters.at(name + "_from")),
          setting(view.per_si * choice.parameters.at(name + "_to")), view.unit.empty() ? "" : " ", view.unit);
      if (std::ranges::find(ranges, range) == ranges.end()) ranges.push_back(std::move(range));
    }
  return joined_with_and(ranges);
}

/// "slip sinkage, and, learned from these runs (for slip 5 to 70 %), changes of the torque by slip and the pull by
/// slip".
std::string proxy_words(const LoopAnswer& answer) {
  std::vector<std::string> named, changes;
  std::vector<EffectChoice> learned;
  for (const AcceptedEffect& effect : answer.proxy_effects())
    if (effect.choice.id == bekker_wong::learned_id) {
      learned.push_back(effect.choice);
      changes.push_back("the " + spaced(effect.choice.form));
    } else {
      named.emplace_back(effect_title(effect.choice.id).name);
    }
  if (learned.empty()) return joined_with_and(named);
  return fmt::format("{}{}learned from these runs (for {}), {} of {}", joined_with_and(named),
                     named.empty() ? "" : ", and, ", learned_ranges(learned),
                     learned.size() > 1 ? "changes" : "a change", joined_with_and(changes));
}

/// "(W_n: the load normal to the ground)": the symbols that a formula has; "" where it has none of its own.
std::string legend_of(const std::string& formula) {
  const std::pair<const char*, const char*> symbols[] = {{"W_n", "the load normal to the ground"}, {"r", "the radius"}};
  std::string text;
  for (const auto& [symbol, meaning] : symbols)
    if (std::regex_search(formula, std::regex(fmt::format("\\b{}\\b", symbol))))
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", symbol, meaning);
  return text.empty() ? "" : " (" + text + ")";
}

/// The learned change as people would write it.
std::string formula_sentence(const LearnedFormula& formula) {
  const std::string text = fmt::format("{}, with {}", formula.joint, formula_text(formula));
  return fmt::format(" Equally good formula: {}{}.", text, legend_of(text));
}

/// Sets from the first one on, with their shares; those below `least`, of the evidence, are only counted.
std::string sets_with_shares(const std::vector<WeightedSet>& sets, std::size_t first, double least) {
  std::vector<std::string> said;
  std::size_t unsaid = 0;
  for (std::size_t i = first; i < sets.size(); ++i)
    if (i > 0 && sets[i].weight < least)
      ++unsaid;
    else
      said.push_back(fmt::format("{} ({})", named_effects(sets[i].ids), share_words(sets[i].weight)));
  if (unsaid > 0) said.push_back(fmt::format("{} more of less than {:.0f} % each", unsaid, std::ceil(100 * least)));
  return fmt::format("{}", fmt::join(said, "; "));
}

/// Why the first set is taken where another one has the larger share; "" where none has.
std::string why_taken(const std::vector<WeightedSet>& sets) {
  const auto lighter = [](const WeightedSet& a, const WeightedSet& b) { return a.weight < b.weight; };
  const WeightedSet &taken = sets.front(), &heaviest = *std::ranges::max_element(sets, lighter);
  if (heaviest.ids == taken.ids) return "";
  return fmt::format(" The model uses {}: what {} adds does not improve predictions.", named_effects(taken.ids),
                     named_effects(heaviest.ids));
}

/// How far behind the best set the next one stands, where the best stands alone. The odds are those of the catalogue's
/// own equations; how often such a lead is right where nature has others was counted: 88 of 97 synthetic campaigns
/// (docs/lab/loop-ceiling.md, "Accuracy against the share answered").
std::string next_candidate(const LoopAnswer& answer) {
  const std::vector<const WeightedSet*> sets = sets_shown(answer);
  if (answer.ambiguity_set().size() != 1 || sets.size() < 2) return "";
  const double behind = sets[0]->log_evidence - sets[1]->log_evidence;
  if (!(behind > 0)) return "";
  constexpr double clear_share = 0.9;
  return fmt::format(
      "Next candidate: {}, {} less likely{}.", named_effects(sets[1]->ids), times_likelier(behind),
      sets[0]->weight < clear_share
          ? ""
          : " by the catalogue's equations (in tests with other equations 9 in 10 such names were right)");
}

/// What an accepted effect takes the wheel to have and the campaign does not declare: without it the verdict misleads.
std::string presumed_of_the_wheel(const LoopAnswer& answer) {
  std::string text;
  for (const AcceptedEffect& effect : answer.effects()) {
    std::string values;
    for (const bekker_wong::Presumed& value :
         bekker_wong::presumed(bekker_wong::find_form(effect.choice), answer.wheel))
      values += (values.empty() ? "" : ", ") + value.words;
    if (!values.empty())
      text += fmt::format(
          " Not declared and assumed for {0}: {1}. If the wheel has none, something that acts like {0} is missing.",
          effect_title(effect.choice.id).name, values);
  }
  return text;
}

/// How often noise alone would look like this, or why nothing is known by that; "" where nothing was judged.
std::string odds_clause(const LoopAnswer& answer) {
  if (!answer.judgement() || answer.verdict() == Verdict::not_enough_data) return "";
  if (answer.verdict() == Verdict::unknown_effect) return reason_words(*answer.judgement());
  const ResidualSignatures& signatures = answer.found().signatures;
  return noise_verdict(signatures);
}

/// What the forms mean that say more than their effects' titles: which instrument; "" where none does.
std::string meaning_of_forms(const CandidateModel& best) {
  std::vector<std::string> meanings;
  for (const auto& term : best.terms())
    if (!term.form->meaning.empty()) meanings.push_back(term.form->meaning);
  return fmt::format("{}", fmt::join(meanings, "; "));
}

/// The verdict as a sentence without its end.
std::string verdict_clause(const LoopAnswer& answer) {
  switch (answer.verdict()) {
    case Verdict::effect_found: {
      const std::set<std::string>& ids = answer.found().best().ids;
      const std::string names = named_effects(ids), by_form = meaning_of_forms(answer.found().best());
      if (answer.ambiguity_set().size() > 1) {
        const std::string what = ids.size() == 1 ? "an effect" : fmt::format("{} effects", ids.size());
        const std::string share =
            (by_form.empty() ? "" : by_form + "; ") + share_words(answer.ambiguity_set().front().weight);
        if (!why_taken(answer.ambiguity_set()).empty())
          return fmt::format("The model lacks {}: {}, by conditions left out ({} by the fit)", what, names, share);
        return fmt::format("The model lacks {}, most likely {} ({})", what, names, share);
      }
      if (ids.size() > 1)
        return fmt::format("The model lacks {}{}", names, by_form.empty() ? "" : " (" + by_form + ")");
      return fmt::format("The model lacks {}: {}", names,
                         by_form.empty() ? effect_title(*ids.begin()).meaning : std::string_view(by_form));
    }
    case Verdict::nothing_missing:
      return "No missing effect is detected";
    case Verdict::unknown_effect:
      return fmt::format("Something is missing that none of the {} known effects explains",
                         bekker_wong::effect_ids().size());
    case Verdict::not_enough_data:
      return "These data cannot decide: " + reason_words(answer);
  }
  return "";
}

/// Effects whose amplitude ends at the bound of its form; "" where there is none.
std::string sizes_at_a_bound(const LoopAnswer& answer) {
  std::vector<std::string> names;
  for (const AcceptedEffect& effect : answer.effects())
    if (!effect.at_bound.empty() && effect.at_bound.front()) names.push_back(named_effects({effect.choice.id}));
  if (names.empty()) return "";
  return fmt::format(" {} reaches the bound of its variant: check the columns' units and the declared wheel.",
                     capital(joined_with_and(names)));
}

/// What else to know of the verdict; "" where there is nothing.
std::string beside_the_verdict(const LoopAnswer& answer) {
  const std::vector<WeightedSet>& sets = answer.ambiguity_set();
  if (answer.verdict() == Verdict::nothing_missing) return capital(reason_words(*answer.judgement())) + ".";
  if (answer.verdict() == Verdict::effect_found)
    return (sets.size() > 1 ? "Other candidates: " + sets_with_shares(sets, 1, least_share) + "." + why_taken(sets)
                            : next_candidate(answer)) +
           sizes_at_a_bound(answer) + presumed_of_the_wheel(answer);
  if (sets.size() < 2) return "";
  return "Nearest known effects: " + sets_with_shares(sets, 0, worth_listing) + "." +
         (answer.uses_effects() ? why_taken(sets) : "");
}

// What it does to the error.

constexpr double worth_saying = 0.95;  // an error that falls by less hardly changes

bool falls_clearly(const HeldOutErrors& error) { return error.after < worth_saying * error.before; }
bool hardly_changes(const HeldOutErrors& error) { return !falls_clearly(error) && !rises(error); }

/// "6.30": an error in a sentence.
std::string error_number(double value) { return number(value, 3); }

/// "sinkage (20.6 to 7.04 mm)" of each channel of which `moves` holds; the noise beside it where that is asked.
std::vector<std::string> channels_that(bool (*moves)(const HeldOutErrors&), const CrossValidation& validation,
                                       bool with_noise = false) {
  std::vector<std::string> said;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const HeldOutErrors& e = validation.channels[c];
    const ChannelView& view = channel_views[c];
    if (e.cells == 0 || !moves(e)) continue;
    const std::string noise =
        with_noise ? fmt::format("; noise {} {}", error_number(e.noise_floor * view.per_si), view.unit) : "";
    said.push_back(fmt::format("{} ({} to {} {}{})", view.title, error_number(e.before * view.per_si),
                               error_number(e.after * view.per_si), view.unit, noise));
  }
  return said;
}

std::string with_the(const std::vector<std::string>& channels) {
  std::vector<std::string> words;
  for (const std::string& channel : channels) words.push_back("the " + channel);
  return joined_with_and(words);
}

std::string error_sentence(const LoopAnswer& answer) {
  const CrossValidation& validation = answer.validation;
  std::vector<std::string> parts;
  if (!answer.uses_effects()) {
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      if (const HeldOutErrors& e = validation.channels[c]; e.cells > 0)
        parts.push_back(fmt::format("{0} {1} {3} (noise {2} {3})", channel_views[c].title,
                                    error_number(e.before * channel_views[c].per_si),
                                    error_number(e.noise_floor * channel_views[c].per_si), channel_views[c].unit));
    return fmt::format("With the soil refitted the cross-validated RMS error is: {}.", joined_with_and(parts));
  }
  const auto add = [&](const char* what, const std::vector<std::string>& channels) {
    if (!channels.empty()) parts.push_back(fmt::format("{} {}", what, with_the(channels)));
  };
  add("rises for", channels_that(rises, validation, true));
  add("falls for", channels_that(falls_clearly, validation, true));
  add("changes little for", channels_that(hardly_changes, validation, true));
  return fmt::format("The cross-validated RMS error {}.", joined_with_and(parts));
}

// Parameters.

std::string effect_sentence(const AcceptedEffect& effect) {
  const bekker_wong::EffectForm& form = bekker_wong::find_form(effect.choice);
  if (effect.choice.id == bekker_wong::learned_id)
    return fmt::format("{} ({}): {}; valid for {}.", capital(std::string(effect_title(effect.choice.id).name)),
                       spaced(effect.choice.form), form.equation, learned_ranges({effect.choice}));
  std::vector<std::string> parameters;
  for (std::size_t i = 0; i < effect.fitted.size(); ++i) {
    const auto& p = bekker_wong::find_parameter(form, effect.fitted[i]);
    const double scale = per_unit(p.unit);
    parameters.push_back(fmt::format("{} {}{} (95 %: {} to {}{})", p.meaning,
                                     number(scale * effect.choice.parameters.at(p.name)), unit_behind(p.unit),
                                     number(scale * effect.ci95[i].first), number(scale * effect.ci95[i].second),
                                     effect.at_bound[i] ? "; at its bound, not determined" : ""));
  }
  return fmt::format("{} ({}): {}.", capital(std::string(effect_title(effect.choice.id).name)),
                     spaced(effect.choice.form), fmt::join(parameters, "; "));
}

// Notes.

/// What the attribution says that does not decide.
std::string note_on_the_other_attribution(const LoopAnswer& answer) {
  const Attribution& note = answer.second()->alternative;
  std::string names = "no known effect is significant";
  std::vector<std::string> others;
  if (note.candidates.best) {
    const std::set<std::string>& best = note.best().ids;
    names = fmt::format("{} is strongest (p = {:.2g})", named_effects(best), note.signatures.p_value);
    for (const WeightedSet& w : answer.second()->sets)
      if (w.ids != best) others.push_back(joined(w.ids));
  }
  if (!others.empty()) names += fmt::format("; competing: {}", fmt::join(others, ", "));
  const char* other = answer.second()->decides ? "the base model taken as exact"
                                               : "the base model wrong by a smooth function of load and slip";
  return fmt::format("Second analysis, with {}{}: {}.", other,
                     note.candidates.best ? " (explains the data less well)" : "", names);
}

/// The forms that the answer names: of the effects in the model, and of the sets that compete.
std::vector<EffectChoice> forms_named(const LoopAnswer& answer) {
  std::vector<EffectChoice> forms;
  for (const AcceptedEffect& effect : answer.effects_in_model()) forms.push_back(effect.choice);
  for (const WeightedSet* w : sets_shown(answer))
    for (const Term& term : answer.found().candidates.models[w->best_candidate].terms())
      forms.push_back({term.form->id, term.form->form, {}});
  if (const SecondAttribution* second = answer.second())
    for (const WeightedSet& w : second->sets)
      for (const Term& term : second->alternative.candidates.models[w.best_candidate].terms())
        forms.push_back({term.form->id, term.form->form, {}});
  return forms;
}

/// Where the noise is much more than re-runs show: setpoints that lie off any smooth function of the conditions.
std::string note_on_noise(const LoopAnswer& answer) {
  constexpr double far_more = 2.0;
  std::vector<std::string> channels;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const HeldOutErrors& held_out = answer.validation.channels[c];
    const ChannelNoise& n = answer.noise.channels[c];
    const ChannelView& view = channel_views[c];
    const double noise = held_out.cells > 0 ? held_out.noise_floor : n.floor;
    if (n.measured && n.rerun_sd > 0.0 && noise > far_more * n.rerun_sd)
      channels.push_back(fmt::format("the {} ({} beside {} {})", view.title, error_number(noise * view.per_si),
                                     error_number(n.rerun_sd * view.per_si), view.unit));
  }
  if (channels.empty()) return "";
  return fmt::format(
      "The noise exceeds the scatter of re-runs for {}: setpoints deviate that much from any smooth function of the "
      "conditions.",
      joined_with_and(channels));
}

/// "line 12: torque 14.2 N m where 9.1 N m are predicted"
std::string value_in_words(const SetAside& one) {
  const std::string where =
      fmt::format("line {}: {} {}", one.csv_line, channel_views[one.channel].title, in_unit(one.channel, one.measured));
  return std::isfinite(one.predicted)
             ? fmt::format("{} where {} is predicted", where, in_unit(one.channel, one.predicted))
             : where;
}

/// Soil values that the saved model has far from the declared ones; "" where there is none.
std::string note_on_declared_soil(const LoopAnswer& answer) {
  constexpr double far = 3.0;  // declared standard deviations
  const FittedModel& model = answer.model();
  std::vector<std::string> values;
  for (int i = 0; i < model.predictor().soil_parameters(); ++i) {
    const FreeParameter& of = model.predictor().parameters()[i];
    const double fitted = model.fit().theta[i];
    if (!(std::abs(fitted - of.prior) > far * of.prior_sd)) continue;
    const DeclaredValueWords p = words_of_declared(of.name);
    values.push_back(fmt::format("{} {}{} in place of {}", p.symbol, number(fitted * p.per_si), unit_behind(p.unit),
                                 number(Estimate{of.prior, of.prior_sd}, p.per_si)));
  }
  if (values.empty()) return "";
  return fmt::format(
      "The fitted soil differs from the declared one by more than three standard deviations: {}. If the declared "
      "uncertainty is too small, an effect may be a soil error.",
      fmt::join(values, "; "));
}

/// What was set aside, and whether anything hangs on it.
std::string outlier_sentence(const LoopAnswer& answer) {
  constexpr std::size_t most = 5;
  const bool one = answer.outliers() == 1;
  std::vector<std::string> listed;
  for (std::size_t i = 0; i < std::min(most, answer.set_aside.size()); ++i)
    listed.push_back(value_in_words(answer.set_aside[i]));
  if (answer.set_aside.size() > most) listed.push_back("...");
  std::string said = fmt::format("{} {} set aside as outlier{} (noise exceeds this in 1 of 100 campaigns): {}.",
                                 counted(answer.set_aside.size(), "measured value"), one ? "is" : "are", one ? "" : "s",
                                 fmt::join(listed, "; "));
  if (!answer.with_outliers) return said;
  const WithOutliers& kept = *answer.with_outliers;
  said += fmt::format(" With {} kept ", one ? "it" : "them");
  if (kept.verdict == answer.verdict() && kept.effects == ids_of(answer.effects()))
    return said + "the verdict is the same.";
  said += fmt::format("the verdict would be {}", word(kept.verdict));
  return said + (kept.effects.empty() ? "." : ": " + joined(kept.effects) + ".");
}

}  // namespace

std::string verdict_sentence(const LoopAnswer& answer) { return verdict_clause(answer) + "."; }

std::string proxy_sentence(const LoopAnswer& answer) {
  if (answer.proxy_effects().empty()) return "";
  const std::optional<LearnedFormula>& formula = answer.unknown()->formula;
  return fmt::format("Empirical correction: {}. Better predictions, no physical cause.{}", proxy_words(answer),
                     formula ? formula_sentence(*formula) : "");
}

std::vector<BackedSentence> headline(const LoopAnswer& answer, const std::vector<std::string>& column_doubts) {
  const std::string odds = odds_clause(answer);
  const char* joint = odds.empty() ? "" : answer.verdict() == Verdict::unknown_effect ? ": " : "; ";
  std::vector<BackedSentence> parts;
  if (!column_doubts.empty())
    parts.push_back({.about = "Check first",
                     .text = fmt::format("The data look wrong, and the loop may have taken that for an effect. Correct "
                                         "them and run the loop again: {}.",
                                         fmt::join(column_doubts, "; "))});
  parts.push_back({.about = "What is missing",
                   .text = verdict_clause(answer) + joint + odds + ".",
                   .detail = beside_the_verdict(answer)});
  if (answer.validation.overall.cells > 0)
    parts.push_back({.about = !answer.uses_effects()           ? "Error"
                              : answer.proxy_effects().empty() ? "Error with the effect"
                                                               : "Error with the empirical correction",
                     .text = error_sentence(answer),
                     .detail = proxy_sentence(answer)});
  if (const std::vector<std::string> next = what_next(answer); !next.empty())
    parts.push_back({.about = "What to measure next",
                     .text = next.front(),
                     .detail = fmt::format("{}", fmt::join(next.begin() + 1, next.end(), " "))});
  return parts;
}

std::vector<std::string> notes(const LoopAnswer& answer) {
  std::vector<std::string> sentences;
  if (answer.second()) sentences.push_back(note_on_the_other_attribution(answer));
  for (std::string& sentence : bekker_wong::presumptions(forms_named(answer), answer.wheel))
    sentences.push_back(std::move(sentence));
  if (answer.verdict() != Verdict::not_enough_data && answer.found().base.data().noise.rerun_freedom == 0)
    sentences.push_back("No two rows share a setpoint: the noise was estimated together with the fit.");
  if (const int near = answer.judgement() ? answer.found().base.data().observations.conditions_in_blocks() : 0;
      near > 0)
    sentences.push_back(fmt::format(
        "{} conditions without a label may be re-runs of another one and are left out together. A label (setpoint) "
        "says which are re-runs, and gives a better estimate of the noise.",
        near));
  if (std::string noise = note_on_noise(answer); !noise.empty()) sentences.push_back(std::move(noise));
  if (answer.outliers() > 0) sentences.push_back(outlier_sentence(answer));
  if (!answer.judgement()) return sentences;
  if (std::string soil = note_on_declared_soil(answer); !soil.empty()) sentences.push_back(std::move(soil));
  if (const auto& impossible = answer.found().base.data().campaign->impossible; !impossible.empty())
    sentences.push_back(fmt::format("Not tested, since these runs exclude them: {}.", named_effects(impossible)));
  if (!answer.not_testable.empty()) {
    std::set<std::string> ids(answer.not_testable.begin(), answer.not_testable.end());
    sentences.push_back(fmt::format("Not testable with these data, but possible: {}.", named_effects(ids)));
  }
  return sentences;
}

std::vector<std::string> in_sentences(const LoopAnswer& answer) {
  std::vector<std::string> sentences;
  for (BackedSentence& said : headline(answer, {}))
    for (std::string* part : {&said.text, &said.detail})
      if (!part->empty()) sentences.push_back(std::move(*part));
  for (const AcceptedEffect& effect : answer.effects_in_model()) sentences.push_back(effect_sentence(effect));
  for (std::string& sentence : notes(answer)) sentences.push_back(std::move(sentence));
  return sentences;
}

std::string held_out_words(const CrossValidation& validation) {
  const std::vector<std::string> better = channels_that(falls, validation), worse = channels_that(rises, validation);
  std::string text =
      fmt::format("cross-validated error {} by {:.2g} +- {:.2g} noise variances a value",
                  validation.gain < 0 ? "rises" : "falls", std::abs(validation.gain), validation.gain_error);
  if (!better.empty()) text += fmt::format("; predicted better: {}", fmt::join(better, ", "));
  if (!worse.empty()) text += fmt::format("; predicted worse: {}", fmt::join(worse, ", "));
  return text;
}

std::string reason_words(const LoopAnswer& answer) {
  const Judgement* judgement = answer.judgement();
  std::string words = judgement ? reason_words(*judgement) : reason_words(std::get<TooFewValues>(answer.judged));
  if (answer.uses_effects() && answer.validation.overall.cells > 0)
    words += (answer.effects().empty() ? "; with the model that is saved, " : "; ") + held_out_words(answer.validation);
  return words;
}

}  // namespace soilbin::compare
