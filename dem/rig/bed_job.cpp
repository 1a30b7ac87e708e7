#include "dem/rig/bed_job.hpp"

#include "dem/archive/note_text.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::dem {

namespace fs = std::filesystem;

template <class Notes>
void archive(Notes& notes, GrainFraction& fraction) {
  notes(fraction.radius, fraction.share);
}

template <class Notes>
void archive(Notes& notes, BedRecipe& recipe) {
  auto& [soil, size, packing, grading, settling_friction, gravity, dt, laws, rest, settled_by, periodic] =
      recipe;  // LAMMPS settles none that is periodic
  auto& [radius_min, radius_max, density, gravity_there, young, poisson, rolling, twisting, cohesion, shape, sizes,
         spacing, grain_grain, grain_tire,
         sources] = soil;  // LAMMPS settles spheres without jkr; sources change no bed, and gravity is the recipe's
  notes(radius_min, radius_max, density, young, poisson, rolling, twisting, grain_grain, grain_tire);
  notes(size.length, size.width, size.depth, packing);
  notes(grading.factor, grading.half_width, grading.depth, grading.transition);
  notes(settling_friction, gravity, dt);
  notes(laws.normal, laws.rolling, laws.cohesion, laws.twisting, laws.tangential_damping);
  notes(rest.kinetic, rest.unbalanced, rest.every, rest.at_most, settled_by, sizes);
}

template <class Notes>
void archive(Notes& notes, BedReport& report) {
  notes(report.grains, report.height, report.void_ratio, report.bulk_density, report.coordination, report.rattlers,
        report.overlap, report.unrest.kinetic, report.unrest.unbalanced, report.settling_time);
}

namespace {

constexpr const char *bed_job_mark = "soilbin-bed-job/1 ", *bed_report_mark = "soilbin-bed-report/1 ";
fs::path bed_job_file(const fs::path& folder) { return folder / "recipe.txt"; }
fs::path bed_report_file(const fs::path& folder) { return folder / "report.txt"; }

template <class What>
void write_marked(const fs::path& file, const char* mark, What what) {
  NoteWriter writer;
  writer(what);
  write_file_atomically(file, mark + writer.text());
}

template <class What>
What read_marked(const fs::path& file, std::string_view mark, const char* called) {
  constexpr std::size_t largest = std::size_t{1} << 16;
  const std::string text = read_bytes(file, largest);
  if (!text.starts_with(mark)) throw InputError({file.string(), 0, 0}, std::string("is no ") + called, "", "");
  NoteReader reader(file.string(), std::string_view(text).substr(mark.size()));
  What what{};
  reader(what);
  reader.end();
  return what;
}

}  // namespace

bool is_bed_job(const fs::path& folder) { return is_there(bed_job_file(folder)); }
void write_bed_job(const fs::path& folder, const BedRecipe& recipe) {
  write_marked(bed_job_file(folder), bed_job_mark, recipe);
}
BedRecipe read_bed_job(const fs::path& folder) {
  return read_marked<BedRecipe>(bed_job_file(folder), bed_job_mark, "recipe of a bed");
}
void write_bed_report(const fs::path& folder, const BedReport& report) {
  write_marked(bed_report_file(folder), bed_report_mark, report);
}
BedReport read_bed_report(const fs::path& folder) {
  return read_marked<BedReport>(bed_report_file(folder), bed_report_mark, "report of a bed");
}

}  // namespace soilbin::dem
