// A measured campaign: the wheel, what is known of the soil, and the runs. Files: campaign.yaml and a CSV of the runs
// (docs/reference/campaigns.md).
//
//   const Campaign campaign = read_campaign("cases/measured/cmu-smooth", Library({"cases"}),
//                                           bekker_wong::CatalogueVocabulary());
//   for (const Run& run : campaign.runs)
//     if (run.drawbar_pull) fmt::print("slip {:.2f}: {:.1f} N\n", run.at.slip, *run.drawbar_pull);
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenario/description.hpp"
#include "scenario/effect_vocabulary.hpp"
#include "scenario/library.hpp"
#include "scenario/scenario.hpp"
#include "scenario/source_text.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::compare {

/// The steady-state mean of one independent run.
struct Run {
  OperatingCondition at;                ///< slip_by and force_frame are the campaign's
  std::optional<std::string> setpoint;  ///< runs with the same label are re-runs of one setpoint
  std::optional<double> drawbar_pull;   ///< [N]
  std::optional<double> torque;         ///< [N m]
  std::optional<double> sinkage;        ///< [m]
  std::optional<double> lateral_force;  ///< [N]
  int csv_line = 0;
  /// Standard deviation in time of each traction channel over the run that its mean was taken of [SI], in the order of
  /// traction_channels. Samples follow each other, so it is no error of the mean; it tells which runs were unsteady.
  std::array<std::optional<double>, 4> within_run_sd{};
  /// Standard error of each channel's mean over the run [SI], by samples that follow each other (time_log.hpp). Of this
  /// run alone: how much another bed differs it does not hold.
  std::array<std::optional<double>, 4> mean_error{};
  std::optional<double> rotation{};  ///< of the wheel [rad/s]; a campaign that is read has turned it into at.speed
};

inline bool has_channel(const Run& run) { return run.drawbar_pull || run.torque || run.sinkage || run.lateral_force; }

/// A column as the data file has it.
struct DataColumn {
  std::string header;
  std::string unit;   ///< of the numbers in it
  SourcePosition at;  ///< of its header
};

/// A column that campaign.yaml has left aside.
struct IgnoredColumn {
  std::string header;
  SourcePosition at;               ///< of its header
  std::vector<std::string> texts;  ///< of each row
};

/// What was measured, and what is known beforehand.
struct Campaign {
  std::string name;
  Tire wheel;
  SemiEmpiricalSoil soil;  ///< std_error: what plate and shear tests leave open; 0: taken as exact
  std::optional<Bin> bin;
  std::vector<EffectChoice> effects;   ///< already in the analyst's model
  std::set<std::string> impossible{};  ///< ids of effects that can't be in the data, by how they were made
  std::string data = "runs.csv";
  ForceFrame force_frame = ForceFrame::travel;
  SlipBy slip_by = SlipBy::wheel_plane_speed;
  std::map<std::string, DataColumn>
      columns;  ///< of the data file, by quantity; without a file, those that campaign.yaml names
  std::vector<Run> runs;
  std::vector<IgnoredColumn> ignored{};  ///< they may tell that the rows are no runs (doubts/row_doubts.cpp)
  std::optional<Estimate> cone_index{}, cone_index_gradient{};  ///< as of a Soil; read by the model cone_index alone
};

inline constexpr const char* campaign_format = "soilbin-campaign/1";

/// What stands beside these: format, wheel and soil (written out or named), model, columns, ignored.
void describe(auto& v, std::type_identity<Campaign>) {
  v.text("name", &Campaign::name, Need::required, "what to call the campaign");
  v.group("bin", &Campaign::bin, Need::optional, "inner measures of the soil bin");
  v.text("data", &Campaign::data, Need::optional, "the CSV of the runs, beside campaign.yaml");
  v.choice("force_frame", &Campaign::force_frame, Need::optional, "axes of drawbar pull and lateral force");
  v.choice("slip_by", &Campaign::slip_by, Need::optional, "the speed from which slip was computed");
  v.number("cone_index", &Campaign::cone_index, Measure{"kPa", above_zero}, Need::optional,
           "of fine-grained soil; absent: that of a soil of the library");
  v.number("cone_index_gradient", &Campaign::cone_index_gradient, Measure{"MPa/m", above_zero}, Need::optional,
           "of sand; absent: that of a soil of the library");
}

/// The wheel and soil of a campaign as a scenario for a model.
Scenario scenario_of(const Campaign& campaign);

/// Soil values that a fit may move: those with sd > 0, of the eight of the semi-empirical model.
int free_parameters(const SemiEmpiricalSoil& soil);

/// What a campaign is read for. A fit needs a row with a measured value for each free value of the soil; a design none:
/// its data file may hold no row with one, and may be missing.
enum class CampaignUse { prediction, fit, design };

/// campaign.yaml of a folder, or the file itself. Throws InputError for a folder without one, with the command that
/// writes it.
std::filesystem::path campaign_file(const std::filesystem::path& path);

/// Reads a campaign: its folder or its campaign.yaml. Throws InputError with file, line, column and the nearest right
/// word for everything that the format does not allow. A wheel or soil that it names is looked up beside the file, then
/// in the library.
Campaign read_campaign(const std::filesystem::path& path, const Library& library, const EffectVocabulary& effects,
                       CampaignUse use = CampaignUse::prediction);

/// A campaign from texts in memory; `open` supplies the data file by the name that stands in the YAML.
Campaign parse_campaign(const SourceText& yaml, const std::function<SourceText(const std::string&)>& open,
                        const Library& library, const EffectVocabulary& effects,
                        CampaignUse use = CampaignUse::prediction);

/// The columns that a campaign.yaml declares under `columns:`, by quantity; its data file is not read.
std::map<std::string, DataColumn> declared_columns(const std::filesystem::path& path, const Library& library,
                                                   const EffectVocabulary& effects);

/// Writes campaign.yaml and the data file into a folder (made where it is missing). Reading them gives the same
/// campaign; an angle may differ in the last bit. Throws std::runtime_error where a file can't be written.
void write_campaign(const std::filesystem::path& folder, const Campaign& campaign, const EffectVocabulary& effects);

// soilbin-campaign/1 as JSON Schema, made from the descriptions that the reader visits.

nlohmann::ordered_json campaign_schema(const EffectVocabulary& effects);

// The four measured channels (drawbar pull, torque, sinkage, lateral force) as members of a run, so that code can go
// over them.

struct ChannelView : TractionChannel {
  std::optional<double> Run::*measured;
};

inline constexpr std::array<ChannelView, 4> channel_views = {{
    {traction_channels[0], &Run::drawbar_pull},
    {traction_channels[1], &Run::torque},
    {traction_channels[2], &Run::sinkage},
    {traction_channels[3], &Run::lateral_force},
}};

}  // namespace soilbin::compare
