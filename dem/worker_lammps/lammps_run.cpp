#include "dem/worker_lammps/lammps_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "dem/archive/sealed_file.hpp"
#include "dem/bed/bed_store.hpp"
#include "dem/surface/shapes.hpp"

namespace soilbin::dem {

namespace fs = std::filesystem;

/// A note with its name.
struct NamedNote {
  std::string name, text;
};

template <class Notes>
void archive(Notes& notes, NamedNote& note) {
  notes(note.name, note.text);
}

namespace {

const FileKind state_kind{"lammps", 2, "notes of a run follow at byte 512: dem/worker_lammps/lammps_run.cpp"};

fs::path grains_file(const fs::path& folder, std::int64_t step) { return folder / fmt::format("grains-{}", step); }

bool is_old(const std::string& name, const std::string& newest) {
  return name.starts_with("grains-") && name != newest && !name.starts_with(newest + ".");
}

Notes read_notes(const fs::path& file) {
  const SealedFile sealed(file, state_kind);
  NoteReader reader(file.string(), sealed.content());
  std::vector<NamedNote> all;
  reader(all);
  reader.end();
  Notes notes;
  for (NamedNote& note : all) notes[note.name] = std::move(note.text);
  return notes;
}

/// The wheel's surface, which a restart doesn't keep: it follows from the job.
Body wheel_of(const WheelJob& job) {
  Body body;
  body.name = "wheel";
  body.surfaces.push_back(
      {MeshSurface{std::make_shared<TriangleMesh>(tire_surface(job.tire, job.rig.meshing)), nullptr},
       static_cast<int>(job.setup.materials.all.size()) - 1});
  return body;
}

/// The grains that lie in a run's folder.
std::unique_ptr<LammpsSimulation> kept_in(const fs::path& folder, MPI_Comm world, const Setup& setup,
                                          const std::vector<Body>& bodies, const std::string& log) {
  Notes found = read_notes(folder / "state");
  return std::make_unique<LammpsSimulation>(world, setup, log, grains_file(folder, std::stoll(found["step"])).string(),
                                            found["simulation"], bodies);
}

}  // namespace

LammpsRun::LammpsRun(MPI_Comm world, const WheelJob& job, const WorkOptions& how, fs::path folder, double seconds)
    : LammpsRun(world, beginning_of(world, job), how, std::move(folder), seconds) {}

LammpsRun::LammpsRun(MPI_Comm world, const BedRecipe& recipe, const WorkOptions& how, fs::path folder, double seconds)
    : LammpsRun(world, beginning_of(world, recipe), how, std::move(folder), seconds) {}

LammpsRun::LammpsRun(MPI_Comm world, Beginning beginning, const WorkOptions& how, fs::path folder, double seconds)
    : inputs_(std::move(beginning.inputs)), how_(how), folder_(std::move(folder)), between_(seconds) {
  MPI_Comm_rank(world, &rank_);
  simulation_ = begin(world, beginning);
  begun_at_ = simulation_->state().step;
  keep("stages", *this);
}

LammpsRun::Beginning LammpsRun::beginning_of(MPI_Comm world, const WheelJob& job) {
  std::vector<Body> bodies = job.bed.state.bodies;
  const auto fresh = [&job, world](const std::string& log) {
    if (job.bed.grains_in.empty()) return std::make_unique<LammpsSimulation>(world, job.setup, job.bed.state, log);
    return kept_in(job.bed.grains_in, world, job.setup, job.bed.state.bodies, log);
  };
  bodies.push_back(wheel_of(job));
  return {job.inputs, job.setup, std::move(bodies), fresh};
}

LammpsRun::Beginning LammpsRun::beginning_of(MPI_Comm world, const BedRecipe& recipe) {
  const Setup setup = setup_of(recipe, 1);
  const std::vector<Body> bodies{bin_of(recipe.size)};
  const auto fresh = [&recipe, world, setup, bodies](const std::string& log) {
    return std::make_unique<LammpsSimulation>(world, setup, Vec3{0, 0, -recipe.gravity}, bodies,
                                              PouredGrains{.largest = recipe.grading.factor * recipe.soil.radius_max,
                                                           .pour = [&](const GrainSink& put) { pour(recipe, put); }},
                                              log);
  };
  return {recipe_text(recipe), setup, bodies, fresh};
}

std::unique_ptr<LammpsSimulation> LammpsRun::begin(MPI_Comm world, const Beginning& beginning) {
  const std::string log = folder_.empty() ? "" : (folder_ / "log.lammps").string();
  const fs::path state = folder_ / "state";
  if (folder_.empty() || !fs::exists(state)) return beginning.fresh(log);
  Notes found = read_notes(state);
  if (found["inputs"] != inputs_)
    throw InputError({state.string(), 0, 0}, "is the restart of another run", "", "remove it to start anew");
  if (speaks() && how_.tell) how_.tell("going on from step " + found["step"]);
  auto simulation = kept_in(folder_, world, beginning.setup, beginning.bodies, log);
  go_on_from(std::move(found), state.string());
  return simulation;
}

void LammpsRun::through(const std::function<void()>& stages) {
  stages();
  tell_cost();
}

void LammpsRun::tell_cost() const {
  const double grains = simulation_->grain_count(), bytes = simulation_->memory_a_grain();
  const double taken = static_cast<double>(simulation_->state().step - begun_at_), time = seconds() - earlier();
  int ranks = 1;
  MPI_Comm_size(simulation_->world(), &ranks);
  if (speaks() && how_.tell)
    how_.tell(fmt::format("{} grains, {} steps on {} {} in {:.4g} s: {:.3g} grain-steps/s; {:.0f} bytes a grain",
                          grains, taken, ranks, ranks == 1 ? "process" : "processes", time, grains * taken / time,
                          bytes));
}

void LammpsRun::step() {
  simulation_->run(1);
  count_step();
}

/// As many as take some seconds, so that a stop is not waited for.
std::int64_t LammpsRun::steps_between_looks() const {
  constexpr double grain_steps = 1e7;  // of a process: some six seconds
  int ranks = 1;
  MPI_Comm_size(simulation_->world(), &ranks);
  return static_cast<std::int64_t>(std::clamp(grain_steps * ranks / simulation_->grain_count(), 1.0, 100.0));
}

/// Shows the stage, writes a restart where it is due, and stops where any process was told to.
void LammpsRun::look(std::string_view stage, double share) {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - written_;
  int asks[] = {how_.stop.stop_requested(), speaks() && since.count() >= between_};
  MPI_Allreduce(MPI_IN_PLACE, asks, 2, MPI_INT, MPI_MAX, simulation_->world());
  if (asks[0] || asks[1]) write_restart();
  if (asks[0]) throw Stopped();
  if (speaks() && how_.progress) how_.progress(progress(stage, share));
}

void LammpsRun::write_restart() {
  const std::int64_t step = simulation_->state().step;
  if (folder_.empty() || step == begun_at_) return;  // nothing is lost
  const fs::path grains = grains_file(folder_, step);
  simulation_->write_grains(grains.string());
  std::vector<NamedNote> notes{
      {"inputs", inputs_}, {"step", std::to_string(step)}, {"simulation", simulation_->notes()}};
  for (auto& [name, text] : kept_notes()) notes.push_back({name, std::move(text)});
  if (speaks()) {
    NoteWriter writer;
    writer(notes);
    write_sealed(folder_ / "state", state_kind, writer.text(), Keep::nothing);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
      if (is_old(entry.path().filename().string(), grains.filename().string())) fs::remove(entry.path());
  }
  MPI_Barrier(simulation_->world());
  written_ = std::chrono::steady_clock::now();
}

}  // namespace soilbin::dem
