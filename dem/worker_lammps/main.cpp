// soilbin-lammps: makes one run of a wheel with its grains in LAMMPS, on as many processes as mpirun starts.
//
//   mpirun -n 64 soilbin-lammps FOLDER
//
// FOLDER holds job.h5 (dem/rig/wheel_job.hpp), as `soilbin run --engine lammps` writes it. The answer goes to
// answer.txt there; why there is none to error.txt, whose first line says of what kind the error is: input, stopped,
// no_solution or other. Standard output gets 'progress STAGE SHARE SECONDS_LEFT' now and then, and at the end 'cost
// ...'. Exit status: 0 answered, 1 not, 3 stopped by SIGUSR1 (which mpirun hands on), SIGINT or SIGTERM.
#include <fmt/core.h>
#include <mpi.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>

#include "dem/rig/ride.hpp"
#include "dem/worker_lammps/lammps_run.hpp"
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

/// The first process alone takes the grains.
dem::WheelJob read_job(const fs::path& folder, bool first) {
  dem::WheelJob job;
  std::string fault;
  try {
    job = dem::read_job(folder / "job.h5", first ? dem::WithGrains::yes : dem::WithGrains::no);
  } catch (const InputError& error) {
    fault = error.what();
  }
  fault = dem::fault_of_any(MPI_COMM_WORLD, fault);
  if (!fault.empty()) throw InputError(fault);
  return job;
}

/// The same on all processes, but the first writes.
int make_run(const fs::path& folder, bool writes, const std::stop_token& stop) {
  const auto fail = [&](const char* kind, const std::exception& error) {
    if (writes) write_file_atomically(folder / "error.txt", fmt::format("{}\n{}\n", kind, error.what()));
    return failed;
  };
  try {
    const dem::WheelJob job = read_job(folder, writes);
    const dem::WheelOnBed wheel = job.wheel();
    const dem::WorkOptions how{.threads = 1, .progress = print_progress, .stop = stop, .tell = print_line};
    dem::Ride<dem::LammpsRun> ride(wheel, job.at, [&] { return dem::LammpsRun(MPI_COMM_WORLD, job, how, folder); });
    const dem::WheelRun run = ride.run();
    if (writes) dem::write_answer(folder / "answer.txt", run);
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
    fmt::print(stderr, "usage: mpirun -n RANKS soilbin-lammps FOLDER\n");
    return failed;
  }
  const StopBySignal stop;
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    const int status = make_run(argv[1], rank == 0, stop.token());
    MPI_Finalize();
    return status;
  } catch (const std::exception& error) {  // of this process alone, say without memory: the others would wait for it
    fmt::print(stderr, "soilbin-lammps: rank {}: {}\n", rank, error.what());
    MPI_Abort(MPI_COMM_WORLD, failed);
    return failed;
  }
}
