// What the command `rtl` does with a core in place of a design.
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

}  // namespace hitpipe::cli
