#include "dem/worker_lammps/lammps_run.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "dem/archive/sealed_file.hpp"
#include "dem/surface/shapes.hpp"
#include "scenario/estimate.hpp"

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

constexpr std::int64_t between_words = 100;  // steps, as StagedRun
const FileKind state_kind{"lammps", 1, "notes of a run follow at byte 512: dem/worker_lammps/lammps_run.cpp"};

fs::path grains_file(const fs::path& folder, std::int64_t step) { return folder / fmt::format("grains-{}", step); }

bool is_old(const std::string& name, const std::string& newest) {
  return name.starts_with("grains-") && name != newest && !name.starts_with(newest + ".");
}

std::map<std::string, std::string> read_notes(const fs::path& file) {
  const SealedFile sealed(file, state_kind);
  NoteReader reader(file.string(), sealed.content());
  std::vector<NamedNote> all;
  reader(all);
  reader.end();
  std::map<std::string, std::string> notes;
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
  found_ = read_notes(folder_ / "state");
  if (found_["inputs"] != job_.inputs)
    throw InputError({(folder_ / "state").string(), 0, 0}, "is the restart of another run", "",
                     "remove it to start anew");
  if (speaks() && how_.tell) how_.tell("going on from step " + found_["step"]);
  return std::make_unique<LammpsSimulation>(world, job_.setup, job_.bed.state, log,
                                            grains_file(folder_, std::stoll(found_["step"])).string(),
                                            found_["simulation"], std::vector<Body>{wheel_of(job_)});
}

double LammpsRun::seconds() const {
  return earlier_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

void LammpsRun::through(const std::function<void()>& stages) {
  stages();
  tell_cost();
}

void LammpsRun::tell_cost() const {
  const double grains = simulation_->grain_count(), bytes = simulation_->memory_a_grain();
  const double taken = static_cast<double>(simulation_->state().step - begun_at_), time = seconds() - earlier_;
  int ranks = 1;
  MPI_Comm_size(simulation_->world(), &ranks);
  if (speaks() && how_.tell)
    how_.tell(fmt::format("{} grains, {} steps on {} {} in {:.4g} s: {:.3g} grain-steps/s; {:.0f} bytes a grain",
                          grains, taken, ranks, ranks == 1 ? "process" : "processes", time, grains * taken / time,
                          bytes));
}

void LammpsRun::once(const std::function<void()>& what) {
  if (at_.enters()) what();
}

void LammpsRun::steps(std::string_view stage, std::int64_t steps, const std::function<void(std::int64_t)>& each) {
  loop(
      stage, [&] { return at_.taken < steps; }, [&] { each(at_.taken); });
}

void LammpsRun::loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each) {
  if (!at_.enters()) return;
  for (; goes_on(); ++at_.taken) {
    if (at_.taken % between_words == 0) tell(stage);
    each();
  }
}

void LammpsRun::step() {
  simulation_->run(1);
  ++steps_;
}

/// Also writes a restart where it is due, and stops where any process was told to.
void LammpsRun::tell(std::string_view stage) {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - written_;
  int asks[] = {how_.stop.stop_requested(), speaks() && since.count() >= between_};
  MPI_Allreduce(MPI_IN_PLACE, asks, 2, MPI_INT, MPI_MAX, simulation_->world());
  const double share = std::min(1.0, static_cast<double>(steps_) / all_steps_);
  if (!folder_.empty() && (asks[0] || asks[1])) write_restart();
  if (asks[0]) throw Stopped();
  if (speaks() && how_.progress)
    how_.progress({stage, share, share > 0 ? seconds() * (1 - share) / share : not_a_number});
}

void LammpsRun::write_restart() {
  const std::int64_t step = simulation_->state().step;
  if (step == begun_at_) return;  // nothing is lost
  const fs::path grains = grains_file(folder_, step);
  simulation_->write_grains(grains.string());
  std::vector<NamedNote> notes{
      {"inputs", job_.inputs}, {"step", std::to_string(step)}, {"simulation", simulation_->notes()}};
  const double before = std::exchange(earlier_, seconds());
  for (const Kept& part : kept_) notes.push_back({part.name, part.text()});
  earlier_ = before;
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
