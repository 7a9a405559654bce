#include "host/process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/ending.hpp"
#include "host/talk.hpp"
#include "host/text.hpp"

namespace hitpipe::host {

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(fmt::format("cannot {}: {}", what, reason(errno)));
}

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { shut(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;

  [[nodiscard]] int number() const { return number_; }
  void shut() {
    if (number_ >= 0) close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

struct Pipe {
  Descriptor read;
  Descriptor write;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("make a pipe");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// A file in memory. Unlike a pipe it does not break when a child does not read its input.
Descriptor file_of(const std::string& text) {
  Descriptor file(memfd_create("input", MFD_CLOEXEC));
  if (file.number() < 0) fail("make a file in memory");
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = write(file.number(), text.data() + written, text.size() - written);
    if (count < 0 && errno != EINTR) fail("write a program's input");
    if (count > 0) written += static_cast<std::size_t>(count);
  }
  if (lseek(file.number(), 0, SEEK_SET) != 0) fail("write a program's input");
  return file;
}

/// What the child does before its program starts. It leads a group of its own.
class Actions {
 public:
  Actions() {
    check(posix_spawn_file_actions_init(&actions_));
    check(posix_spawnattr_init(&attributes_));
    check(posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK));
    check(posix_spawnattr_setpgroup(&attributes_, 0));
  }
  ~Actions() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;

  void connect(const Descriptor& from, int to) {
    check(posix_spawn_file_actions_adddup2(&actions_, from.number(), to));
  }
  void enter(const std::filesystem::path& folder) {
    check(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()));
  }
  /// The child blocks the signals that this thread blocked before. Returns errno, or 0.
  int spawn(pid_t& child, std::vector<char*>& words, const HeldSignals& held) {
    check(posix_spawnattr_setsigmask(&attributes_, &held.before()));
    return posix_spawnp(&child, words.front(), &actions_, &attributes_, words.data(), environ);
  }

 private:
  static void check(int error) {
    errno = error;
    if (error != 0) fail("prepare a process");
  }
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// A child that leads a group of its own. Without wait() it is killed with its group. A signal that ends the
/// program ends the group too, since a terminal sends its signals only to the program's own group.
class Child {
 public:
  /// The signals have been held since before it was started.
  Child(const HeldSignals& held, pid_t id) : id_(id), at_ending_(held, {.end_group = id}) {}
  ~Child() {
    if (waited_) return;
    kill_group();
    static_cast<void>(reap());
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Whether it has ended; it still waits to be reaped, so no other process has its number.
  [[nodiscard]] bool ended() const {
    siginfo_t found{};
    return waitid(P_PID, static_cast<id_t>(id_), &found, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           found.si_pid == id_;
  }
  void kill_group() const { kill(-id_, SIGKILL); }
  /// Its status, as of waitpid().
  int wait() {
    const int status = reap();
    waited_ = true;
    return status;
  }

 private:
  [[nodiscard]] int reap() const {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
    return status;
  }

  pid_t id_;
  bool waited_ = false;
  AtEnding at_ending_;
};

using Clock = std::chrono::steady_clock;

/// Reads both pipes as the child fills them, so the child never waits for one while this waits for the other.
/// Ends with the child, although its own children may keep the pipes open. False if that took too long.
bool drain(const Child& child, std::array<std::pair<Pipe*, std::string*>, 2> streams,
           Clock::time_point deadline) {
  for (;;) {
    std::array<pollfd, 2> ready{};
    for (std::size_t i = 0; i < 2; ++i) ready[i] = {streams[i].first->read.number(), POLLIN, 0};
    const bool ended = child.ended();  // all that it wrote is in the pipes
    const bool closed = ready[0].fd < 0 && ready[1].fd < 0;
    if (ended && closed) return true;
    if (!ended && Clock::now() >= deadline) return false;
    // The end of a child wakes nobody when the pipes stay open, or are closed before.
    const int count = poll(ready.data(), ready.size(), ended ? 0 : closed ? 1 : 50);
    if (count < 0 && errno != EINTR) fail("read what a program prints");
    if (count == 0 && ended) return true;
    for (std::size_t i = 0; i < 2 && count > 0; ++i) {
      if (ready[i].revents == 0) continue;
      std::array<char, 1 << 16> buffer;
      const ssize_t got = read(ready[i].fd, buffer.data(), buffer.size());
      if (got > 0) streams[i].second->append(buffer.data(), static_cast<std::size_t>(got));
      if (got == 0 || (got < 0 && errno != EINTR)) streams[i].first->read.shut();
    }
  }
}

}  // namespace

std::string environment(const char* name, const std::string& otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

std::vector<std::string> program_of(const char* variable, const std::string& otherwise) {
  const std::string value = environment(variable, otherwise);
  std::error_code ignored;
  if (value.find('/') != std::string::npos && std::filesystem::exists(value, ignored)) return {value};
  std::vector<std::string> words = words_of(value);
  return words.empty() ? std::vector{otherwise} : words;
}

bool Outcome::not_found() const {
  return start_error == ENOENT;
}

std::string Outcome::failure() const {
  if (not_found()) return "was not found";
  if (start_error != 0) return fmt::format("cannot be started: {}", reason(start_error));
  if (stopped_after.count() != 0)
    return fmt::format("did not end within {:g} s and was stopped",
                       std::chrono::duration<double>(stopped_after).count());
  if (signal != 0) {
    const char* const meaning = sigdescr_np(signal);
    return fmt::format("was ended by signal {} ({})", signal, meaning != nullptr ? meaning : "unknown");
  }
  return fmt::format("failed with exit code {}", exit_code);
}

Outcome run(const std::vector<std::string>& words, const RunOptions& options) {
  const std::filesystem::path& folder = options.folder;
  Actions actions;
  if (!folder.empty()) {
    if (!std::filesystem::is_directory(folder))
      throw std::runtime_error(fmt::format("{}: no such folder", folder.string()));
    actions.enter(folder);
  }
  if (talk() == Talk::verbose) {
    std::string line = "runs";
    for (const std::string& word : words) line.append(" ").append(shell_word(word));
    note_step(folder.empty() ? line : fmt::format("{} in {}", line, folder.string()));
  }
  const Descriptor in = file_of(options.input);
  Pipe out = make_pipe();
  Pipe err = make_pipe();
  actions.connect(in, STDIN_FILENO);
  actions.connect(out.write, STDOUT_FILENO);
  actions.connect(err.write, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  end_by_signals_cleanly();
  Outcome outcome;
  std::optional<Child> started;
  {
    const HeldSignals held;
    pid_t id = 0;
    outcome.start_error = actions.spawn(id, arguments, held);
    if (outcome.start_error != 0) return outcome;
    started.emplace(held, id);
  }
  Child& child = *started;
  out.write.shut();
  err.write.shut();
  if (!drain(child, {{{&out, &outcome.out}, {&err, &outcome.err}}}, Clock::now() + options.time_limit)) {
    outcome.stopped_after = options.time_limit;
    child.kill_group();
  }
  const int status = child.wait();
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  return outcome;
}

}  // namespace hitpipe::host
