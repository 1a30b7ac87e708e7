#include "compare/recorded/record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "compare/recorded/kept_file.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/sealed_json.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/checksum.hpp"
#include "scenario/errors.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

// A record's members as JSON keys, for the visitors of json_fields.hpp.

template <class Visitor, class Losses>
void loss_fields(Visitor& v, Losses& losses) {
  v.number("damping", losses.damping, "W", "in normal dashpots");
  v.number("shear_damping", losses.shear_damping, "W", "in tangential dashpots");
  v.number("sliding", losses.sliding, "W", "in sliders");
  v.number("into_slide", losses.into_slide, "W", "taken by tangential springs, dashpots and sliders together");
  v.number("into_roll", losses.into_roll, "W", "taken by rolling resistance");
}

template <class Visitor, class Power>
void power_fields(Visitor& v, Power& power) {
  v.number("drive", power.drive, "W", "M w");
  v.number("pull", power.pull, "W", "F_DP v");
  v.number("climb", power.climb, "W", "lifts the load up the slope");
  v.number("heave", power.heave, "W", "lifts the load out of the soil; negative while the wheel sinks");
  v.number("into_soil", power.into_soil, "W", "given to the grains");
  v.number("rest", power.rest, "W", "drive less all these");
  v.group("losses", "where grains lost it; all 0 where nobody counted",
          [&](auto& inner) { loss_fields(inner, power.losses); });
}

template <class Visitor, class Density>
void bed_fields(Visitor& v, Density& bed) {
  v.number("void_ratio", bed.void_ratio, "-", "volume of voids over volume of grains");
  v.number("bulk_density", bed.bulk, "kg/m^3", "mass of grains over the volume with voids");
  v.number("coordination", bed.coordination, "-", "contacts a grain");
}

template <class Visitor, class Profile>
void rut_fields(Visitor& v, Profile& rut) {
  v.number("from", rut.from, "m", "begin of the stretch behind the wheel, x in the bin");
  v.number("to", rut.to, "m", "its end");
  v.number("axle", rut.axle, "m", "where the axle stood at the end, x in the bin");
  v.numbers("y", rut.y, "m", "from the middle of the track to the left");
  v.numbers("across", rut.across, "m", "change of height at each y, mean over the stretch");
  v.numbers("x", rut.x, "m", "along the bin");
  v.numbers("along", rut.along, "m", "change of height at each x, mean over the tire's width");
  v.number("volume", rut.volume, "m^3", "of the change over the whole bin: heaped - dug");
  v.number("heaped", rut.heaped, "m^3", "above the old surface");
  v.number("dug", rut.dug, "m^3", "below the old surface");
}

template <class Visitor, class Flow>
void flow_fields(Visitor& v, Flow& flow) {
  v.number("cell", flow.cell, "m", "side of a cell");
  v.whole("nx", flow.nx, "cells along x, which varies fastest");
  v.whole("nz", flow.nz, "cells along z");
  v.number("x", flow.x, "m", "lower corner of the first cell, from the axle");
  v.number("z", flow.z, "m", "lower corner of the first cell, from the axle");
  v.numbers("vx", flow.vx, "m/s", "mean velocity against the bin, forward; null where no grain came");
  v.numbers("vz", flow.vz, "m/s", "upward");
  v.numbers("solid", flow.solid, "-", "mean volume of grains with their centres in a cell, over the cell's");
}

/// Members of every run, with a result or without.
template <class Visitor, class Run>
void run_fields(Visitor& v, Run& run) {
  v.whole("packing", run.packing, "seed of the bed");
  v.text("source", run.source, "state of the sources that the program was built from");
  v.number("seconds", run.seconds, "s", "that it took on the clock on the wall");
}

/// Members of a run with a result, beside the result itself.
template <class Visitor, class Run>
void outcome_fields(Visitor& v, Run& run) {
  stress_fields(v, *run.answer.result);
  v.flag("steady", run.steady, "whether the run became steady");
  v.number("drift", run.drift, "-",
           "largest difference of halves over its standard error, of pull, torque and sinkage");
  v.group("power", "powers, means over the steady part", [&](auto& inner) { power_fields(inner, run.power); });
  v.added_group("bed", "how dense the bed was before the wheel, in its core",
                [&](auto& inner) { bed_fields(inner, run.bed); });
  v.group("rut", "change of the surface seen from above", [&](auto& inner) { rut_fields(inner, run.rut); });
  v.group("flow", "mean velocity of the soil round the wheel, in its middle plane",
          [&](auto& inner) { flow_fields(inner, run.flow); });
}

/// Told of a run whose errors aren't early ones (RecordedRun::early_errors).
constexpr const char *errors_key = "std_error_by", *errors_of_now = "blocks and autocorrelation";

constexpr const char* how_to_mend = "take that run out of the file, and the command that made it runs it again";

Json lines_json(const std::string& text) {
  Json lines = Json::array();
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

std::string lines_text(const ReadJson& from, const std::string& key) {
  if (!from.at(key).is_array()) ReadJson::refuse(from.below(key), "a list of lines");
  std::string text;
  for (const Json& line : from.at(key)) {
    if (!line.is_string()) ReadJson::refuse(from.below(key), "a list of lines");
    text += line.get<std::string>() + "\n";
  }
  return text;
}

Json run_json(const RecordedRun& run) {
  Json row = Json::object();
  WriteJson visitor(row);
  run_fields(visitor, run);
  row.update(to_json(run.answer));
  if (run.answer.result) {
    // The bare ratio, also where it is no efficiency: the mean of several packings weights every run's.
    row["tractive_efficiency"] = finite(run.answer.result->tractive_efficiency);
    outcome_fields(visitor, run);
    if (!run.early_errors) row[errors_key] = errors_of_now;
  }
  if (run.sealed) put_seal(row);
  return row;
}

/// In a file that has seals every run has one.
RecordedRun run_from_json(const Json& row, const std::string& place, bool seals_expected) {
  return read_json_at(place, [&] {
    RecordedRun run;
    run.sealed = check_seal(row, place, how_to_mend) == Seal::whole;
    if (seals_expected && !run.sealed)
      throw InputError(
          fmt::format("{}: its seal is missing: it was changed after it was written\n  hint: {}", place, how_to_mend));
    ReadJson visitor(row, place);
    run_fields(visitor, run);
    run.answer = answer_from_json(row, place);
    run.early_errors = run.answer.result && !row.contains(errors_key);
    if (run.answer.result) outcome_fields(visitor, run);
    return run;
  });
}

std::vector<RecordedRun> runs_from_json(const ReadJson& head, const std::string& key, bool seals_expected) {
  if (!head.at(key).is_array()) ReadJson::refuse(head.below(key), "a list");
  std::vector<RecordedRun> runs;
  for (const Json& row : head.at(key))
    runs.push_back(run_from_json(row, head.below(fmt::format("{}[{}]", key, runs.size())), seals_expected));
  return runs;
}

/// A line a run.
std::string runs_text(const char* key, const std::vector<RecordedRun>& runs) {
  std::string text = fmt::format(",\n  \"{}\": [", key);
  for (const RecordedRun& run : runs) text += (&run == runs.data() ? "\n    " : ",\n    ") + run_text(run);
  return text + "\n  ]";
}

/// The question that the runs answer, as its members are sealed together.
Json head_json(const Record& record) {
  Json inputs = Json::object();
  for (const auto& [name, value] : record.inputs) inputs[name] = value;
  return {{"format", recorded_format}, {"soilbin", record.soilbin},
          {"model", record.model},     {"inputs_key", inputs_key(record.inputs)},
          {"inputs", inputs},          {"case", lines_json(record.question)}};
}

/// Checks the seal of all above the runs, and the key of the inputs, which heads from before there were seals have too.
Seal check_head(const Json& document, const Record& record, const std::string& file) {
  Json head = Json::object();
  for (const auto& [key, value] : document.items())
    if (key != "runs" && key != "half_step" && key != "coarser") head[key] = value;
  const std::string begin_anew = "take a copy of the file, or begin another one";
  const Seal seal = check_seal(head, file + ": the inputs or the case", begin_anew);
  if (document.contains("inputs_key") && document["inputs_key"] != inputs_key(record.inputs))
    throw InputError(fmt::format(
        "{}: the inputs don't fit their key: they were changed after they were written\n  hint: {}", file, begin_anew));
  return seal;
}

const std::string* value_of(const Inputs& inputs, const std::string& name) {
  const auto found = std::ranges::find_if(inputs, [&](const auto& input) { return input.first == name; });
  return found == inputs.end() ? nullptr : &found->second;
}

Json seal_schema(const std::string& of) {
  return {{"type", "string"}, {"description", "checksum of " + of + "; absent in files from before there was one"}};
}

bool looked_at(const std::string& name, const std::vector<std::string>& only) {
  return only.empty() || std::ranges::any_of(only, [&](const std::string& begin) { return name.starts_with(begin); });
}

/// Older records hold the force in the wheel's plane times the speed of travel where forces are told in the wheel's
/// axes.
void mend_efficiencies(Record& record) {
  const std::string* radius = value_of(record.inputs, "tire.radius");
  if (radius == nullptr) return;
  for (RecordedRun& run : record.runs)
    if (std::optional<TractionResult>& result = run.answer.result;
        result && result->at.force_frame == ForceFrame::wheel)
      result->tractive_efficiency = tractive_efficiency(*result, read_number(*radius).value_or(not_a_number));
}

}  // namespace

std::string inputs_key(const Inputs& inputs) {
  std::string text;
  for (const auto& [name, value] : inputs) text += name + ' ' + value + '\n';
  return fnv1a_digits(text);
}

Record parse_record(const SourceText& source) {
  const Json document = parse_json(source, "a record is made by 'soilbin run STUDY --model dem --record FILE'");
  const ReadJson head(document, source.file + ": ");
  if (head.at("format") != recorded_format)
    throw InputError(fmt::format("{}: expected the format '{}'", source.file, recorded_format));
  Record record;
  ReadJson reader = head;
  reader.text("soilbin", record.soilbin, "");
  reader.text("model", record.model, "");
  record.question = lines_text(head, "case");
  if (!head.at("inputs").is_object()) ReadJson::refuse(head.below("inputs"), "an object");
  for (const auto& [name, value] : head.at("inputs").items()) {
    if (!value.is_string()) ReadJson::refuse(head.below("inputs." + name), "a text");
    record.inputs.emplace_back(name, value.get<std::string>());
  }
  record.sealed = check_head(document, record, source.file) == Seal::whole;
  record.runs = runs_from_json(head, "runs", record.sealed);
  if (document.contains("half_step")) record.half_step = runs_from_json(head, "half_step", record.sealed);
  if (document.contains("coarser")) record.coarser = runs_from_json(head, "coarser", record.sealed);
  mend_efficiencies(record);
  return record;
}

Record read_record(const std::filesystem::path& path) {
  const std::vector<SourceText> documents = kept_documents(path);
  Record record = parse_record(documents.front());
  for (std::size_t k = 1; k < documents.size(); ++k) add_missing_runs(record, parse_record(documents[k]));
  return record;
}

std::string record_text(const Record& record) {
  Json head = head_json(record);
  if (record.sealed) put_seal(head);
  std::string text = json_text(head);
  text.erase(text.rfind('\n', text.size() - 2));
  if (!record.coarser.empty()) text += runs_text("coarser", record.coarser);
  if (!record.half_step.empty()) text += runs_text("half_step", record.half_step);
  return text + runs_text("runs", record.runs) + "\n}\n";
}

std::string run_text(const RecordedRun& run) {
  return run_json(run).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void put_in_order(Record& record) {
  const auto before = [](const RecordedRun& a, const RecordedRun& b) {
    return std::tie(a.packing, a.answer.at) < std::tie(b.packing, b.answer.at);
  };
  for (const RunKind kind : run_kinds) std::ranges::stable_sort(record.list(kind), before);
}

std::string unsealed_note(const Record& record, const std::filesystem::path& file) {
  const auto bare = std::ranges::count_if(record.runs, [](const auto& run) { return !run.sealed; });
  if (bare == 0) return "";
  return fmt::format(
      "{}: {} of its {} runs carry no seal, as from before there were any: damage to them can't be detected",
      file.string(), bare, record.runs.size());
}

Json record_schema() {
  const RecordedRun run{.answer = {{}, TractionResult{}, ""}, .source = {}, .power = {}, .rut = {}, .flow = {}};
  FieldsSchema always, solved;
  run_fields(always, run);
  result_fields(solved, *run.answer.result);
  outcome_fields(solved, run);
  Json row = always.schema;
  row["properties"]["seal"] = seal_schema("the run's other members");
  row["properties"].update(condition_schema());
  row["properties"].update(solved.schema["properties"]);
  row["properties"][errors_key] = {
      {"const", errors_of_now},
      {"description", "how the standard errors were made; absent in older runs, whose sinkage has too small a one"}};
  row["properties"]["error"] = {{"type", "string"}, {"description", "why there is no result"}};
  const Json without = {{"required", {"error"}}};
  row["anyOf"] = Json::array({without, Json{{"required", solved.schema["required"]}}});
  FieldsSchema whole;
  whole.add("format", {{"const", recorded_format}}, "which format this is");
  whole.text("soilbin", "", "version that began the file");
  whole.text("model", "", "that answered");
  whole.text("inputs_key", "", "hash of the inputs, for people; not read");
  whole.add("inputs", {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}},
            "what an answer depends on beside condition and packing");
  whole.add("case", {{"type", "array"}, {"items", {{"type", "string"}}}}, "the resolved case, its lines of YAML");
  whole.add("runs", {{"type", "array"}, {"items", row}}, "a condition on a packing each, SI");
  whole.schema["properties"]["half_step"] = {
      {"type", "array"},
      {"items", row},
      {"description", "some of the runs again, on the same bed at half the time step; absent where nobody made any"}};
  whole.schema["properties"]["coarser"] = {
      {"type", "array"},
      {"items", row},
      {"description",
       fmt::format("some of the runs again, with grains {} times as large; absent where nobody made any", coarser_by)}};
  whole.schema["properties"]["seal"] = seal_schema("the members above");
  whole.schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  whole.schema["title"] = "A soilbin record";
  return whole.schema;
}

void refuse_other_inputs(const Record& record, const Inputs& asked, const std::filesystem::path& file,
                         const std::vector<std::string>& only) {
  std::string differing;
  const auto tell = [&](const std::string& name, const std::string* there, const std::string* here) {
    differing +=
        fmt::format("\n  {}: {} in the file, {} asked for", name, there ? *there : "nothing", here ? *here : "nothing");
  };
  for (const auto& [name, value] : record.inputs) {
    if (!looked_at(name, only)) continue;
    const std::string* here = value_of(asked, name);
    if (here == nullptr || *here != value) tell(name, &value, here);
  }
  for (const auto& [name, value] : asked)
    if (looked_at(name, only) && value_of(record.inputs, name) == nullptr) tell(name, nullptr, &value);
  if (differing.empty()) return;
  throw InputError(fmt::format(
      "{} holds answers to another question:{}\n  hint: another file for these inputs, or the inputs of the file",
      file.string(), differing));
}

std::string in_words(const RunSpec& spec) {
  return fmt::format("{}, bed sample {}{}", in_words(spec.at), spec.packing,
                     spec.kind == RunKind::half_step ? ", half the time step"
                     : spec.kind == RunKind::coarser ? ", coarser grains"
                                                     : "");
}

bool answers(const RecordedRun& run, const RunSpec& spec) {
  return run.packing == spec.packing && alike(run.answer.at, spec.at);
}

const RecordedRun* find_run(const Record& record, const RunSpec& spec) {
  for (const RecordedRun& run : record.list(spec.kind))
    if (answers(run, spec)) return &run;
  return nullptr;
}

void add_missing_runs(Record& record, const Record& other) {
  for (const RunKind kind : run_kinds)
    for (const RecordedRun& run : other.list(kind))
      if (find_run(record, {run.answer.at, run.packing, kind}) == nullptr) record.list(kind).push_back(run);
  put_in_order(record);
}

}  // namespace soilbin::compare
