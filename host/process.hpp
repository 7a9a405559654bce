// Other programs: which the user chooses by environment variables, and how they run as child processes.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace hitpipe::host {

/// The variable's value. `otherwise` if it is not set or empty.
[[nodiscard]] std::string environment(const char* name, const std::string& otherwise);

/// The program that the variable names and the arguments after it, for example "env g++". `otherwise` if it
/// names none. A value that is the path of a file is one word, even with blanks.
[[nodiscard]] std::vector<std::string> program_of(const char* variable, const std::string& otherwise);

struct Outcome {
  int start_error = 0;  ///< errno if the program could not be started
  int signal = 0;       ///< the signal that ended the program, or 0
  int exit_code = 0;
  std::chrono::milliseconds stopped_after{0};  ///< the time limit, if it did not end before
  std::string out;                             ///< what it wrote to standard output
  std::string err;                             ///< what it wrote to standard error

  [[nodiscard]] bool not_found() const;
  [[nodiscard]] bool succeeded() const { return start_error == 0 && signal == 0 && exit_code == 0; }
  /// The outcome in words that follow the program's name, for example "failed with exit code 1".
  [[nodiscard]] std::string failure() const;
};

/// Enough for a program that works, such as place and route: a limit only for programs that hang.
inline constexpr std::chrono::hours working_time{2};
/// Enough for a program that only answers, such as its version, or draws, on a machine that is busy too.
inline constexpr std::chrono::minutes answering_time{5};

struct RunOptions {
  std::filesystem::path folder = {};  ///< the child's folder; empty: the current one
  std::string input = {};             ///< the whole of standard input
  std::chrono::milliseconds time_limit = working_time;
};

/// Runs a program to its end, without a shell, so every byte of an argument reaches the program. `words` are
/// its name and its arguments. A name without a slash is looked up in $PATH. What the program itself has
/// started may go on after its end. After the time limit all of them are killed; so they are, by the same
/// signal, when SIGINT, SIGTERM or SIGHUP ends this program. Throws std::runtime_error, one line, when the
/// folder does not exist or the system has no pipes left.
[[nodiscard]] Outcome run(const std::vector<std::string>& words, const RunOptions& options = {});

}  // namespace hitpipe::host
