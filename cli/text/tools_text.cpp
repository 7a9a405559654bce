#include "cli/text/tools_text.hpp"

#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "host/process.hpp"
#include "sim/model/tool.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

/// The file that is started for that name. Empty: there is none.
std::string path_of(const std::string& program) {
  const auto starts = [](const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
  };
  if (program.find('/') != std::string::npos) return starts(program) ? program : "";
  std::istringstream folders(host::environment("PATH", ""));
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::path file = fs::path(folder) / program; starts(file)) return file.string();
  return "";
}

std::string line_of(const char* name, const char* variable, const char* program, const char* option) {
  std::vector<std::string> words = host::program_of(variable, program);
  words.front() = path_of(words.front());
  if (words.front().empty()) return fmt::format("{}: not found\n", name);
  sim::Tool tool{words, ""};
  try {
    tool.version = sim::find_tool(variable, program, "", option).version;
  } catch (const std::runtime_error&) {
    tool.version = "which does not say its version";
  }
  return fmt::format("{}: {}, {}\n", name, tool.name(), tool.release());
}

}  // namespace

std::string tools_text() {
  return line_of("Verilator", "VERILATOR", "verilator", "--version") +
         line_of("Yosys", "YOSYS", "yosys", "-V") + line_of("Icarus", "IVERILOG", "iverilog", "-V");
}

}  // namespace hitpipe::cli
