#include "dem/worker_lammps/lammps_run.hpp"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "dem/archive/sealed_file.hpp"
#include "dem/surface/shapes.hpp"

namespace soilbin::dem {

namespace fs = std::filesystem;

/// A note with its name.
struct NamedNote {
  std::string name, text;
};

template <class Notes>
void parts(Notes& notes, NamedNote& note) {
  notes(note.name, note.text);
}

namespace {

const FileKind state_kind{"lammps", 1, "notes of a run follow at byte 512: dem/worker_lammps/lammps_run.cpp"};

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

}  // namespace

LammpsRun::LammpsRun(MPI_Comm world, const WheelJob& job, const WorkOptions& how, fs::path folder, double seconds)
    : job_(job), how_(how), folder_(std::move(folder)), between_(seconds) {
  MPI_Comm_rank(world, &rank_);
  simulation_ = begin(world);
  begun_at_ = simulation_->state().step;
  keep("stages", *this);
}

std::unique_ptr<LammpsSimulation> LammpsRun::begin(MPI_Comm world) {
  const std::string log = folder_.empty() ? "" : (folder_ / "log.lammps").string();
  if (folder_.empty() || !fs::exists(folder_ / "state"))
    return std::make_unique<LammpsSimulation>(world, job_.setup, job_.bed.state, log);
  Notes found = read_notes(folder_ / "state");
  if (found["inputs"] != job_.inputs)
    throw InputError({(folder_ / "state").string(), 0, 0}, "is the restart of another run", "",
                     "remove it to start anew");
  if (speaks() && how_.tell) how_.tell("going on from step " + found["step"]);
  auto simulation = std::make_unique<LammpsSimulation>(world, job_.setup, job_.bed.state, log,
                                                       grains_file(folder_, std::stoll(found["step"])).string(),
                                                       found["simulation"], std::vector<Body>{wheel_of(job_)});
  go_on_from(std::move(found), (folder_ / "state").string());
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

/// Also writes a restart where it is due, and stops where any process was told to.
void LammpsRun::look(std::string_view stage, double share) {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - written_;
  int asks[] = {how_.stop.stop_requested(), speaks() && since.count() >= between_};
  MPI_Allreduce(MPI_IN_PLACE, asks, 2, MPI_INT, MPI_MAX, simulation_->world());
  if (!folder_.empty() && (asks[0] || asks[1])) write_restart();
  if (asks[0]) throw Stopped();
  if (speaks() && how_.progress) how_.progress(progress(stage, share));
}

void LammpsRun::write_restart() {
  const std::int64_t step = simulation_->state().step;
  if (step == begun_at_) return;  // nothing is lost
  const fs::path grains = grains_file(folder_, step);
  simulation_->write_grains(grains.string());
  std::vector<NamedNote> notes{
      {"inputs", job_.inputs}, {"step", std::to_string(step)}, {"simulation", simulation_->notes()}};
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
