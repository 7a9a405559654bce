// What the commands `rtl` and `area` do with a core in place of a design.
#pragma once

#include <cstdint>
#include <string>

#include "cli/text/table.hpp"
#include "rtl_gen/core/core.hpp"

namespace hitpipe::cli {

/// The name by which commands know the core.
inline constexpr const char* core_name = "core";

struct CoreRtl {
  std::string out;
  std::string library;
  std::string module;  ///< empty: "core"
  int cycles;          ///< of the testbench
  std::uint64_t seed;
  OutputFormat format;
};
/// Writes the files of a core and says which. Throws as rtl::make_core() and host::write_files() do.
void emit_core(const rtl::CoreOptions& core, const CoreRtl& options);

/// Prints what each part of a core takes, and all of them. Bits of memories are apart. Throws as
/// rtl::make_core() and area::price() do.
void print_core_price(const rtl::CoreOptions& core, const std::string& library, OutputFormat format);

}  // namespace hitpipe::cli
