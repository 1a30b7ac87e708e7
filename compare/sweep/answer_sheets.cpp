#include "compare/sweep/answer_sheets.hpp"

#include <algorithm>
#include <cmath>

#include "compare/report/number_text.hpp"
#include "scenario/estimate.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

constexpr std::size_t most_bands = 5;  ///< curves of a panel beyond which bands only hide each other

/// What a panel shows of a result.
struct Shown {
  std::string title, unit;
  double per_unit = 1.0;
  std::function<Estimate(const TractionResult&)> get;
};

std::vector<Shown> shown_of(const std::vector<ModelAnswers>& study, Panels panels) {
  std::vector<Shown> all;
  bool side = panels == Panels::all;
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      side = side || (answer.result && answer.result->lateral_force.value != 0.0);
  for (const ChannelView& channel : channel_views)
    if (side || !channel.sideways)
      all.push_back({std::string(channel.title), std::string(channel.unit), channel.per_si,
                     [member = channel.predicted](const TractionResult& r) { return r.*member; }});
  all.push_back({"tractive efficiency", "%", 100.0, [](const TractionResult& r) {
                   return Estimate{reported_efficiency(r), 0.0};
                 }});
  return all;
}

Plot empty_plot(const Shown& shown, const ConditionView& abscissa = slip_view()) {
  Plot plot{capital(shown.title) + " [" + shown.unit + "]", {heading(abscissa)}};
  if (shown.title == "sinkage" || shown.title == "tractive efficiency") plot.y.lower = 0.0;
  return plot;
}

std::string join(const std::string& a, const std::string& b) { return a.empty() || b.empty() ? a + b : a + ", " + b; }

/// A curve's points, from left to right.
Series series_of(const std::vector<Answer>& answers, const ConditionView& abscissa, const Curves& curves,
                 std::size_t curve, const Shown& shown) {
  std::vector<const Answer*> members;
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (curves.curve_of[i] == curve) members.push_back(&answers[i]);
  std::ranges::stable_sort(members,
                           [&](const Answer* a, const Answer* b) { return abscissa.get(a->at) < abscissa.get(b->at); });
  Series series;
  for (const Answer* answer : members) {
    const Estimate y = answer->result ? shown.get(*answer->result) : Estimate{not_a_number, 0.0};
    series.x.push_back(abscissa.per_si * abscissa.get(answer->at));
    series.y.push_back(y.value * shown.per_unit);
    series.error.push_back(y.std_error * shown.per_unit);
  }
  if (std::ranges::none_of(series.error, [](double error) { return error > 0.0; })) series.error.clear();
  return series;
}

/// Whether two runs belong to one setpoint: the same label or, without labels, nearly the same slip.
bool same_setpoint(const PredictedRun& a, const PredictedRun& b) {
  if (a.measured.setpoint && b.measured.setpoint) return *a.measured.setpoint == *b.measured.setpoint;
  return std::abs(a.measured.at.slip - b.measured.at.slip) < 0.02;
}

Series stress_series(const LabelledPatch& from, double StressSample::*stress) {
  constexpr std::size_t most = 128;
  const std::size_t every = from.patch.size() / most + 1;
  Series series;
  series.label = from.label;
  series.color = from.color;
  for (std::size_t k = 0; k < from.patch.size(); k += every) {
    series.x.push_back(from.patch[k].theta / degree);
    series.y.push_back(from.patch[k].*stress / 1000);
  }
  return series;
}

/// Predictions of a curve as a line through the means of its setpoints.
Series predicted_line(const std::vector<const PredictedRun*>& runs, const ChannelView& channel) {
  struct Mean {
    const PredictedRun* first;
    double x = 0.0, y = 0.0, count = 0.0;
  };
  std::vector<Mean> means;
  for (const PredictedRun* run : runs) {
    if (!run->predicted.result) continue;
    auto place = std::ranges::find_if(means, [&](const Mean& m) { return same_setpoint(*m.first, *run); });
    if (place == means.end()) place = means.insert(means.end(), Mean{run});
    place->x += run->measured.at.slip;
    place->y += ((*run->predicted.result).*channel.predicted).value;
    place->count += 1;
  }
  std::ranges::sort(means, [](const Mean& a, const Mean& b) { return a.x / a.count < b.x / b.count; });
  Series line;
  for (const Mean& mean : means) {
    line.x.push_back(100 * mean.x / mean.count);
    line.y.push_back(channel.per_si * mean.y / mean.count);
  }
  return line;
}

}  // namespace

std::vector<ModelAnswers> smoothed_for_plot(const Case& question, std::vector<ModelAnswers> study,
                                            const ConditionView& abscissa) {
  constexpr int points = 41;
  Case smooth = with_smooth_curves(question, points, abscissa);
  smooth.study.models.clear();
  for (const ModelAnswers& model : study)
    if (model.choice.model == ModelKind::bekker_wong) smooth.study.models.push_back(model.choice);
  std::vector<ModelAnswers> drawn = run_study(smooth);
  std::size_t next = 0;
  for (ModelAnswers& model : study) {
    if (model.choice.model == ModelKind::bekker_wong) model = std::move(drawn[next++]);
    model.choice.label = model_in_words(model.choice.label);
  }
  return study;
}

Sheet study_sheet(const Case& question, const std::vector<ModelAnswers>& study, Panels panels,
                  const ConditionView& abscissa) {
  Sheet sheet{question.study.name, {}, Palette::ordered};
  const Curves curves = curves_against(abscissa, question.study.conditions, Spread::exact);
  const bool one_curve = curves.labels.size() == 1;
  if (one_curve) sheet.palette = Palette::named;
  const bool all_bands = curves.labels.size() * study.size() <= most_bands;
  const bool first_bands = curves.labels.size() <= most_bands;
  std::vector<Curves> own;  // of each model, which may have been asked at slips of its own
  for (const ModelAnswers& model : study)
    own.push_back(curves_against(abscissa, conditions_of(model.answers), Spread::exact));
  sheet.note = in_words(question.scenario.tire) + " on " + in_words(question.scenario.soil) + "; ";
  if (all_bands)
    sheet.note += "bands and bars: one standard error";
  else if (first_bands)
    sheet.note += "bands, of the first model alone: one standard error";
  else
    sheet.note += "so many curves are drawn without their standard errors";
  for (const Shown& shown : shown_of(study, panels)) {
    Plot plot = empty_plot(shown, abscissa);
    for (std::size_t m = 0; m < study.size(); ++m)
      for (std::size_t curve = 0; curve < curves.labels.size(); ++curve) {
        Series series = series_of(study[m].answers, abscissa, own[m], curve, shown);
        series.band = all_bands || (m == 0 && first_bands);
        series.label = join(study.size() > 1 ? study[m].choice.label : "", curves.labels[curve]);
        series.color = static_cast<int>(one_curve ? m : curve);
        series.dash = one_curve ? 0 : static_cast<int>(m);
        plot.series.push_back(std::move(series));
      }
    sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

Sheet plot_of_study(const Case& question, const std::vector<ModelAnswers>& study) {
  const ConditionView* over = curves_run_over(question.study.conditions);
  const ConditionView& abscissa = over ? *over : slip_view();
  return study_sheet(question, smoothed_for_plot(question, study, abscissa), Panels::nonzero, abscissa);
}

Sheet budget_sheet(const std::string& title, const std::vector<LabelledAnswers>& curves) {
  constexpr int sum_color = 5;  // of the named palette the grey one; the parts take the others in turn
  Sheet sheet{title};
  std::vector<std::string> names;  // of parts, in the order of their colours
  for (const LabelledAnswers& curve : curves)
    for (const Answer& answer : curve.answers)
      if (answer.result)
        for (const Contribution& part : answer.result->budget)
          if (std::ranges::find(names, part.name) == names.end()) names.push_back(part.name);
  for (const LabelledAnswers& curve : curves) {
    Plot plot{join("Parts of the drawbar pull [N]", curve.label), {"slip [%]"}};
    std::vector<double> above(curve.answers.size(), 0.0), below = above;  // the piles so far
    for (std::size_t k = 0; k < names.size(); ++k) {
      for (const bool drives : {true, false}) {
        Series area;
        area.label = spaced(names[k]), area.color = static_cast<int>(k) % sum_color;
        std::vector<double>& pile = drives ? above : below;
        bool there = false;
        for (std::size_t i = 0; i < curve.answers.size(); ++i) {
          double force = 0.0;
          if (const auto& result = curve.answers[i].result)
            for (const Contribution& part : result->budget)
              if (part.name == names[k] && (part.force > 0.0) == drives) force += part.force;
          there = there || force != 0.0;
          area.x.push_back(100 * curve.answers[i].at.slip);
          area.base.push_back(pile[i]);
          area.y.push_back(curve.answers[i].result ? pile[i] += force : not_a_number);
        }
        if (there) plot.series.push_back(std::move(area));
      }
    }
    plot.series.push_back(over_samples(
        {.label = "drawbar pull", .color = sum_color}, curve.answers,
        [](const Answer& answer) { return 100 * answer.at.slip; },
        [](const Answer& answer) { return answer.result ? answer.result->drawbar_pull.value : not_a_number; }));
    sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

Sheet patch_sheet(const std::string& title, const std::vector<LabelledPatch>& patches) {
  Sheet sheet{title};
  const std::pair<const char*, double StressSample::*> stresses[] = {{"Normal stress [kPa]", &StressSample::normal},
                                                                     {"Shear stress [kPa]", &StressSample::shear}};
  for (const auto& [name, stress] : stresses) {
    Plot plot{name, {"angle before the axle [deg]"}};
    for (const LabelledPatch& one : patches)
      if (!one.patch.empty()) plot.series.push_back(stress_series(one, stress));
    if (!plot.series.empty()) sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

namespace {

/// A panel for each measured channel: `plot_of` begins it, `add` gives it a curve's runs.
template <class PlotOf, class Add>
Sheet sheet_of_channels(std::string title, const Prediction& prediction, const PlotOf& plot_of, const Add& add) {
  const Curves curves = curves_against_slip(conditions_of(prediction), Spread::measured);
  Sheet sheet{std::move(title), {}, curves.labels.size() == 1 ? Palette::named : Palette::ordered};
  for (const ChannelError& error : prediction.errors) {
    const ChannelView& channel = channel_views[error.channel];
    Plot& plot = sheet.plots.emplace_back(plot_of(channel));
    for (std::size_t curve = 0; curve < curves.labels.size(); ++curve) {
      std::vector<const PredictedRun*> runs;
      for (std::size_t i = 0; i < prediction.runs.size(); ++i)
        if (curves.curve_of[i] == curve) runs.push_back(&prediction.runs[i]);
      add(plot, channel, Series{.label = curves.labels[curve], .color = static_cast<int>(curve)}, runs);
    }
  }
  return sheet;
}

}  // namespace

Sheet campaign_sheet(const Campaign& campaign, const Prediction& prediction) {
  return sheet_of_channels(
      campaign.name + ": measured (points), predicted without fitting (lines)", prediction,
      [](const ChannelView& channel) {
        return empty_plot({std::string(channel.title), std::string(channel.unit), channel.per_si, {}});
      },
      [](Plot& plot, const ChannelView& channel, Series points, const std::vector<const PredictedRun*>& runs) {
        Series line = predicted_line(runs, channel);
        if (points.label.empty()) points.label = "all runs";
        line.color = points.color, line.label = points.label;
        points.mark = Mark::points;
        plot.series.push_back(std::move(line));
        plot.series.push_back(over_samples(
            std::move(points), runs, [](const PredictedRun* run) { return 100 * run->measured.at.slip; },
            [&](const PredictedRun* run) {
              const auto& value = run->measured.*channel.measured;
              return value ? *value * channel.per_si : not_a_number;
            }));
      });
}

Sheet scatter_sheet(const Campaign& campaign, const Prediction& prediction) {
  return sheet_of_channels(
      campaign.name + ": predicted against measured", prediction,
      [](const ChannelView& channel) {
        return Plot{heading(channel), {"measured"}, {"predicted"}, {}, true};
      },
      [](Plot& plot, const ChannelView& channel, Series points, const std::vector<const PredictedRun*>& runs) {
        points.mark = Mark::points;
        for (const PredictedRun* run : runs)
          if (const auto& measured = run->measured.*channel.measured; measured && run->predicted.result) {
            points.x.push_back(*measured * channel.per_si);
            points.y.push_back(((*run->predicted.result).*channel.predicted).value * channel.per_si);
          }
        plot.series.push_back(std::move(points));
      });
}

}  // namespace soilbin::compare
