#include "cli/progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>

#include "cli/standard_streams.hpp"
#include "scenario/file_lock.hpp"

namespace soilbin::cli {
namespace {

volatile std::sig_atomic_t stop_asked = 0;
long long asked_at = 0;  // [ms], of the first signal; touched by the handler alone

long long now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);  // may be called from a handler
  return 1000LL * now.tv_sec + now.tv_nsec / 1'000'000;
}

/// The first signal asks for a clean stop; another one a second later ends at once. Sooner it is the same one again, as
/// `timeout` sends it: to the command, and to its group.
void remember(int signal) {
  if (stop_asked == 0) {
    stop_asked = 1;
    asked_at = now_ms();
  } else if (now_ms() - asked_at > 1000) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

using Clock = std::chrono::steady_clock;

/// Where nobody sees a line change: the first word ten seconds after the work began, then one a minute.
bool a_word_is_due() {
  constexpr std::chrono::seconds first{10}, every{60};
  static Clock::time_point due = Clock::now() + first;
  const Clock::time_point now = Clock::now();
  if (now < due) return false;
  due = now + every;
  return true;
}

/// Called ten times a second while a lock is waited for.
void look_up_from_waiting(const std::filesystem::path& place) {
  if (stop_asked) throw Interrupted();
  static std::filesystem::path reported;
  if (reported == place) return;
  reported = place;
  fmt::print(stderr, "waiting: another process is writing in {}\n",
             std::filesystem::absolute(place).lexically_normal().string());
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that gets too large is told like a full disk
  set_while_waiting(look_up_from_waiting);
}

bool interrupt_asked() { return stop_asked != 0; }

void show_progress_line(const std::string& text) {
  if (isatty(STDERR_FILENO) == 1) {
    rewrite_line(text);
  } else if (!text.empty() && a_word_is_due()) {
    fmt::print(stderr, "{}\n", text);
  }
}

void clear_progress_line() { show_progress_line(""); }

compare::Progress shown_progress() {
  return [start = Clock::now(), shown = Clock::now(), open = false](std::size_t done, std::size_t total) mutable {
    if (stop_asked) throw Interrupted();
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - start).count();
    const bool last = done == total;
    if (passed < 0.5 || (!last && now - shown < std::chrono::milliseconds(100))) return;
    shown = now;
    if (last) {
      if (open) clear_progress_line();
      return;
    }
    open = true;
    const double left = passed * static_cast<double>(total - done) / static_cast<double>(done);
    show_progress_line(fmt::format("{:3.0f} %  {} of {}, {:.0f} s left",
                                   100.0 * static_cast<double>(done) / static_cast<double>(total), done, total, left));
  };
}

std::function<void(double time, double duration)> shown_progress_in_time() {
  constexpr double parts = 1000.0;
  return [shown = shown_progress()](double time, double duration) {
    shown(static_cast<std::size_t>(std::max(1.0, parts * time / duration)), static_cast<std::size_t>(parts));
  };
}

}  // namespace soilbin::cli
