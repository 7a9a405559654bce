#include "host/ending.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <ctime>
#include <mutex>
#include <string_view>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hitpipe::host {

namespace {

constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

/// A thread counts itself and then looks whether the program is ending; a signal says that it is and then
/// waits until nobody is counted. So one of them sees the other.
std::atomic<int> holders = 0;
std::atomic<bool> ending = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

struct Registry {
  std::mutex mutex;
  std::list<AtEnding::Entry> entries;
};

/// Never destroyed, since a signal can come at any time.
Registry& registry() {
  static auto* const all = new Registry;
  return *all;
}

// The functions below run in a signal handler. They call only what is async-signal-safe, and system calls.

void sleep_a_millisecond() {
  const timespec millisecond{0, 1'000'000};
  nanosleep(&millisecond, nullptr);
}

[[noreturn]] void wait_for_the_end() {
  for (;;) pause();
}

/// A group that does not obey the signal is killed after a second.
void end_group(pid_t leader, int number) {
  kill(-leader, number);
  for (int waited_ms = 0;; ++waited_ms) {
    siginfo_t found{};
    const bool is_child = waitid(P_PID, static_cast<id_t>(leader), &found, WEXITED | WNOHANG | WNOWAIT) == 0;
    if (!is_child || found.si_pid == leader) return;
    if (waited_ms == 1000) kill(-leader, SIGKILL);
    sleep_a_millisecond();
  }
}

void remove_all(int parent, const char* name);

/// All that is in the folder.
void empty(int folder) {
  // As the system writes it.
  struct Buffer {
    alignas(dirent64) std::array<char, 4096> bytes;
  } buffer{};
  for (;;) {
    const ssize_t got = getdents64(folder, buffer.bytes.data(), buffer.bytes.size());
    if (got <= 0) return;
    for (ssize_t at = 0; at < got;) {
      const auto* const entry = reinterpret_cast<const dirent64*>(buffer.bytes.data() + at);
      at += entry->d_reclen;
      const std::string_view name = entry->d_name;
      if (name != "." && name != "..") remove_all(folder, entry->d_name);
    }
  }
}

void remove_all(int parent, const char* name) {
  if (unlinkat(parent, name, 0) == 0 || errno == ENOENT) return;
  constexpr int most_passes = 10;  // entries may be overlooked while others are removed, or come anew
  for (int pass = 0; pass < most_passes; ++pass) {
    const int folder = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    empty(folder);
    close(folder);
    if (unlinkat(parent, name, AT_REMOVEDIR) == 0) return;
  }
}

void end_cleanly(int number) {
  if (ending.exchange(true)) wait_for_the_end();  // another thread does it
  while (holders != 0) sleep_a_millisecond();
  const pid_t self = getpid();
  const std::list<AtEnding::Entry>& entries = registry().entries;
  for (const auto& [owner, act] : entries)
    if (owner == self && act.end_group != 0) end_group(act.end_group, number);
  for (const auto& [owner, act] : entries)
    if (owner == self && !act.remove.empty()) remove_all(AT_FDCWD, act.remove.c_str());
  for (const auto& [owner, act] : entries)
    if (owner == self && !act.say.empty())
      static_cast<void>(write(STDERR_FILENO, act.say.data(), act.say.size()) < 0);
  static_cast<void>(raise(number));  // comes when this returns, and now ends the program
}

}  // namespace

void end_by_signals_cleanly() {
  static std::once_flag once;
  std::call_once(once, [] {
    static_cast<void>(registry());
    for (const int number : signals) {
      struct sigaction action {};
      if (sigaction(number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
      action.sa_handler = end_cleanly;
      action.sa_flags = static_cast<int>(SA_RESETHAND);
      for (const int other : signals) sigaddset(&action.sa_mask, other);
      sigaction(number, &action, nullptr);
    }
  });
}

HeldSignals::HeldSignals() {
  sigset_t held;
  sigemptyset(&held);
  for (const int number : signals) sigaddset(&held, number);
  pthread_sigmask(SIG_BLOCK, &held, &before_);
  ++holders;
  if (!ending) return;
  --holders;
  wait_for_the_end();
}

HeldSignals::~HeldSignals() {
  --holders;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

AtEnding::AtEnding(const HeldSignals& /*held*/, Act act) {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  entry_ = all.entries.insert(all.entries.end(), {getpid(), std::move(act)});
}

AtEnding::~AtEnding() {
  const HeldSignals held;
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  all.entries.erase(entry_);
}

}  // namespace hitpipe::host
