// Runs other programs: Verilog tools that must accept what hitpipe writes.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/files.hpp"
#include "host/process.hpp"

namespace hitpipe::rtl {

struct ToolResult {
  int status = 0;
  std::string output;  ///< standard output and error
};

/// Runs a program in a folder. A shell reads `arguments`. Throws when the program does not exist, and names
/// the `package` to install.
inline ToolResult run_tool(const std::filesystem::path& folder, const std::string& package,
                           const std::string& program, const std::string& arguments) {
  const host::Outcome ended =
      host::run({"sh", "-c", "{ " + program + " " + arguments + "; } 2>&1"}, {.folder = folder});
  if (ended.exit_code == 127)
    throw std::runtime_error(program + " was not found; install the package " + package);
  return {ended.signal == 0 ? ended.exit_code : 128, ended.out};
}

using host::ScratchFolder;

/// Verilator, Yosys and Icarus read the files of many units, a list for each with the top module's first, and
/// find nothing to say. Each file has the name of its module. A tool starts once, for that takes longer than
/// a unit. `checks` are further commands of Yosys for each unit.
inline void expect_silent_tools(const std::filesystem::path& folder,
                                const std::vector<std::vector<std::string>>& units,
                                const std::string& checks = "") {
  std::string all;
  std::string script;
  for (const std::vector<std::string>& modules : units) {
    script += "design -reset; read_verilog";
    for (const std::string& module : modules) {
      all += " " + module + ".v";
      script += " " + module + ".v";
    }
    script += "; hierarchy -check -top " + modules.front() + "; proc; check -assert" + checks + "\n";
  }
  std::ofstream(folder / "lint.ys") << script;
  const auto expect_silence = [&](const std::string& program, const std::string& arguments) {
    const ToolResult result = run_tool(folder, program, program, arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.output, "");
  };
  expect_silence("verilator", "--lint-only -Wall -Wno-MULTITOP" + all);
  expect_silence("yosys", "-q lint.ys");
  expect_silence("iverilog", "-g2001 -Wall -o lint.vvp" + all);
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot write the file");
}

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot read the file");
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace hitpipe::rtl
