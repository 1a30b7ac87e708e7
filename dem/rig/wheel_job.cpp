#include "dem/rig/wheel_job.hpp"

#include "dem/archive/note_text.hpp"
#include "dem/rig/bed_job.hpp"
#include "dem/rig/rig_settings.hpp"
#include "dem/rig/wheel_in_bin.hpp"
#include "dem/rig/wheel_result.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::dem {

namespace fs = std::filesystem;

namespace {

constexpr const char* job_wheel_note = "wheel";
constexpr const char* job_inputs_note = "inputs";
fs::path grains_of(const fs::path& job) { return job.parent_path() / "bed.h5"; }

constexpr const char* answer_mark = "soilbin-wheel-answer/1 ";

}  // namespace

template <class Notes>
void archive(Notes& notes, OperatingCondition& at) {
  auto& [load, slip, speed, longitudinal_incline, transverse_incline, yaw, pass, slip_by, force_frame, moisture,
         position, run, inflation_pressure, rut_load, rut_slip] = at;  // grains meet a rigid tire
  notes(load, slip, speed, longitudinal_incline, transverse_incline, yaw, pass, slip_by, force_frame, moisture,
        position, run);
}

template <class Notes>
void archive(Notes& notes, Rig& rig) {
  describe_rig(rig, [&](const char*, auto& member, const auto&...) {
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(member)>>) notes(member);
  });
}

template <class Notes>
void archive(Notes& notes, WheelJob& job) {
  BedRecipe& bed = job.bed.recipe;
  notes(bed.soil.radius_min, bed.soil.radius_max, bed.size.length, bed.size.width, bed.size.depth, bed.gravity);
  notes(bed.rest.kinetic, bed.rest.unbalanced, bed.rest.every, bed.rest.at_most);
  notes(job.bed.report.void_ratio, job.bed.report.bulk_density, job.bed.report.coordination);
  Tire& tire = job.tire;
  notes(tire.radius, tire.width, tire.lugs.height, tire.lugs.count, tire.lugs.thickness, tire.lugs.pattern,
        tire.lugs.angle);
  std::string folder = job.bed.grains_in.string();
  notes(job.contact, job.rig, job.at, folder);
  job.bed.grains_in = folder;
}

template <class Notes>
void archive(Notes& notes, SoilFlow& flow) {
  auto& [cell, nx, nz, x, z, vx, vz, solid] = flow;
  notes(cell, nx, nz, x, z, vx, vz, solid);
}

template <class Notes>
void archive(Notes& notes, Rut& rut) {
  auto& [from, to, axle, y, across, x, along, volume, heaped, dug] = rut;
  notes(from, to, axle, y, across, x, along, volume, heaped, dug);
}

template <class Notes>
void archive(Notes& notes, WheelRun& run) {
  notes(run.samples, run.surface, run.bed.void_ratio, run.bed.bulk, run.bed.coordination, run.rut, run.flow,
        run.earlier);
}

void write_job(const fs::path& file, const WheelOnBed& on, const OperatingCondition& at, const std::string& inputs) {
  WheelJob job{.setup = {},
               .bed = {on.bed.recipe, {}, {}, on.bed.report, on.bed.grains_in},
               .tire = on.tire,
               .contact = on.contact,
               .rig = on.rig,
               .at = at,
               .inputs = {}};
  NoteWriter writer;
  writer(job);
  const Setup setup = run_setup(on, 1);
  State without_grains;
  without_grains.step = on.bed.state.step, without_grains.time = on.bed.state.time;
  without_grains.gravity = on.bed.state.gravity, without_grains.bodies = on.bed.state.bodies;
  if (on.bed.grains_in.empty()) write_restart(grains_of(file), setup, on.bed.state, {}, Keep::nothing);
  write_restart(file, setup, without_grains, {{job_wheel_note, writer.text()}, {job_inputs_note, inputs}},
                Keep::nothing);
}

WheelJob read_job(const fs::path& file, WithGrains grains) {
  Restart restart = read_restart(file);
  WheelJob job{};
  NoteReader reader(file.string(), restart.notes[job_wheel_note]);
  reader(job);
  reader.end();
  job.inputs = restart.notes[job_inputs_note];
  job.setup = restart.setup;
  job.bed.setup = std::move(restart.setup), job.bed.state = std::move(restart.state);
  if (grains == WithGrains::yes && job.bed.grains_in.empty()) job.bed.state = read_restart(grains_of(file)).state;
  return job;
}

void write_answer(const fs::path& file, const WheelRun& run) {
  NoteWriter writer;
  WheelRun copy = run;
  writer(copy);
  write_file_atomically(file, answer_mark + writer.text());
}

WheelRun read_answer(const fs::path& file, const Tire& tire, const OperatingCondition& at, const Rig& rig) {
  constexpr std::size_t largest = std::size_t{1} << 30;
  const std::string text = read_bytes(file, largest);
  if (!text.starts_with(answer_mark)) throw InputError({file.string(), 0, 0}, "is no answer of a wheel's run", "", "");
  WheelRun run;
  NoteReader reader(file.string(), std::string_view(text).substr(std::string_view(answer_mark).size()));
  reader(run);
  reader.end();
  summarise(run, tire, at, rig);
  return run;
}

}  // namespace soilbin::dem
