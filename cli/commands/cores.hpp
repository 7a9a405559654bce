// What the commands `rtl`, `area` and `implement` do with a core in place of a design.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/implement/unit_implementation.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace hitpipe::cli {

/// The name by which commands know the core.
inline constexpr const char* core_name = "core";

struct CoreRtl {
  std::string out;
  std::string library;
  std::string module;  ///< empty: that of the core's options
  int cycles;          ///< of the testbench
  std::uint64_t seed;
  OutputFormat format;
};
/// Writes the files of a core and says which. Throws as rtl::make_core() and host::write_files() do.
void emit_core(const rtl::CoreOptions& core, const CoreRtl& options);

/// Prints what each part of a core takes, and all of them. Bits of memories are apart. Throws as
/// rtl::make_core() and area::price() do.
void print_core_price(const rtl::CoreOptions& core, const std::string& library, OutputFormat format);

/// Maps a core to a target and prints what it takes; bits of memories are apart. Returns the exit code.
/// Throws as sim::target_called() and sim::implement_core() do.
int map_core(const rtl::CoreOptions& core, const std::string& target, const sim::ImplementOptions& options,
             OutputFormat format);

/// Throws std::runtime_error, one line, when one of the options of a core was given. For a command that was
/// not given a core.
void refuse_core_options(const CLI::App& command, const std::vector<std::string>& names);

}  // namespace hitpipe::cli
