// Runs other programs: Verilog tools that must accept what hitpipe writes.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/files.hpp"
#include "host/process.hpp"
#include "tests/rtl_gen/text.hpp"

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

/// The program, which is in a package of its name, succeeds and prints nothing.
inline void expect_silence(const std::filesystem::path& folder, const std::string& program,
                           const std::string& arguments) {
  const ToolResult result = run_tool(folder, program, program, arguments);
  EXPECT_EQ(result.status, 0) << program << ' ' << arguments;
  EXPECT_EQ(result.output, "") << program << ' ' << arguments;
}

/// Verilator, Yosys and Icarus read the files of many units, a list for each with the top module's first, and
/// find nothing to say. Each file has the name of its module. A tool starts once, for that takes longer than
/// a unit. `checks` are further commands of Yosys for each unit, `define` is an option of all
/// three.
inline void expect_silent_tools(const std::filesystem::path& folder,
                                const std::vector<std::vector<std::string>>& units,
                                const std::string& checks = "", const std::string& define = "") {
  std::string all;
  std::string script;
  for (const std::vector<std::string>& modules : units) {
    script += "design -reset; read_verilog " + define;
    for (const std::string& module : modules) {
      all += " " + module + ".v";
      script += " " + module + ".v";
    }
    script += "; hierarchy -check -top " + modules.front() + "; proc; check -assert" + checks + "\n";
  }
  std::ofstream(folder / "lint.ys") << script;
  expect_silence(folder, "verilator", "--lint-only -Wall -Wno-MULTITOP " + define + all);
  expect_silence(folder, "yosys", "-q lint.ys");
  expect_silence(folder, "iverilog", "-g2001 -Wall -o lint.vvp " + define + all);
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  host::write_file(file, text);
}

inline std::string read_text(const std::filesystem::path& file) {
  return host::read_file(file);
}

/// Writes the file again with `bad` in place of the first `good`.
inline void damage(const std::filesystem::path& file, std::string_view good, std::string_view bad) {
  host::write_file(file, replaced(host::read_file(file), good, bad));
}

}  // namespace hitpipe::rtl
