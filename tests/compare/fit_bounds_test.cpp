// What a fit may try is what a file may hold: a model that the loop saves can be read.
#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/loop_fixture.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/case.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

using Eigen::VectorXd;

Campaign all_free() {
  Campaign campaign = sand_campaign();
  campaign.runs.resize(2);
  campaign.runs[0].at.load = 100, campaign.runs[0].at.slip = 0.1;
  campaign.runs[1].at.load = 200, campaign.runs[1].at.slip = 0.3;
  return campaign;
}

TEST(FitBounds, LieInWhatAFileMayHold) {
  const Campaign campaign = all_free();
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  ASSERT_EQ(predictor.parameters().size(), soil_parameters.size()) << "every parameter of the soil is free";
  for (const FreeParameter& free : predictor.parameters()) {
    const Range& range = soil_parameter(free.name).range;
    EXPECT_LT(free.lower, free.upper) << free.name;
    for (const double bound : {free.lower, free.upper})
      EXPECT_TRUE(range.holds(bound) || (!std::isfinite(bound) && !(range.lower_open && bound == range.lower)))
          << free.name << " = " << bound;
  }
}

/// Every parameter at its lower bound (or upper), those without a bound where they are declared.
VectorXd at_bounds(const WheelPredictor& predictor, double FreeParameter::*bound) {
  VectorXd theta = predictor.start();
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const double value = predictor.parameters()[static_cast<std::size_t>(i)].*bound;
    if (std::isfinite(value)) theta[i] = value;
  }
  return theta;
}

/// What the loop saves of a campaign at theta.
Case saved_model(const Campaign& campaign, const WheelPredictor& predictor, const VectorXd& theta) {
  LoopAnswer answer;
  answer.soil = campaign.soil;
  for (std::size_t i = 0; i < soil_parameters.size(); ++i)
    (answer.soil.*soil_parameters[i].value).value = theta[static_cast<Eigen::Index>(i)];
  UnknownEffect unknown;
  for (const EffectChoice& choice : predictor.choices(theta)) unknown.proxy_effects.emplace_back().choice = choice;
  answer.outcome = std::move(unknown);
  return resolved_model(campaign, answer);
}

TEST(FitBounds, ASavedModelAtItsBoundsReadsBack) {
  const Campaign campaign = all_free();
  const Observations observations = observe(campaign);
  const bekker_wong::CatalogueVocabulary vocabulary;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    for (double FreeParameter::*bound : {&FreeParameter::lower, &FreeParameter::upper}) {
      const WheelPredictor predictor(campaign, observations, {make_term(form, observations, true)});
      const Case saved = saved_model(campaign, predictor, at_bounds(predictor, bound));
      const Case read =
          parse_case(make_source_text(write_case(saved, vocabulary), "saved.yaml"), Library(), vocabulary);
      for (const SoilParameter& p : soil_parameters)
        EXPECT_EQ(((*read.scenario.soil.semi_empirical).*p.value).value,
                  ((*saved.scenario.soil.semi_empirical).*p.value).value)
            << p.name << " with " << form.id << ":" << form.form;
      EXPECT_EQ(read.study.models.at(0).effects.at(0).parameters, saved.study.models.at(0).effects.at(0).parameters)
          << form.id << ":" << form.form;
    }
}

}  // namespace
}  // namespace soilbin::compare
