// Testbench and harness of a core, built and run by the Makefile that stands beside them.
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::sim {

/// Makes a target in the folder of a core. The C++ compiler optimises only what runs in each cycle, by `fast`: a core
/// of one multiplier takes many cycles. Verilator's own code is compiled once for all tests.
inline rtl::ToolResult run_make(const std::filesystem::path& folder, const std::string& target,
                                const std::string& fast = "-O1") {
  return rtl::run_tool(folder, "make", "make",
                       fmt::format("-s -C tb {} OPT_FAST={} OPT_SLOW=-O0 OPT_GLOBAL=-O2 VM_PARALLEL_BUILDS=0 "
                                   "OBJCACHE='sh " HITPIPE_SOURCE "/tests/rtl_gen/emit/kept_object.sh'",
                                   target, fast));
}

}  // namespace hitpipe::sim
