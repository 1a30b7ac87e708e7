#include "cli/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <pthread.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <utility>

namespace soilbin::cli {
namespace {

/// Where a guarded stream writes to.
struct Sink {
  int descriptor;
  bool may_fail;      ///< what can't be written is dropped
  bool half = false;  ///< the last byte was the first of a character of two that may be a control character
};
Sink output{STDOUT_FILENO, false}, errors{STDERR_FILENO, true};

constexpr unsigned char lead_of_controls = 0xC2;  // U+0080 .. U+009F are this and a byte below 0xA0

std::string visible(Sink& sink, std::string_view text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool second = std::exchange(sink.half, false), high_control = second && byte >= 0x80 && byte < 0xA0;
    if (second && !high_control) shown += static_cast<char>(lead_of_controls);
    if (byte == lead_of_controls)
      sink.half = true;
    else if (high_control || (byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7F)
      shown += fmt::format("\\u{:04x}", static_cast<unsigned>(byte));
    else
      shown += c;
  }
  return shown;
}

/// Whether all was written; errno says why not.
bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Writes without complaint: a reader that is gone sends no signal either.
void write_or_drop(int descriptor, std::string_view text) {
  sigset_t pipe, before, waiting;
  sigemptyset(&pipe), sigaddset(&pipe, SIGPIPE);
  sigpending(&waiting);
  pthread_sigmask(SIG_BLOCK, &pipe, &before);
  if (!write_all(descriptor, text) && errno == EPIPE && sigismember(&waiting, SIGPIPE) == 0) {
    const timespec now{};
    sigtimedwait(&pipe, nullptr, &now);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ssize_t write_to(void* cookie, const char* text, std::size_t size) {
  Sink& sink = *static_cast<Sink*>(cookie);
  const std::string shown = visible(sink, {text, size});
  if (!sink.may_fail) return write_all(sink.descriptor, shown) ? static_cast<ssize_t>(size) : 0;
  write_or_drop(sink.descriptor, shown);
  return static_cast<ssize_t>(size);
}

std::FILE* guarded(std::FILE* stream, Sink& sink, int buffering) {
  std::FILE* guard = ::fopencookie(&sink, "w", {nullptr, write_to, nullptr, nullptr});
  if (guard == nullptr) return stream;
  std::setvbuf(guard, nullptr, buffering, BUFSIZ);
  return guard;
}

}  // namespace

void guard_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) == -1)
      ::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);  // the lowest that is free: this one
  stdout = guarded(stdout, output, ::isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF);
  stderr = guarded(stderr, errors, _IONBF);
}

void rewrite_line(const std::string& text) {
  Sink whole = errors;
  write_or_drop(STDERR_FILENO, "\r\033[K" + visible(whole, text));
}

}  // namespace soilbin::cli
