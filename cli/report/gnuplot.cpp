#include "cli/report/gnuplot.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/wait.h>

#include "rtl_gen/emit/scratch_file.hpp"

namespace hitpipe::cli {

std::string gnuplot_string(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("''") : std::string(1, c);
  return word + "'";
}

std::string run_gnuplot(const std::string& command, const std::string& script) {
  const rtl::ScratchFile file;
  std::ofstream(file.path()) << script;
  const std::string call = fmt::format("gnuplot '{}' 2>/dev/null", file.path().string());
  std::FILE* const pipe = popen(call.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error(command + ": cannot start gnuplot");
  std::string printed;
  std::array<char, 1 << 16> buffer{};
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    printed.append(buffer.data(), got);
  const int status = pclose(pipe);
  if (status != 0 || printed.empty()) {
    throw std::runtime_error(fmt::format("{}: gnuplot {}; install the package gnuplot-nox", command,
                                         WEXITSTATUS(status) == 127 ? "was not found" : "failed"));
  }
  return printed;
}

}  // namespace hitpipe::cli
