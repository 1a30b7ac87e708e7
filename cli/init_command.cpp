// soilbin init: a commented case or campaign to start from.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* starter_case =
    R"yaml(# A case is a question: this tire, on this soil, at these conditions, answered by these models.
# Try it:   soilbin check case.yaml
#           soilbin run case.yaml --plot curves.svg
#           soilbin explain case.yaml --load 80N --slip 20%
# Every number carries its unit. What there is to choose from: soilbin list tires|soils|effects.
format: soilbin-case/1
name: my-first-case
description: A small smooth wheel on dry sand

tire:                     # or a name of the library, e.g.  tire: rover-wheel
  name: my-wheel
  radius: 110 mm          # to the tread base, without lugs
  width: 100 mm
  # lugs: {height: 8 mm, count: 24}
  # inflation_pressure: 150 kPa      # absent: a rigid wheel

soil: dry-sand            # of the library; or write one out, with value, sd and source for each number

study:
  models:
    - bekker_wong                                        # the base model: no effect
    - {model: bekker_wong, effects: [slip_sinkage]}      # the same wheel, digging itself in as slip grows
  conditions:             # every combination of the values below
    load: [40 N, 80 N]
    slip: {from: 0 %, to: 60 %, step: 10 %}
    # yaw: 10 deg                      # the wheel points to the left of its travel
    # longitudinal_incline: 5 deg      # uphill
    # transverse_incline: 5 deg        # left side up
)yaml";

constexpr const char* starter_campaign =
    R"yaml(# A campaign is a wheel that was tested: what it is, what is known of the soil, and one row of runs.csv a run.
# Try it:   soilbin check FOLDER
#           soilbin predict FOLDER --plot predicted.svg
#           soilbin loop FOLDER --report loop.html
# THE ROWS ARE AN EXAMPLE, made by a script and not measured (docs/guide/first-campaign): put your own in their place.
# Every number here carries its unit.
format: soilbin-campaign/1
name: my-first-campaign

wheel:                    # or a name of the library, e.g.  wheel: rover-wheel   (soilbin list tires)
  radius: 125 mm          # to the tread base, without lugs
  width: 100 mm
  # lugs: {height: 8 mm, count: 24}
  # inflation_pressure: 150 kPa      # absent: a rigid wheel

# What you know of the soil without the wheel: value and standard deviation (sd). The sd matters as much as the value:
# the loop may move each value within it. Or a name of the library, e.g.  soil: dry-sand   (soilbin list soils)
soil:
  # Plate tests give these three, with their sd:  soilbin plates FILE.csv
  exponent:        {value: 1.10, sd: 0.06}
  k_c:             {value: 1.4 kN/m^(n+1), sd: 0.5 kN/m^(n+1)}
  k_phi:           {value: 1900 kN/m^(n+2), sd: 250 kN/m^(n+2)}
  # A shear box or a shear ring gives these.
  cohesion:        {value: 0.8 kPa, sd: 0.3 kPa}
  friction_angle:  {value: 30.5 deg, sd: 1.5 deg}
  shear_modulus:   {value: 15 mm, sd: 4 mm}            # Janosi's K
  # Nobody measures these two. Without the lines they are 0.30 and 0.25, with an sd of 0.15.
  stress_angle_c1: {value: 0.30, sd: 0.10}
  stress_angle_c2: {value: 0.20, sd: 0.10}
  density: 1550 kg/m^3

# bin: {depth: 0.5 m, width: 1.0 m}
model: {effects: []}      # effects that your own model already has: soilbin list effects
data: runs.csv

# What your spreadsheet calls its columns, and their units, where they differ from those of runs.csv:
# columns:
#   Pull kN: {quantity: drawbar_pull, unit: kN}
#   Slip %:  {quantity: slip, unit: "%"}
# Measure the sinkage: without it the loop overlooks effects such as a wheel that digs itself in.
)yaml";

/// One row a run: the mean of its steady part. Rows with one setpoint are re-runs, which show the noise.
constexpr const char* starter_runs = R"csv(run,setpoint,load_N,slip,drawbar_pull_N,torque_Nm,sinkage_m
1,140 N at 45 %,139.7,0.450,21.4,8.40,0.0294
2,100 N at 20 %,100.1,0.194,7.3,4.24,0.0209
3,140 N at 5 %,141.3,0.047,-5.8,4.18,0.0244
4,60 N at 45 %,60.0,0.452,11.7,3.33,0.0177
5,140 N at 45 %,140.1,0.451,22.2,8.33,0.0286
6,140 N at 20 %,138.7,0.204,10.4,6.65,0.0275
7,100 N at 30 %,100.4,0.295,12.5,4.96,0.0225
8,100 N at 30 %,99.9,0.302,12.2,4.90,0.0225
9,60 N at 5 %,60.2,0.047,-3.2,1.34,0.0147
10,100 N at 5 %,100.7,0.052,-5.0,2.71,0.0211
11,140 N at 10 %,139.1,0.094,1.0,5.18,0.0256
12,60 N at 20 %,59.9,0.198,5.0,2.27,0.0146
13,60 N at 10 %,60.3,0.099,-1.6,1.64,0.0148
14,60 N at 60 %,60.3,0.595,14.7,3.72,0.0181
15,140 N at 60 %,140.2,0.597,24.4,8.84,0.0315
16,100 N at 10 %,99.6,0.106,1.7,3.25,0.0203
17,60 N at 30 %,59.8,0.303,8.7,2.87,0.0158
18,140 N at 30 %,139.6,0.301,17.3,7.28,0.0272
19,100 N at 60 %,100.1,0.599,21.7,6.12,0.0251
20,100 N at 30 %,100.2,0.299,14.1,5.01,0.0227
21,60 N at 10 %,60.0,0.099,-0.7,1.85,0.0138
22,100 N at 45 %,100.1,0.458,19.8,5.48,0.0233
23,60 N at 10 %,60.1,0.101,-0.6,1.50,0.0139
24,140 N at 45 %,139.6,0.452,21.8,8.01,0.0296
)csv";

/// Where a file of this name may be written in the folder. Throws InputError where it is there, or can't be.
fs::path free_place(const std::string& folder, const char* name) {
  const fs::path file = fs::path(folder) / name;
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)))
    throw InputError(file.string() + " is there already and stays as it is; name another folder: soilbin init DIR");
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(folder + " is a file; a folder is expected");
  return file;
}

/// The line by which an editor finds the format's schema.
std::string schema_line(const char* format) {
  const std::optional<fs::path> schema = schema_file(format);
  return schema ? fmt::format("# yaml-language-server: $schema={}\n", schema->string()) : "";
}

int init_case(const std::string& folder) {
  const fs::path file = free_place(folder, "case.yaml");
  write_file_atomically(file, schema_line("case") + starter_case);
  fmt::print("wrote {}\nnext: soilbin run {}\n", file.string(), file.string());
  return done;
}

int init_campaign(const std::string& folder) {
  const fs::path file = free_place(folder, "campaign.yaml"), rows = free_place(folder, "runs.csv");
  write_file_atomically(rows, starter_runs);
  write_file_atomically(file, schema_line("campaign") + starter_campaign);
  fmt::print("wrote {} and {}, with example rows\nnext: soilbin check {}\n", file.string(), rows.string(), folder);
  return done;
}

}  // namespace

void add_init(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("init", "write a commented case or campaign to start from; never overwrites");
  const auto folder = std::make_shared<std::string>(".");
  const auto campaign = std::make_shared<bool>(false);
  command->add_option("folder", *folder, "folder to write into, made where it is missing; by default this one")
      ->type_name("DIR");
  command->add_flag("--campaign", *campaign, "a campaign with example rows, in place of a case");
  command->footer("Example: soilbin init mine --campaign");
  command->callback(
      [=, &session] { session.action = [=] { return *campaign ? init_campaign(*folder) : init_case(*folder); }; });
}

}  // namespace soilbin::cli
