#include "compare/loop/answer_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "compare/doubts/unheard.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {

std::string joined(const std::set<std::string>& ids) {
  std::string text;
  for (const std::string& id : ids) text += (text.empty() ? "" : " + ") + id;
  return text.empty() ? "no effect" : text;
}

std::string verdict_sentence(const LoopAnswer& answer) {
  switch (answer.verdict) {
    case Verdict::effect_found:
      return fmt::format("The model lacks {}: {}.", joined(answer.found().best().ids), answer.reason);
    case Verdict::nothing_missing:
      return fmt::format("Nothing is missing that these data show: {}.", answer.reason);
    case Verdict::unknown_effect:
      return fmt::format("Something is missing that the catalogue does not name: {}.", answer.reason);
    case Verdict::not_enough_data:
      return fmt::format("These data can't decide: {}.", answer.reason);
  }
  return "";
}

namespace {

/// The sets of the table of candidates: those that compete, then those that stand next.
std::vector<const Weighted*> sets_shown(const LoopAnswer& answer) {
  constexpr std::size_t most = 8;
  std::vector<const Weighted*> sets;
  for (const Weighted& w : answer.ambiguity_set) sets.push_back(&w);
  const auto listed = [&](const Weighted& w) {
    return std::any_of(sets.begin(), sets.end(), [&](const Weighted* one) { return one->ids == w.ids; });
  };
  if (!answer.has_candidates()) return sets;
  for (const Weighted& w : answer.found().candidates.sets)
    if (sets.size() < most && !listed(w)) sets.push_back(&w);
  return sets;
}

std::string condition_words(const NextTest& next) {
  std::string text;
  for (const std::string& name : next.quantities) {
    const ConditionView& view = condition_view(name);
    const double value = view.get(next.at);
    if (!std::isfinite(value)) continue;
    text += fmt::format("{}{} {}{}{}", text.empty() ? "" : ", ", view.title, number(view.per_si * value),
                        view.unit.empty() ? "" : " ", view.unit);
  }
  return text;
}

std::string effect_sentence(const AcceptedEffect& effect) {
  std::string parameters;
  for (std::size_t i = 0; i < effect.fitted.size(); ++i)
    parameters +=
        fmt::format("{}{} = {} ({}95 %: {} .. {})", i == 0 ? "" : ", ", effect.fitted[i],
                    number(effect.choice.parameters.at(effect.fitted[i])), effect.at_bound[i] ? "at its bound; " : "",
                    number(effect.ci95[i].first), number(effect.ci95[i].second));
  return fmt::format("{} in the form '{}', {} (SI).", effect.choice.id, effect.choice.form, parameters);
}

constexpr double little = 0.005;  // of the evidence

/// A set's share of the evidence, the same in every place: "81 %".
std::string share_words(double weight) { return weight < little ? "< 1 %" : fmt::format("{:.0f} %", 100 * weight); }

/// The sets with their weights; those of next to none are only counted.
std::string ambiguity_words(const std::vector<Weighted>& sets) {
  std::string text;
  std::size_t unsaid = 0;
  for (const Weighted& w : sets)
    if (w.weight < little && &w != &sets.front())
      ++unsaid;
    else
      text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", joined(w.ids), share_words(w.weight));
  if (unsaid > 0) text += fmt::format(", and {} more set{} of less than a per cent", unsaid, unsaid == 1 ? "" : "s");
  return text;
}

/// Why the first set is taken where another one has the larger share; "" where none has.
std::string why_taken(const std::vector<Weighted>& sets) {
  const auto lighter = [](const Weighted& a, const Weighted& b) { return a.weight < b.weight; };
  const Weighted &taken = sets.front(), &heaviest = *std::max_element(sets.begin(), sets.end(), lighter);
  if (heaviest.ids == taken.ids) return "";
  return fmt::format("{} is taken all the same: what {} has beyond it does not predict conditions left out better.",
                     joined(taken.ids), joined(heaviest.ids));
}

/// What the attribution says that does not decide.
std::string note_on_the_other_attribution(const LoopAnswer& answer) {
  const Attribution& note = answer.second->note;
  std::string names = "no named effect stands out", others;
  if (note.candidates.best) {
    const std::set<std::string>& best = note.best().ids;
    names = fmt::format("{} stands out most (p = {:.2g})", joined(best), note.signatures.p_value);
    for (const Weighted& w : answer.noted_sets)
      if (w.ids != best) others += (others.empty() ? "" : ", ") + joined(w.ids);
  }
  if (!others.empty()) names += "; beside it these compete: " + others;
  const char* other = answer.second->decides
                          ? "a base model that is taken as exact"
                          : "a base model that may itself be off by any smooth function of load and slip";
  return fmt::format("Note: read with {}{}, {}.", other,
                     note.candidates.best ? ", which explains the data less well" : "", names);
}

/// The forms that the answer names: of the effects in the model, and of the sets that compete.
std::vector<EffectChoice> forms_named(const LoopAnswer& answer) {
  std::vector<EffectChoice> forms;
  for (const std::vector<AcceptedEffect>* effects : {&answer.effects, &answer.stand_in})
    for (const AcceptedEffect& effect : *effects) forms.push_back(effect.choice);
  for (const Weighted* w : sets_shown(answer))
    for (const Term& term : answer.found().candidates.models[w->best_candidate].terms())
      forms.push_back({term.form->id, term.form->form, {}});
  for (const Weighted& w : answer.noted_sets)
    for (const Term& term : answer.second->note.candidates.models[w.best_candidate].terms())
      forms.push_back({term.form->id, term.form->form, {}});
  return forms;
}

std::string listed_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : ", ") + w;
  return text;
}

/// A name as people write it: "cross_slope" becomes "cross slope".
std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// The dependence that is surest in what the best named effects leave, or in what the base model leaves.
const Dependence* surest_dependence(const LoopAnswer& answer) {
  const auto& all = answer.dependences_after.empty() ? answer.dependences_before : answer.dependences_after;
  const auto surer = [](const Dependence& a, const Dependence& b) {
    return std::pair(a.p_value, -a.share) < std::pair(b.p_value, -b.share);
  };
  const auto surest = std::min_element(all.begin(), all.end(), surer);
  return surest == all.end() ? nullptr : &*surest;
}

/// What has no name predicts nothing; but where it shows can be said.
std::string to_show_its_shape(const LoopAnswer& answer) {
  constexpr double sure = 0.05;
  const std::string lack = "What is missing has no name and so predicts nothing; ";
  const Dependence* on = surest_dependence(answer);
  if (!on || on->p_value > sure) return lack + "one condition varied alone, with re-runs, would show its shape.";
  const std::string how = on->variable == "run" ? "repeat one setpoint through the whole campaign"
                                                : fmt::format("vary the {} alone, with re-runs", spaced(on->variable));
  return fmt::format("{}to see its shape, {}: on that the {} that is left depends most (p = {:.2g}).", lack, how,
                     channel_views[on->channel].title, on->p_value);
}

/// What was set aside, and whether anything hangs on it.
std::string outlier_sentence(const LoopAnswer& answer) {
  const bool one = answer.outliers == 1;
  std::string said = fmt::format("{} measured value{} stood more than five standard deviations off and {} set aside.",
                                 answer.outliers, one ? "" : "s", one ? "was" : "were");
  if (!answer.with_outliers) return said;
  const WithOutliers& kept = *answer.with_outliers;
  said += fmt::format(" With {} kept ", one ? "it" : "them");
  if (kept.verdict == answer.verdict && kept.effects == ids_of(answer.effects))
    return said + "the verdict is the same.";
  said += fmt::format("the verdict would be {}", word(kept.verdict));
  return said + (kept.effects.empty() ? "." : ": " + joined(kept.effects) + ".");
}

}  // namespace

std::vector<std::string> what_next(const LoopAnswer& answer) {
  const bool unknown = answer.verdict == Verdict::unknown_effect;
  std::vector<std::string> sentences;
  if (unknown) sentences.push_back(to_show_its_shape(answer));
  if (!answer.next) {
    if (!unknown && answer.ambiguity_set.size() > 1)
      sentences.push_back("No condition within the limits would set these candidates apart in 50 runs.");
    if (answer.verdict == Verdict::effect_found && answer.ambiguity_set.size() == 1)
      sentences.push_back(
          "One name is left, and no condition within the limits would set it further apart in one run.");
    return sentences;
  }
  const NextTest& next = *answer.next;
  const std::string ahead = joined(next.separates.front()), behind = joined(next.separates.back());
  if (answer.ambiguity_set.size() == 1 && !unknown)
    sentences.push_back(
        fmt::format("One name is left. To be surer still: {}. There {} parts most from {}, which stands next (by "
                    "{:.1f} sd of one run).",
                    condition_words(next), ahead, behind, std::sqrt(next.distance)));
  else
    sentences.push_back(fmt::format("Measure next{}: {}. It sets {} apart from {}; {} run{} should decide.",
                                    unknown ? ", as far as named effects go" : "", condition_words(next), ahead, behind,
                                    next.runs, next.runs == 1 ? "" : "s"));
  if (next.beyond.empty()) return sentences;
  std::vector<std::string> names = next.beyond;
  for (std::string& name : names) name = spaced(name);
  sentences.push_back(fmt::format(
      "That is beyond what was run (in {}), where candidates differ most. What the rig can't reach: --limit "
      "{}=LOW..HIGH.",
      listed_words(names), next.beyond.front()));
  return sentences;
}

std::vector<std::string> explanation(const LoopAnswer& answer) {
  std::vector<std::string> sentences;
  for (const AcceptedEffect& effect : answer.effects) sentences.push_back(effect_sentence(effect));
  for (const AcceptedEffect& effect : answer.stand_in)
    sentences.push_back("In its place, without explaining it, the saved model takes " + effect_sentence(effect));
  if (answer.ambiguity_set.size() > 1) {
    sentences.push_back("These data can't tell apart: " + ambiguity_words(answer.ambiguity_set) + ".");
    if (std::string why = why_taken(answer.ambiguity_set); !why.empty()) sentences.push_back(std::move(why));
  }
  if (answer.second) sentences.push_back(note_on_the_other_attribution(answer));
  for (std::string& sentence : bekker_wong::presumptions(forms_named(answer), answer.wheel))
    sentences.push_back(std::move(sentence));
  const ErrorPair& all = answer.validation.overall;
  if (all.cells > 0)
    sentences.push_back(fmt::format(
        "On conditions that neither choice nor fit has seen the error is {} sigma before and {} after; the "
        "squared error falls by {} +- {} sigma^2 a value.",
        number(all.before), number(all.after), number(answer.validation.gain), number(answer.validation.gain_error)));
  if (answer.verdict != Verdict::not_enough_data && answer.found().base.data().noise.rerun_freedom == 0)
    sentences.push_back("No setpoint was run twice: the noise was estimated together with the fit.");
  if (answer.outliers > 0) sentences.push_back(outlier_sentence(answer));
  if (!answer.not_testable.empty())
    sentences.push_back(
        "Not testable with these data (which does not mean absent): " + listed_words(answer.not_testable) + ".");
  const std::vector<std::string> next = what_next(answer);
  sentences.insert(sentences.end(), next.begin(), next.end());
  return sentences;
}

std::vector<std::string> forms_in_order(const CandidateModel& candidate) {
  std::map<std::string, std::string> by_id;
  for (const Term& term : candidate.terms()) by_id[term.form->id] = term.form->form;
  std::vector<std::string> forms;
  for (const std::string& id : candidate.ids) forms.push_back(by_id.at(id));
  return forms;
}

HtmlTable candidates_table(const LoopAnswer& answer) {
  const std::string premise = !answer.second           ? ""
                              : answer.second->decides ? ", beside a base model that may be off by itself"
                                                       : ", the base model taken as exact";
  HtmlTable table{"Candidates, each fitted in full" + premise + "; shares are of those that the data can't tell apart",
                  {"effects", "form", "share", "odds to the first", "chi2", "values"},
                  {},
                  {true, true}};
  const std::string values = std::to_string(answer.found().base.data().cells());
  const std::vector<const Weighted*> sets = sets_shown(answer);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Weighted& w = *sets[i];
    const CandidateModel& candidate = answer.found().candidates.models[w.best_candidate];
    std::string forms;
    for (const std::string& form : forms_in_order(candidate)) forms += (forms.empty() ? "" : " + ") + form;
    const double behind = sets.front()->log_evidence - w.log_evidence;
    const std::string odds = i == 0       ? "-"
                             : behind > 0 ? "1 : " + number(std::exp(behind))
                                          : number(std::exp(-behind)) + " : 1";
    table.rows.push_back({joined(w.ids), forms, i < answer.ambiguity_set.size() ? share_words(w.weight) : "-", odds,
                          number(candidate.fit().chi2), values});
  }
  table.rows.push_back({"base model", "-", "-", "-", number(answer.found().base.fit().chi2), values});
  return table;
}

HtmlTable error_table(const LoopAnswer& answer) {
  HtmlTable table{
      "Root mean square error on held-out conditions", {"channel", "values", "before", "after", "noise floor"}, {}, {}};
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ErrorPair& e = answer.validation.channels[c];
    if (e.cells == 0) continue;
    const auto in_unit = [&](double si) {
      return fmt::format("{} {}", number(si * channel_views[c].per_si), channel_views[c].unit);
    };
    table.rows.push_back({std::string(channel_views[c].title), std::to_string(e.cells), in_unit(e.before),
                          in_unit(e.after), in_unit(e.noise_floor)});
  }
  const ErrorPair& all = answer.validation.overall;
  if (all.cells > 0)
    table.rows.push_back(
        {"all", std::to_string(all.cells), number(all.before) + " sigma", number(all.after) + " sigma", "1 sigma"});
  return table;
}

namespace {

constexpr double third_digit = 1.005;

bool falls(const ErrorPair& error) { return error.before > third_digit * error.after; }

/// "sinkage (20.6 to 7.04 mm), torque (3.1 to 2.2 N m)": the channels of which `moves` holds.
std::string channels_that(bool (*moves)(const ErrorPair&), const CrossValidation& validation) {
  std::string text;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ErrorPair& e = validation.channels[c];
    const ChannelView& view = channel_views[c];
    if (e.cells > 0 && moves(e))
      text += fmt::format("{}{} ({:.3g} to {:.3g} {})", text.empty() ? "" : ", ", view.title, e.before * view.per_si,
                          e.after * view.per_si, view.unit);
  }
  return text;
}

}  // namespace

bool rises(const ErrorPair& error) { return error.after > third_digit * error.before; }

std::vector<int> worse_channels(const LoopAnswer& answer) {
  std::vector<int> worse;
  if (answer.effects.empty() && answer.stand_in.empty()) return worse;
  for (int c = 0; c < channel_count; ++c)
    if (rises(answer.validation.channels[c])) worse.push_back(c);
  return worse;
}

std::string held_out_words(const CrossValidation& validation) {
  const std::string better = channels_that(falls, validation), worse = channels_that(rises, validation);
  std::string text =
      fmt::format("held-out error {} by {:.2g} +- {:.2g} sigma^2 a value", validation.gain < 0 ? "rises" : "falls",
                  std::abs(validation.gain), validation.gain_error);
  if (!better.empty()) text += "; predicted better: " + better;
  if (!worse.empty()) text += "; predicted worse: " + worse;
  return text;
}

std::string held_out_clause(const LoopAnswer& answer) {
  if (answer.validation.overall.cells == 0) return "";
  if (!answer.effects.empty()) return "; " + held_out_words(answer.validation);
  return answer.stand_in.empty() ? "" : "; with the model that is saved, " + held_out_words(answer.validation);
}

}  // namespace soilbin::compare
