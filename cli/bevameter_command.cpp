// soilbin bevameter: from a soil's grains to the values of the Bekker / Wong-Reece model.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/element_test_flags.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "cli/text_output.hpp"
#include "compare/bevameter/bevameter.hpp"
#include "compare/report/json_fields.hpp"
#include "dem/element_tests/plate_tests.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

struct BevameterOptions {
  std::string soil, output, plot;
  int packings = 2;
  bool json = false;
  ElementTestFlags flags;
};

struct Measured {
  std::vector<compare::PlateSet> plates;
  std::vector<compare::ShearCurve> shear;
  double density = 0;
};

/// A plate's curve from where it seats itself, as in the field: the surface is rough, and its mean as seen from above
/// lies below the tops that the plate comes to rest on.
bekker_wong::PlateCurve curve_of(const dem::PlateRun& run, double grain) {
  constexpr double seated = 1e3;  // [Pa]
  bekker_wong::PlateCurve out{.radius = run.diameter / 2, .pressure = {}, .sinkage = {}};
  double contact = 0;
  bool found = false;
  for (const dem::PlateSample& sample : run.curve) {
    if (!found && sample.pressure > seated) contact = sample.sinkage, found = true;
    if (!found || sample.sinkage < contact + 0.1 * grain || sample.pressure <= 0) continue;
    out.pressure.push_back(sample.pressure);
    out.sinkage.push_back(sample.sinkage - contact);
  }
  return out;
}

compare::ShearCurve curve_of(const dem::AnnulusRun& run) {
  compare::ShearCurve out;
  for (const dem::AnnulusSample& sample : run.curve) {
    out.displacement.push_back(sample.displacement);
    out.shear_stress.push_back(sample.shear_stress);
    out.normal_stress += sample.normal_stress / static_cast<double>(run.curve.size());
  }
  return out;
}

Measured measure(const BevameterOptions& options, const GranularSoil& grains) {
  Measured out;
  dem::BedStore beds(folder_of_beds());
  const dem::WorkOptions how = options.flags.work();
  dem::PlateSettings plates;
  dem::AnnulusSettings ring;
  for (dem::TestBed* bed : {&plates.bed, &ring.bed}) {
    bed->specimen = options.flags.specimen(grains);
    bed->width *= options.flags.size, bed->depth *= options.flags.size;
  }
  for (int k = 0; k < options.packings; ++k) {
    compare::PlateSet set;
    for (const dem::PlateRun& run : dem::plate_sinkage(grains, plates, how, &beds)) {
      set.push_back(curve_of(run, mean_diameter(grains)));
      out.density = run.density;
    }
    out.plates.push_back(std::move(set));
    for (const dem::AnnulusRun& run : dem::annular_shear(grains, ring, how, &beds)) out.shear.push_back(curve_of(run));
    ++plates.bed.specimen.packing, ++ring.bed.specimen.packing;
  }
  return out;
}

std::string table_of(const compare::BevameterFit& fit, const Soil& soil) {
  TextTable table({"value", "bevameter", "soil file"});
  for (const SoilParameter& p : bevameter_parameters)
    table.add({with_unit(p), number(fit.soil.*p.value, p.per_si),
               soil.semi_empirical ? number((*soil.semi_empirical).*p.value, p.per_si) : "-"});
  std::string text = table.text();
  if (fit.cohesion_as_fitted < 0)
    text += fmt::format("cohesion came out at {} kPa and is given as 0\n", number(fit.cohesion_as_fitted / 1e3));
  return text + fmt::format("Bekker's form misses the pressures by {} % (root mean square over mean)\n",
                            number(fit.pressure_error * 100));
}

int bevameter(const BevameterOptions& options, const Session& session) {
  if (options.packings < 1) throw InputError("--packings: 1 or more");
  const Soil soil = find_soil(options.soil, session.place.library);
  const Measured measured = measure(options, grains_of(soil));
  const compare::BevameterFit fit = compare::fit_bevameter(measured.plates, measured.shear);
  clear_progress_line();
  const std::string source = fmt::format(
      "virtual bevameter on the grains of {}: 3 round plates, ring with grousers, {} packings, settling friction {}",
      soil.name, options.packings, number(options.flags.specimen(grains_of(soil)).settling_friction));
  Outputs outputs;
  outputs.file(options.output, [&] { return write_soil(with_bevameter(soil, fit, measured.density, source)); });
  outputs.drawing(options.plot, [&] {
    return compare::bevameter_sheet("bevameter: " + soil.name, measured.plates, measured.shear, fit);
  });
  if (options.json) {
    nlohmann::ordered_json document = {{"format", "soilbin-bevameter/1"}, {"soil", soil.name}};
    for (const SoilParameter& p : bevameter_parameters) document[p.name] = compare::estimate_json(fit.soil.*p.value);
    document["cohesion_as_fitted"] = fit.cohesion_as_fitted;
    document["pressure_error"] = fit.pressure_error;
    document["density"] = measured.density;
    print_json(document);
  } else {
    fmt::print("bevameter: {}, {} packings\n{}", soil.name, options.packings, table_of(fit, soil));
    if (!options.output.empty() && outputs.complete()) fmt::print("wrote {}\n", options.output);
  }
  return outputs.status(done);
}

}  // namespace

void add_bevameter(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("bevameter", "n, k_c, k_phi, c, phi and K of a soil's grains, by simulated plates and a ring");
  const auto options = std::make_shared<BevameterOptions>();
  command->add_option("soil", options->soil, "a soil of the library, or a YAML file")->type_name("SOIL")->required();
  add_file(*command, "--output", options->output, "FILE.yaml", "save the soil with these values");
  add_plot(*command, options->plot, "draw the curves (points) and the fit (lines)");
  command->add_option("--packings", options->packings, "number of beds, 2; their scatter is the error")->type_name("N");
  command->add_flag("--json", options->json, "soilbin-bevameter/1, in SI");
  options->flags.add_to(*command);
  command->footer("Example: soilbin bevameter paper-sand --settling-friction 0 --output paper-sand-dense.yaml");
  command->callback([=, &session] { session.action = [=, &session] { return bevameter(*options, session); }; });
}

}  // namespace soilbin::cli
