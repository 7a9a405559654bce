// A library that stands before the system's in a program (LD_PRELOAD) and kills it at a call that changes
// files. HITPIPE_KILL_AT_CALL is the number of the call, from 1. Of a write half is written. No time decides
// where the program ends.
#include <atomic>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

std::atomic<long> calls_left = 0;

/// Programs that this one starts live.
[[gnu::constructor]] void read_the_number() {
  if (const char* const number = std::getenv("HITPIPE_KILL_AT_CALL")) calls_left = std::atol(number);
  unsetenv("LD_PRELOAD");
}

/// Whether this is the call.
bool is_last() {
  return --calls_left == 0;
}

void end() {
  kill(getpid(), SIGKILL);
}

template <typename Function>
Function* systems(Function* /*own*/, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  if ((flags & O_CREAT) != 0 && is_last()) end();
  static const auto real = systems(&open, "open");
  return real(path, flags, mode);
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (is_last()) end();
  static const auto real = systems(&mkdir, "mkdir");
  return real(path, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static const auto real = systems(&write, "write");
  if (descriptor > STDERR_FILENO && is_last()) {
    static_cast<void>(real(descriptor, bytes, count / 2) < 0);
    end();
  }
  return real(descriptor, bytes, count);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  static const auto real = systems(&fwrite, "fwrite");
  if (file != stdout && file != stderr && is_last()) {
    static_cast<void>(real(bytes, size, count / 2, file));
    std::fflush(file);
    end();
  }
  return real(bytes, size, count, file);
}

int fsync(int descriptor) {
  if (is_last()) end();
  static const auto real = systems(&fsync, "fsync");
  return real(descriptor);
}

int rename(const char* from, const char* to) noexcept {
  if (is_last()) end();
  static const auto real = systems(&rename, "rename");
  return real(from, to);
}
}
