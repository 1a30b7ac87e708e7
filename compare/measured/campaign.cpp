#include "compare/measured/campaign.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/measured/run_columns.hpp"
#include "compare/measured/time_log.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/condition_axes.hpp"
#include "scenario/csv.hpp"
#include "scenario/effect_choices.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/named_parts.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/schema.hpp"
#include "scenario/schema_visitor.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// The `columns:` of a campaign: header -> what stands below it, and where that was said.
struct Renamed {
  ColumnChoice choice;
  const YamlNode* node = nullptr;
  bool used = false;
};
using Renames = std::map<std::string, Renamed>;

Renamed read_rename(const YamlNode& node, const Reading& reading) {
  expect_keys(node, {"quantity", "unit"}, reading);
  std::vector<std::string> quantities;
  for (const RunColumn& column : run_columns()) quantities.push_back(column.quantity);
  const YamlNode& quantity = *value_of(node, "quantity", Need::required, "what the column holds", reading);
  const RunColumn& column = run_columns()[read_word(quantity, quantities, reading)];
  const bool plain = column.measure.unit == "-";
  const YamlNode* unit = value_of(node, "unit", plain ? Need::optional : Need::required,
                                  fmt::format("of {}, such as '{}'", column.quantity, column.measure.unit), reading);
  Renamed renamed{{&column, column.measure.unit}, &node};
  if (unit == nullptr) return renamed;
  if (column.content != RunColumn::Content::number)
    reading.refuse(*unit, fmt::format("'{}' has no unit", column.quantity));
  renamed.choice.unit = read_name(*unit, reading);
  const Unit expected = parse_unit(column.measure.unit);
  try {
    const Unit written = parse_unit(renamed.choice.unit);
    if (!same_dimension(written.dimension, expected.dimension))
      reading.refuse(*unit,
                     fmt::format("the unit of '{}' must be that of {}, such as '{}'; '{}' is {}", column.quantity,
                                 dimension_name(expected), expected.text, written.text, dimension_name(written)),
                     expected.text == "N" && same_dimension(written.dimension, parse_unit("kg").dimension)
                         ? "if the column holds a weight in kilograms, write unit: kgf"
                         : "");
  } catch (const InputError& error) {
    if (error.position().line > 0) throw;
    reading.refuse(*unit, error.what());
  }
  return renamed;
}

Renames read_renames(const YamlNode* columns, const Reading& reading) {
  Renames renames;
  if (columns == nullptr) return renames;
  if (!columns->is_mapping())
    reading.refuse(*columns, "expected a mapping of column names, not " + columns->kind_name());
  for (std::size_t i = 0; i + 1 < columns->items.size(); i += 2)
    renames[columns->items[i].scalar] = read_rename(columns->items[i + 1], reading);
  return renames;
}

/// Takes the columns that `ignored:` names out of the table; gives what they look like.
std::vector<IgnoredColumn> leave_out(CsvTable& table, const YamlNode* ignored, const Renames& renames,
                                     const Reading& reading, const SourceText& csv) {
  std::vector<IgnoredColumn> left;
  if (ignored == nullptr) return left;
  if (!ignored->is_sequence()) reading.refuse(*ignored, "expected a list of column names, not " + ignored->kind_name());
  for (const YamlNode& item : ignored->items) {
    const std::string name = read_text(item, reading);
    if (renames.contains(name))
      reading.refuse(item, fmt::format("'{}' is under 'columns' and under 'ignored'", clipped(name)));
    const auto& cells = table.header.cells;
    const auto place = std::ranges::find(cells, name, &CsvCell::text) - cells.begin();
    if (place == std::ssize(cells)) continue;  // a misspelt name leaves its column unknown, and that is refused
    const auto column = static_cast<std::size_t>(place);
    std::vector<std::string> texts;
    for (const CsvRow& row : table.rows) texts.push_back(row.cells[column].text);
    left.push_back({name, csv.position(cells[column].offset), std::move(texts)});
    const auto erase = [&](CsvRow& row) { row.cells.erase(row.cells.begin() + place); };
    erase(table.header);
    std::ranges::for_each(table.rows, erase);
  }
  return left;
}

/// What a column is called without any `columns:`.
std::optional<ColumnChoice> known_column(const std::string& header) {
  for (const RunColumn& column : run_columns())
    if (column.canonical == header) return ColumnChoice{&column, column.measure.unit};
  return column_by_its_name(header);
}

/// What an unknown column most likely holds: by its header, by the known word that is spelt most like it, or by what
/// spreadsheets call it.
LikelyColumn likely_content(const std::string& header, const CsvTable& table, const std::vector<std::string>& right) {
  const std::string nearest = nearest_word(header, right);
  const RunColumn* column = column_begun_by(header);
  for (const RunColumn& known : run_columns())
    if (!column && known.canonical == nearest) column = &known;
  if (column) return {header, column, unit_at_the_end(header, *column)};
  const std::vector<LikelyColumn> all = likely_columns(table);
  return *std::ranges::find(all, header, &LikelyColumn::header);
}

/// Refuses columns that nobody knows, at the first of them, with what to write in campaign.yaml for all of them.
[[noreturn]] void refuse_unknown_columns(const std::vector<const CsvCell*>& unknown, const CsvTable& table,
                                         const Renames& renames, const SourceText& csv) {
  const CsvCell& first = *unknown.front();
  const std::string name = clipped(first.text);
  if (names_a_clock(first.text))
    csv.refuse(first.offset,
               fmt::format("column '{}' holds a time: these rows look like samples of a log, not runs", name),
               fmt::format("a campaign wants one row a run: soilbin runs '{}' makes them. Where each row is a run, "
                           "leave the column aside: ignored: [{}]",
                           csv.file, yaml_scalar(name)));
  std::vector<std::string> right;
  for (const RunColumn& column : run_columns()) right.push_back(column.canonical);
  for (const auto& [named, renamed] : renames) right.push_back(named);
  std::vector<std::string> others, likely, aside;
  for (const CsvCell* cell : unknown) {
    const std::string header = yaml_scalar(clipped(cell->text));
    const LikelyColumn content = likely_content(cell->text, table, right);
    if (cell != &first) others.push_back("'" + clipped(cell->text) + "'");
    if (content.column || unknown.size() == 1) likely.push_back(header + ": " + renaming_of(content, "UNIT"));
    if (!content.column || unknown.size() == 1) aside.push_back(header);
  }
  std::string wrong = fmt::format("unknown column '{}'{}", name, did_you_mean(first.text, right)),
              hint = "in campaign.yaml";
  if (!others.empty()) wrong += "; unknown too: " + listed(others);
  if (!likely.empty()) hint += fmt::format(" say what it holds, such as columns: {{{}}}", listed(likely));
  if (!aside.empty())
    hint += fmt::format("{} leave {} aside: ignored: [{}]",
                        likely.empty()   ? ""
                        : others.empty() ? ", or"
                                         : ", and",
                        others.empty() ? "it" : "what is not compared", listed(aside));
  csv.refuse(first.offset, wrong, hint + "; known without that: " + listed(right));
}

std::vector<ColumnChoice> choose_columns(const CsvTable& table, Renames& renames, const SourceText& csv) {
  std::vector<ColumnChoice> choices;
  std::vector<const CsvCell*> unknown;
  for (const CsvCell& header : table.header.cells) {
    const auto renamed = renames.find(header.text);
    const std::optional<ColumnChoice> known =
        renamed != renames.end() ? std::optional(renamed->second.choice) : known_column(header.text);
    if (renamed != renames.end()) renamed->second.used = true;
    if (!known) unknown.push_back(&header);
    const ColumnChoice choice = known.value_or(ColumnChoice{});
    for (std::size_t i = 0; known && i < choices.size(); ++i)
      if (choices[i].column == choice.column)
        csv.refuse(header.offset,
                   fmt::format("columns '{}' and '{}' both hold '{}'", clipped(table.header.cells[i].text),
                               clipped(header.text), choice.column->quantity));
    choices.push_back(choice);
  }
  if (!unknown.empty()) refuse_unknown_columns(unknown, table, renames, csv);
  const auto present = [&](const RunColumn& column) {
    return std::any_of(choices.begin(), choices.end(), [&](const ColumnChoice& c) { return c.column == &column; });
  };
  const CsvCell& first = table.header.cells.front();
  for (std::size_t i = 0; i < choices.size(); ++i)
    if (const std::string& beside = choices[i].column->beside;
        !beside.empty() && std::none_of(choices.begin(), choices.end(),
                                        [&](const ColumnChoice& c) { return c.column->canonical == beside; }))
      csv.refuse(table.header.cells[i].offset,
                 fmt::format("column '{}' gives the scatter of '{}', and that column is missing",
                             clipped(table.header.cells[i].text), beside));
  for (const RunColumn& column : run_columns())
    if (column.required && !present(column))
      csv.refuse(first.offset, fmt::format("column '{}' is missing", column.canonical));
  if (std::none_of(choices.begin(), choices.end(), [](const ColumnChoice& c) { return c.column->channel; }))
    csv.refuse(first.offset, "no measured channel",
               "one of drawbar_pull_N, torque_Nm, sinkage_m, lateral_force_N is needed");
  return choices;
}

/// The speed of a run that gives the wheel's rotation in its place. That of a wheel that is locked, 0, tells none: the
/// run keeps the speed of one that gives neither.
void add_speeds(Campaign& campaign, const CsvTable& table, const SourceText& csv) {
  const auto rotation = campaign.columns.find("rotation"), speed = campaign.columns.find("speed");
  if (rotation == campaign.columns.end()) return;
  const auto refuse = [&](std::size_t row, const std::string& why) {
    for (std::size_t i = 0; i < table.header.cells.size(); ++i)
      if (table.header.cells[i].text == rotation->second.header)
        csv.refuse((row == 0 ? table.header : table.rows[row - 1]).cells[i].offset, why);
  };
  if (speed != campaign.columns.end())
    refuse(0, fmt::format("columns '{}' and '{}' both give the speed", speed->second.header, rotation->second.header));
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) try {
      Run& run = campaign.runs[i];
      const bool locked = run.rotation == 0.0 && run.at.slip <= -1.0;
      if (run.rotation && !locked) run.at.speed = speed_at_rotation(run.at, *run.rotation, campaign.wheel);
      run.rotation.reset();
    } catch (const InputError& error) {
      refuse(i + 1, error.what());
    }
}

void check_amount(const Campaign& campaign, const SourceText& csv, CampaignUse use) {
  if (use == CampaignUse::design) return;
  const auto rows = std::count_if(campaign.runs.begin(), campaign.runs.end(), has_channel);
  if (rows == 0) csv.refuse(0, "no measured channel: no row holds a measured value");
  const int parameters = free_parameters(campaign.soil);
  if (use == CampaignUse::fit && rows < parameters)
    csv.refuse(0,
               fmt::format("{} rows with a measured value are fewer than the {} free parameters of the soil", rows,
                           parameters),
               "measure more runs; an sd that is left out to pass makes the soil's value exact");
}

void read_model(const YamlNode* model, Campaign& campaign, const EffectVocabulary& effects, Reading reading) {
  if (model == nullptr) return;
  expect_keys(*model, {"effects"}, reading);
  reading.n = campaign.soil.exponent.value;
  if (const YamlNode* list = value_of(*model, "effects", Need::optional, "list of ids; [] for none", reading))
    campaign.effects = read_effects(*list, effects, reading);
}

constexpr const char* wheel_meaning = "radius, width and, where there are any, lugs; or a tire of the library";
constexpr const char* soil_meaning = "what plate and shear tests say: value and sd; or a soil of the library";

/// A named soil gives its cone index too, where the campaign tells none.
SemiEmpiricalSoil read_values(const YamlNode& soil, const Library& library, const Reading& reading,
                              Campaign& campaign) {
  if (soil.is_mapping() && !names_a_bed(soil)) return read_mapping<SemiEmpiricalSoil>(soil, reading);
  const Soil named = read_soil_part(soil, library, reading);
  if (!named.semi_empirical)
    reading.refuse(soil, fmt::format("a campaign needs a soil with a 'semi_empirical' section; '{}' has none",
                                     clipped(named.name)));
  if (!campaign.cone_index && !campaign.cone_index_gradient)
    campaign.cone_index = named.cone_index, campaign.cone_index_gradient = named.cone_index_gradient;
  return *named.semi_empirical;
}

std::string campaign_yaml(const Campaign& campaign, const EffectVocabulary& effects) {
  YamlLines lines;
  lines.value("format", campaign_format);
  Writing writing{&lines, std::nullopt, nullptr, ""};
  write_members(campaign, writing);
  write_group("wheel", campaign.wheel, lines);
  write_group("soil", campaign.soil, lines);
  lines.open("model");
  write_effects(campaign.effects, effects, campaign.soil.exponent.value, lines);
  lines.close();
  return lines.text();
}

}  // namespace

Scenario scenario_of(const Campaign& campaign) {
  Scenario scenario;
  scenario.tire = campaign.wheel;
  scenario.soil.name = campaign.name;
  scenario.soil.semi_empirical = campaign.soil;
  scenario.soil.cone_index = campaign.cone_index, scenario.soil.cone_index_gradient = campaign.cone_index_gradient;
  scenario.bin = campaign.bin;
  scenario.effects = campaign.effects;
  return scenario;
}

int free_parameters(const SemiEmpiricalSoil& soil) {
  return static_cast<int>(std::count_if(soil_parameters.begin(), soil_parameters.end(),
                                        [&](const SoilParameter& p) { return (soil.*p.value).std_error > 0.0; }));
}

Campaign parse_campaign(const SourceText& yaml, const std::function<SourceText(const std::string&)>& open,
                        const Library& library, const EffectVocabulary& effects, CampaignUse use) {
  if (yaml.file.ends_with(".csv") || yaml.file.ends_with(".CSV"))
    throw InputError(
        fmt::format("'{0}' holds the rows\n  hint: name its folder, or the campaign.yaml beside it; where "
                    "there is none, soilbin init --campaign mine --from '{0}' writes one",
                    yaml.file));
  const YamlNode document = parse_yaml(yaml);
  const Reading reading{&yaml, std::nullopt, nullptr, ""};
  expect_format(document, campaign_format, reading);
  Campaign campaign =
      read_mapping<Campaign>(document, reading, {"format", "wheel", "soil", "model", "columns", "ignored"});
  const Library near = library.beside(yaml.file);
  campaign.wheel = read_tire_part(*value_of(document, "wheel", Need::required, wheel_meaning, reading), near, reading);
  campaign.soil =
      read_values(*value_of(document, "soil", Need::required, soil_meaning, reading), near, reading, campaign);
  read_model(value_of(document, "model", Need::optional, "{effects: []}", reading), campaign, effects, reading);
  Renames renames =
      read_renames(value_of(document, "columns", Need::optional, "names and units; {} for none", reading), reading);
  const SourceText csv = open(campaign.data);
  if (use == CampaignUse::design && csv.text.empty()) {
    for (const auto& [name, renamed] : renames)
      campaign.columns[renamed.choice.column->quantity] = {name, renamed.choice.unit, {}};
    return campaign;
  }
  CsvTable table = parse_csv(csv);
  campaign.ignored = leave_out(table, value_of(document, "ignored", Need::optional, "list of column names", reading),
                               renames, reading, csv);
  const std::vector<ColumnChoice> columns = choose_columns(table, renames, csv);
  std::vector<std::string> headers;
  for (const CsvCell& header : table.header.cells) headers.push_back(header.text);
  for (const auto& [name, renamed] : renames)
    if (!renamed.used)
      reading.refuse(*renamed.node,
                     fmt::format("'{}' has no column '{}'{}", csv.file, clipped(name), did_you_mean(name, headers)),
                     "its columns: " + listed(headers));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const CsvCell& header = table.header.cells[i];
    campaign.columns[columns[i].column->quantity] = {header.text, columns[i].unit, csv.position(header.offset)};
  }
  campaign.runs = read_runs(table, columns, csv);
  for (Run& run : campaign.runs) {
    run.at.slip_by = campaign.slip_by;
    run.at.force_frame = campaign.force_frame;
  }
  add_speeds(campaign, table, csv);
  check_amount(campaign, csv, use);
  return campaign;
}

fs::path campaign_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  const fs::path file = path / "campaign.yaml";
  if (is_there(file)) return file;
  std::string rows = "ROWS.csv";
  for (const auto& entry : fs::directory_iterator(path, error))
    if (entry.path().extension() == ".csv") rows = rows == "ROWS.csv" ? entry.path().string() : "ROWS.csv";
  throw InputError(fmt::format("{}: no such file\n  hint: soilbin init --campaign '{}' --from '{}' writes one",
                               file.string(), path.string(), rows));
}

std::map<std::string, DataColumn> declared_columns(const fs::path& path, const Library& library,
                                                   const EffectVocabulary& effects) {
  const auto no_rows = [](const std::string& name) { return SourceText{name, ""}; };
  return parse_campaign(read_source_text(campaign_file(path), largest_yaml), no_rows, library, effects,
                        CampaignUse::design)
      .columns;
}

Campaign read_campaign(const fs::path& path, const Library& library, const EffectVocabulary& effects, CampaignUse use) {
  const fs::path file = campaign_file(path);
  const auto open = [&](const std::string& name) {
    const fs::path data = file.parent_path() / name;
    if (use == CampaignUse::design && !fs::exists(data)) return SourceText{data.string(), ""};
    return read_source_text(data, largest_csv);
  };
  return parse_campaign(read_source_text(file, largest_yaml), open, library, effects, use);
}

void write_campaign(const fs::path& folder, const Campaign& campaign, const EffectVocabulary& effects) {
  make_folder(folder);
  write_file_atomically(folder / campaign.data, write_runs(campaign.runs));
  write_file_atomically(folder / "campaign.yaml", campaign_yaml(campaign, effects));
}

namespace {

using nlohmann::ordered_json;

ordered_json columns_schema() {
  std::vector<std::string> quantities;
  for (const RunColumn& column : run_columns()) quantities.push_back(column.quantity);
  ordered_json column = empty_object_schema();
  column["properties"] = {{"quantity", words_schema(quantities, "what the column holds")},
                          {"unit", text_schema("of the numbers in it, such as 'N'")}};
  column["required"] = {"quantity"};
  return {{"type", "object"}, {"additionalProperties", column}, {"description", "columns with names of their own"}};
}

}  // namespace

ordered_json campaign_schema(const EffectVocabulary& effects) {
  ordered_json campaign = object_schema<Campaign>();
  ordered_json wheel = named_or(object_schema<Tire>()), soil = soil_part_schema(object_schema<SemiEmpiricalSoil>());
  wheel["description"] = "the wheel that was tested";
  soil["description"] = "what plate and shear tests say: value and sd";
  campaign["properties"]["wheel"] = std::move(wheel), campaign["properties"]["soil"] = std::move(soil);
  for (const char* key : {"wheel", "soil"}) campaign["required"].push_back(key);
  ordered_json model = empty_object_schema();
  model["properties"]["effects"] = effects_schema(effects);
  campaign["properties"]["model"] = model;
  campaign["properties"]["columns"] = columns_schema();
  campaign["properties"]["ignored"] = {{"type", "array"},
                                       {"items", {{"type", "string"}}},
                                       {"description", "columns of the data file that are left aside"}};
  campaign["properties"]["format"] = {{"const", campaign_format}};
  campaign["required"].push_back("format");
  ordered_json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "A soilbin campaign"}};
  schema.update(campaign);
  return schema;
}

}  // namespace soilbin::compare
