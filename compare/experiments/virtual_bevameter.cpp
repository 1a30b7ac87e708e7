#include "compare/experiments/virtual_bevameter.hpp"

#include "dem/element_tests/tool_bed.hpp"

namespace soilbin::compare {
namespace {

/// A plate's curve from a tenth of a grain below its seat on.
bekker_wong::PlateCurve curve_of(const dem::PlateRun& run, double grain) {
  bekker_wong::PlateCurve out{.radius = run.diameter / 2, .pressure = {}, .sinkage = {}};
  const double seat = run.seat();
  for (const dem::PlateSample& sample : run.curve) {
    if (sample.sinkage < seat + 0.1 * grain || sample.pressure <= 0) continue;
    out.pressure.push_back(sample.pressure);
    out.sinkage.push_back(sample.sinkage - seat);
  }
  return out;
}

ShearCurve curve_of(const dem::AnnulusRun& run) {
  ShearCurve out;
  for (const dem::AnnulusSample& sample : run.curve) {
    out.displacement.push_back(sample.displacement);
    out.shear_stress.push_back(sample.shear_stress);
    out.normal_stress += sample.normal_stress / static_cast<double>(run.curve.size());
  }
  return out;
}

}  // namespace

BevameterReadings virtual_bevameter(const GranularSoil& grains, const VirtualBevameter& asked, dem::BedStore& beds) {
  BevameterReadings out;
  dem::PlateSettings plates = asked.plates;
  dem::AnnulusSettings ring;
  for (dem::TestBed* bed : {&plates.bed, &ring.bed}) {
    bed->specimen = asked.specimen;
    bed->width *= asked.size, bed->depth *= asked.size;
    dem::check_bed(*bed);
  }
  for (int k = 0; k < asked.packings; ++k) {
    PlateSet set;
    for (const dem::PlateRun& run : dem::plate_sinkage(grains, plates, asked.how, &beds)) {
      set.push_back(curve_of(run, mean_diameter(grains)));
      out.density = run.density;
    }
    out.plates.push_back(std::move(set));
    for (const dem::AnnulusRun& run : dem::annular_shear(grains, ring, asked.how, &beds))
      out.shear.push_back(curve_of(run));
    ++plates.bed.specimen.packing, ++ring.bed.specimen.packing;
  }
  return out;
}

}  // namespace soilbin::compare
