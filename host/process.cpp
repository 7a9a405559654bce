#include "host/process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
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

/// What the child does before its program starts.
class Actions {
 public:
  Actions() { check(posix_spawn_file_actions_init(&actions_)); }
  ~Actions() { posix_spawn_file_actions_destroy(&actions_); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;

  void connect(const Descriptor& from, int to) {
    check(posix_spawn_file_actions_adddup2(&actions_, from.number(), to));
  }
  void enter(const std::filesystem::path& folder) {
    check(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()));
  }
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  static void check(int error) {
    errno = error;
    if (error != 0) fail("prepare a process");
  }
  posix_spawn_file_actions_t actions_{};
};

/// Reads both pipes as the child fills them, so the child never waits for one while this waits for the other.
void drain(std::array<std::pair<Pipe*, std::string*>, 2> streams) {
  for (;;) {
    std::array<pollfd, 2> ready{};
    for (std::size_t i = 0; i < 2; ++i) ready[i] = {streams[i].first->read.number(), POLLIN, 0};
    if (ready[0].fd < 0 && ready[1].fd < 0) return;
    if (poll(ready.data(), ready.size(), -1) < 0 && errno != EINTR) fail("read what a program prints");
    for (std::size_t i = 0; i < 2; ++i) {
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
  if (signal != 0) return fmt::format("was ended by signal {} ({})", signal, strsignal(signal));
  return fmt::format("failed with exit code {}", exit_code);
}

Outcome run(const std::vector<std::string>& words, const Surroundings& surroundings) {
  const std::filesystem::path& folder = surroundings.folder;
  Actions actions;
  if (!folder.empty()) {
    if (!std::filesystem::is_directory(folder))
      throw std::runtime_error(fmt::format("{}: no such folder", folder.string()));
    actions.enter(folder);
  }
  const Descriptor in = file_of(surroundings.input);
  Pipe out = make_pipe();
  Pipe err = make_pipe();
  actions.connect(in, STDIN_FILENO);
  actions.connect(out.write, STDOUT_FILENO);
  actions.connect(err.write, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  Outcome outcome;
  pid_t child = 0;
  outcome.start_error =
      posix_spawnp(&child, arguments.front(), actions.get(), nullptr, arguments.data(), environ);
  if (outcome.start_error != 0) return outcome;
  out.write.shut();
  err.write.shut();
  drain({{{&out, &outcome.out}, {&err, &outcome.err}}});
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail("wait for a program");
  }
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  return outcome;
}

}  // namespace hitpipe::host
