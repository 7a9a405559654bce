#include "sim/programs.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/wait.h>

namespace hitpipe::sim {

std::string shell_word(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string output_of(const std::string& command) {
  std::string text;
  if (std::FILE* const pipe = popen(command.c_str(), "r")) {
    std::array<char, 4096> buffer{};
    while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
      text.append(buffer.data(), got);
    if (pclose(pipe) != 0) text.clear();
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string environment(const char* name, const std::string& otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

Tool find_tool(const char* variable, const std::string& otherwise, std::string_view package) {
  Tool tool{environment(variable, otherwise), ""};
  if (tool.program.find('/') != std::string::npos)
    tool.program = std::filesystem::absolute(tool.program).string();
  tool.version = output_of(shell_word(tool.program) + " --version 2>/dev/null");
  if (tool.version.empty())
    throw std::runtime_error(fmt::format("{}: cannot be run; install the package {} or set {} to the program",
                                         tool.program, package, variable));
  return tool;
}

}  // namespace hitpipe::sim
