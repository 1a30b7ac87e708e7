// Force tables: what interpolates exactly does, what does not is off by what closed forms say, and gaps are told.
#include "compare/export/force_table.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "compare/experiments/force_table_file.hpp"
#include "compare/telling/reports.hpp"
#include "dem/archive/hdf5.hpp"
#include "scenario/errors.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A model whose drawbar pull is a function of the condition; torque twice that, the rest 0.
class FunctionModel final : public Model {
 public:
  using Pull = std::function<double(const OperatingCondition&)>;
  explicit FunctionModel(Pull pull) : pull_(std::move(pull)) {}
  std::string name() const override { return "function"; }
  TractionResult evaluate(const Scenario&, const OperatingCondition& at) const override {
    TractionResult result;
    result.at = at;
    result.drawbar_pull = {pull_(at), 0.1 * std::abs(pull_(at))}, result.torque = {2 * pull_(at), 0.0};
    return result;
  }

 private:
  Pull pull_;
};

MakeModel made_by(FunctionModel::Pull pull) {
  return [pull = std::move(pull)](ModelKind) -> std::unique_ptr<const Model> {
    return std::make_unique<const FunctionModel>(pull);
  };
}

/// Loads of 100, 200, 400 N and slips of 0, 0.1 .. 0.4.
Case grid_question() {
  Case question;
  question.name = "grid", question.scenario.tire.name = "wheel";
  question.scenario.tire.radius = question.scenario.tire.width = 0.1;
  question.scenario.soil.name = "soil";
  question.study.models = {{ModelKind::bekker_wong, {}, "bekker_wong"}};
  for (const double slip : {0.0, 0.1, 0.2, 0.3, 0.4})  // not in the table's order
    for (const double load : {400.0, 100.0, 200.0}) question.study.conditions.push_back({.load = load, .slip = slip});
  return question;
}

ForceTable table_by(FunctionModel::Pull pull) { return force_table(grid_question(), {}, made_by(std::move(pull))); }

std::string table_refusal(const Case& question) {
  return soilbin::test::refusal(
      [&] { force_table(question, {}, made_by([](const OperatingCondition&) { return 1.0; })); });
}

TEST(ForceTable, OrdersItsNodesTheLastAxisFastest) {
  const ForceTable table = table_by([](const OperatingCondition& at) { return at.load + at.slip; });
  ASSERT_EQ(table.axes.size(), 2U);
  EXPECT_EQ(table.axes[0].view->name, "load");
  EXPECT_EQ(table.axes[1].view->name, "slip");
  EXPECT_THAT(table.axes[0].nodes, testing::ElementsAre(100, 200, 400));
  EXPECT_EQ(table.channels[0].values[0], 100.0);
  EXPECT_EQ(table.channels[0].values[1], 100.1);
  EXPECT_EQ(table.channels[0].values[5], 200.0);
  EXPECT_EQ(table.nodes.answers.size(), 15U);
  EXPECT_EQ(table.cells, 8U);
}

TEST(ForceTable, HasNoErrorWhereTheModelIsMultilinear) {
  const auto pull = [](const OperatingCondition& at) { return 3 + 2 * at.load - 7 * at.slip + 5 * at.load * at.slip; };
  const ForceTable table = table_by(pull);
  EXPECT_LT(table.channels[0].largest_error, 1e-12 * table.channels[0].scale);
  const auto found = look_up(table, {137.0, 0.33});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->values[0], pull({.load = 137.0, .slip = 0.33}), 1e-9);
  EXPECT_NEAR(found->std_errors[0], 0.1 * found->values[0], 1e-9);
  EXPECT_FALSE(found->clamped);
}

// Half-way between nodes a step h apart a square is off by (h/2)^2: at slips of 0.1 by 0.0025, in every cell.
TEST(ForceTable, MeasuresTheErrorOfASquare) {
  const ForceTable table = table_by([](const OperatingCondition& at) { return at.slip * at.slip; });
  EXPECT_NEAR(table.channels[0].largest_error, 0.0025, 1e-15);
  EXPECT_NEAR(table.channels[0].rms_error, 0.0025, 1e-15);
  EXPECT_NEAR(table.channels[1].rms_error, 0.005, 1e-15);
  EXPECT_NEAR(roughest(table).share, 0.0025 / 0.16, 1e-12);
  EXPECT_EQ(coarsest(table).view->name, "slip");
  EXPECT_NEAR(coarsest(table).error_share, 0.0025 / 0.16, 1e-12);
  EXPECT_LT(table.axes[0].error_share, 1e-12);
}

TEST(ForceTable, ClampsOutsideItsRangeAndSaysSo) {
  const ForceTable table = table_by([](const OperatingCondition& at) { return at.load * at.slip; });
  const auto beyond = look_up(table, {1000.0, -0.5});
  ASSERT_TRUE(beyond);
  EXPECT_TRUE(beyond->clamped);
  EXPECT_EQ(beyond->values[0], 0.0);
  EXPECT_EQ(look_up(table, {1000.0, 0.4})->values[0], 160.0);
  EXPECT_FALSE(look_up(table, {400.0, 0.4})->clamped) << "the last node is within";
  EXPECT_FALSE(look_up(table, {not_a_number, 0.1}));
}

TEST(ForceTable, HasNoAnswerBesideANodeWithoutOne) {
  const ForceTable table = table_by([](const OperatingCondition& at) -> double {
    if (at.load > 300 && at.slip > 0.35) throw NoSolution("the wheel buries itself");
    return at.load;
  });
  EXPECT_EQ(table.without_answer, 1U);
  EXPECT_EQ(table.cells, 7U) << "the cell beside it has no middle to check";
  EXPECT_FALSE(look_up(table, {390.0, 0.39}));
  EXPECT_TRUE(look_up(table, {390.0, 0.3})) << "on the edge of that cell";
  EXPECT_THAT(csv_of(table), HasSubstr("\n400,0.4,,,,,,,,,the wheel buries itself\n"));
  EXPECT_THAT(text_of(report_on(table)), HasSubstr("1 of 15 nodes have no answer"));
}

TEST(ForceTable, CountsGapsThatOnlyTheModelHas) {
  const ForceTable table = table_by([](const OperatingCondition& at) -> double {
    if (at.load == 300 && at.slip > 0.3) throw NoSolution("a gap");
    return at.load;
  });
  EXPECT_EQ(table.without_answer, 0U);
  EXPECT_EQ(table.cells_without_answer, 1U);
  EXPECT_THAT(text_of(report_on(table)), HasSubstr("the table answers where the model does not"));
}

TEST(ForceTable, RefusesWhatIsNoGrid) {
  Case question = grid_question();
  question.study.conditions.pop_back();
  EXPECT_THAT(table_refusal(question), AllOf(HasSubstr("1 of the 15 nodes of load x slip"), HasSubstr("hint")));
  question = grid_question();
  question.study.conditions.back().pass = 2;
  EXPECT_THAT(table_refusal(question), HasSubstr("can't run over 'pass'"));
  question = grid_question();
  question.study.conditions.resize(1);
  EXPECT_THAT(table_refusal(question), HasSubstr("none varies"));
  question.study.models.push_back({ModelKind::rft, {}, "rft"});
  EXPECT_THAT(table_refusal(question), HasSubstr("the case asks 2: bekker_wong, rft"));
}

TEST(ForceTable, LeavesOutAChannelThatTheModelDoesNotKnow) {
  const ForceTable table = force_table(grid_question(), {}, [](ModelKind) -> std::unique_ptr<const Model> {
    class NoSinkage final : public Model {
     public:
      std::string name() const override { return "no sinkage"; }
      TractionResult evaluate(const Scenario&, const OperatingCondition& at) const override {
        TractionResult result;
        result.at = at, result.sinkage = {not_a_number, not_a_number};
        return result;
      }
    };
    return std::make_unique<const NoSinkage>();
  });
  ASSERT_EQ(table.channels.size(), 3U);
  EXPECT_THAT(c_header_of(table, {"t", "1"}), testing::Not(HasSubstr("sinkage;")));
}

TEST(ForceTable, IsToldWithTheAxisToRefine) {
  const ForceTable rough = table_by([](const OperatingCondition& at) { return std::sin(20 * at.slip); });
  EXPECT_GT(roughest(rough).share, rough_share);
  EXPECT_THAT(text_of(report_on(rough)), AllOf(HasSubstr("Refine it"), HasSubstr("steps of 'slip'")));
  const ForceTable fine = table_by([](const OperatingCondition& at) { return at.load; });
  EXPECT_THAT(text_of(report_on(fine)), testing::Not(HasSubstr("Refine it")));
}

TEST(ForceTable, StandsInHdf5AsInTheCsv) {
  const ForceTable table = table_by([](const OperatingCondition& at) { return at.load * at.slip; });
  const std::string bytes = hdf5_of(table, {.name = "t.h5", .version = "1", .resolved_case = "name: grid\n"});
  EXPECT_EQ(bytes, hdf5_of(table, {.name = "t.h5", .version = "1", .resolved_case = "name: grid\n"}));
  const dem::hdf5::InputFile file(bytes, "t.h5");
  EXPECT_EQ(file.root().get_text("axes"), "load slip");
  EXPECT_EQ(file.root().get_text("case"), "name: grid\n");
  std::vector<double> values(15), loads(3);
  file.root().open("values").read("drawbar_pull", dem::hdf5::Number::f64, {3, 5}, values.data());
  file.root().open("axes").read("load", dem::hdf5::Number::f64, {3}, loads.data());
  EXPECT_EQ(values, table.channels[0].values);
  EXPECT_THAT(loads, testing::ElementsAre(100, 200, 400));
}

TEST(ForceTable, GivesNamesThatCTakes) {
  EXPECT_EQ(c_name_of("there/rover table-2.h"), "rover_table_2");
  EXPECT_EQ(c_name_of("2wheels.h"), "table_2wheels");
  EXPECT_EQ(c_name_of("_x.h"), "table_x");
  EXPECT_EQ(c_name_of(".h"), "table_");
}

// The words that stand for them in the code of every table are no words in them.
TEST(ForceTable, TheHeaderOfAnyNameIsThatOfAnotherWithTheNameInItsPlace) {
  const ForceTable table =
      force_table(grid_question(), {}, made_by([](const OperatingCondition& at) { return at.load; }));
  const auto renamed = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
      text.replace(at, from.size(), to);
    return text;
  };
  const std::string plain = c_header_of(table, {"qqq", "1"});
  for (const auto& [name, capitals] : {std::pair("rename_forces", "RENAME_FORCES"),
                                       {"tire_name_table", "TIRE_NAME_TABLE"},
                                       {"PLACE", "PLACE"},
                                       {"NAME_SIZE_H", "NAME_SIZE_H"}})
    EXPECT_EQ(c_header_of(table, {name, "1"}), renamed(renamed(plain, "qqq", name), "QQQ", capitals));
}

TEST(ForceTable, NoNameEndsTheCommentOfItsHeader) {
  Case question = grid_question();
  question.scenario.soil.name = "sand */ int main";
  const ForceTable table = force_table(question, {}, made_by([](const OperatingCondition& at) { return at.load; }));
  EXPECT_THAT(c_header_of(table, {"t", "1"}), HasSubstr("sand * / int main"));
}

}  // namespace
}  // namespace soilbin::compare
