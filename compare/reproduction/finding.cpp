#include "compare/reproduction/finding.hpp"

#include <set>

#include "scenario/mapping_reader.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::compare {
namespace {

Where read_where(const YamlNode& node, const Reading& reading) {
  if (!node.is_mapping())
    reading.refuse(node, "expected a mapping of axes", "such as {slip: [10 %, 30 %], load: 4 kN}");
  Where where;
  for (std::size_t k = 0; k + 1 < node.items.size(); k += 2) {
    const FindingAxis axis = read_choice<FindingAxis>(node.items[k], reading);
    const YamlNode& value = node.items[k + 1];
    Measure measure = measure_of(axis);
    measure.range = any_value;
    if (value.is_sequence() && value.items.size() != 2) reading.refuse(value, "a range has two ends");
    const YamlNode &first = value.is_sequence() ? value.items[0] : value,
                   &last = value.is_sequence() ? value.items[1] : value;
    where[axis] = {read_scalar(first, measure, reading).value, read_scalar(last, measure, reading).value};
    if (where[axis].first > where[axis].second) reading.refuse(value, "the range runs downward");
  }
  return where;
}

/// In which unit a claim is written: places along the axis in its own, all else as plain SI numbers.
Measure measure_of_claim(const Finding& finding) {
  const bool place = finding.test == FindingTest::peak || finding.test == FindingTest::lowest ||
                     finding.test == FindingTest::peak_shift;
  Measure measure = place ? measure_of(finding.along) : Measure{};
  measure.range = any_value;
  return measure;
}

Finding read_finding(const YamlNode& node, const Reading& reading) {
  Finding finding = read_mapping<Finding>(node, reading, {"where", "against", "step", "at_least", "at_most"});
  if (const YamlNode* where = node.find("where")) finding.where = read_where(*where, reading);
  if (const YamlNode* against = node.find("against")) finding.against = read_where(*against, reading);
  const Measure claim = measure_of_claim(finding);
  const YamlNode *least = node.find("at_least"), *most = node.find("at_most"), *step = node.find("step");
  if (least) finding.at_least = read_scalar(*least, claim, reading).value;
  if (most) finding.at_most = read_scalar(*most, claim, reading).value;
  if (step) finding.step = read_scalar(*step, measure_of(finding.along), reading).value;
  if (!least && !most) reading.refuse(node, "no claim", "at_least, at_most or both");
  if (finding.at_least > finding.at_most) reading.refuse(node, "at_least is more than at_most");
  if ((node.find("against") != nullptr) != finding.compares())
    reading.refuse(node, finding.compares() ? "'against' is missing" : "this test compares with nothing");
  if ((step != nullptr) != (finding.test == FindingTest::change))
    reading.refuse(node, "'step' and the test 'change' belong together");
  return finding;
}

}  // namespace

const ConditionView& view_of(FindingAxis axis) { return condition_view(word_of(axis)); }

Measure measure_of(FindingAxis axis) { return {std::string(view_of(axis).column_unit), view_of(axis).range}; }

Findings parse_findings(const SourceText& source) {
  const YamlNode document = parse_yaml(source);
  const Reading reading{&source, std::nullopt, nullptr, ""};
  expect_format(document, findings_format, reading);
  expect_keys(document, {"format", "name", "source", "level", "seed", "findings"}, reading);
  Findings findings;
  const auto need = [&](const char* key, const char* meaning) -> const YamlNode& {
    return *value_of(document, key, Need::required, meaning, reading);
  };
  findings.name = read_name(need("name", "what to call the publication"), reading);
  findings.source = read_text(need("source", "the publication"), reading);
  findings.level =
      read_scalar(need("level", "of the intervals"), {"-", {.lower = 0.5, .upper = 1, .upper_open = true}}, reading)
          .value;
  findings.seed = static_cast<std::uint64_t>(read_integer(need("seed", "of the bootstrap"), 0, reading));
  const YamlNode& list = need("findings", "a list");
  if (!list.is_sequence()) reading.refuse(list, "expected a list of findings");
  std::set<std::string> ids;
  for (const YamlNode& node : list.items) {
    findings.all.push_back(read_finding(node, reading));
    if (!ids.insert(findings.all.back().id).second) reading.refuse(node, "two findings have this id");
  }
  return findings;
}

Findings read_findings(const std::filesystem::path& path) {
  return parse_findings(read_source_text(path, largest_yaml));
}

}  // namespace soilbin::compare
