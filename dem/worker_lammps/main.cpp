// soilbin-lammps: settles a bed, or makes one run of a wheel, with the grains in LAMMPS, on as many processes as mpirun
// starts.
//
//   mpirun -n 64 soilbin-lammps FOLDER
//
// FOLDER holds recipe.txt (dem/rig/bed_job.hpp) or job.h5 (dem/rig/wheel_job.hpp), as `soilbin run --engine lammps`
// writes them. The answer goes to report.txt or answer.txt there, a bed's grains beside it; why there is none to
// error.txt, whose first line says of what kind the error is: input, stopped, no_solution or other. Standard output
// gets 'progress STAGE SHARE SECONDS_LEFT' now and then, and at the end 'cost
// ...'. Exit status: 0 answered, 1 not, 3 stopped by SIGUSR1 (which mpirun hands on), SIGINT or SIGTERM.
#include <fmt/core.h>
#include <mpi.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>

#include "dem/rig/bed_job.hpp"
#include "dem/rig/wheel_run_stages.hpp"
#include "dem/worker_lammps/lammps_bed.hpp"
#include "dem/worker_lammps/processes.hpp"
#include "scenario/atomic_file.hpp"

namespace {

namespace fs = std::filesystem;
using namespace soilbin;

constexpr int answered = 0, failed = 1, stopped = 3;

/// Turns a signal into a request to stop. Made before MPI's threads, which leave the signals to it.
class StopBySignal {
 public:
  StopBySignal() {
    sigemptyset(&signals_);
    for (const int signal : {SIGUSR1, SIGINT, SIGTERM}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    waits_ = std::jthread([this] {
      int signal = 0;
      sigwait(&signals_, &signal);
      stop_.request_stop();
    });
  }
  StopBySignal(const StopBySignal&) = delete;
  StopBySignal& operator=(const StopBySignal&) = delete;
  ~StopBySignal() { pthread_kill(waits_.native_handle(), SIGUSR1); }
  std::stop_token token() const { return stop_.get_token(); }

 private:
  sigset_t signals_{};
  std::stop_source stop_;
  std::jthread waits_;
};

void print_progress(const dem::Progress& progress) {
  fmt::print("progress {} {} {}\n", progress.stage, progress.done, progress.seconds_left);
  std::fflush(stdout);
}

void print_line(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

/// What `read` gives on each process; where it fails on one, all throw.
template <class Read>
auto read_by_all(const Read& read) {
  decltype(read()) job;
  std::string fault;
  try {
    job = read();
  } catch (const InputError& error) {
    fault = error.what();
  }
  fault = dem::fault_of_any(MPI_COMM_WORLD, fault);
  if (!fault.empty()) throw InputError(fault);
  return job;
}

void settle_bed(const fs::path& folder, bool writes, const dem::WorkOptions& how) {
  const dem::BedRecipe recipe = read_by_all([&] { return dem::read_bed_job(folder); });
  dem::LammpsRun run(MPI_COMM_WORLD, recipe, how, folder);
  const dem::BedReport report = dem::settle_in_lammps(run, recipe);
  if (writes) dem::write_bed_report(folder, report);
}

/// The first process alone takes the grains, where the run begins with them.
void drive_wheel(const fs::path& folder, bool writes, const dem::WorkOptions& how) {
  const bool takes = writes && !fs::exists(folder / "state");
  const dem::WheelJob job =
      read_by_all([&] { return dem::read_job(folder / "job.h5", takes ? dem::WithGrains::yes : dem::WithGrains::no); });
  const dem::WheelOnBed wheel = job.wheel();
  dem::WheelRunStages<dem::LammpsRun> ride(wheel, job.at,
                                           [&] { return dem::LammpsRun(MPI_COMM_WORLD, job, how, folder); });
  const dem::WheelRun run = ride.run();
  if (writes) dem::write_answer(folder / "answer.txt", run);
}

/// Does a job on all processes, of which the first writes.
int do_job(const fs::path& folder, bool writes, const std::stop_token& stop) {
  const auto fail = [&](const char* kind, const std::exception& error) {
    if (writes) write_file_atomically(folder / "error.txt", fmt::format("{}\n{}\n", kind, error.what()));
    return failed;
  };
  try {
    const dem::WorkOptions how{.threads = 1, .progress = print_progress, .stop = stop, .tell = print_line};
    dem::is_bed_job(folder) ? settle_bed(folder, writes, how) : drive_wheel(folder, writes, how);
    return answered;
  } catch (const dem::Stopped&) {
    return stopped;
  } catch (const dem::RunStopped& error) {
    return fail("stopped", error);
  } catch (const NoSolution& error) {
    return fail("no_solution", error);
  } catch (const InputError& error) {
    return fail("input", error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: mpirun -n RANKS soilbin-lammps FOLDER\n", stderr);
    return failed;
  }
  const StopBySignal stop;
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    const int status = do_job(argv[1], rank == 0, stop.token());
    MPI_Finalize();
    return status;
  } catch (const std::exception& error) {  // of this process alone, say without memory: the others would wait for it
    std::fputs(fmt::format("soilbin-lammps: rank {}: {}\n", rank, error.what()).c_str(), stderr);
    MPI_Abort(MPI_COMM_WORLD, failed);
    return failed;
  }
}
