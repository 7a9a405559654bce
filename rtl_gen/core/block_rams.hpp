// Which memories of a core go to block RAMs of 16 bits, as iCE40 has them. Yosys leaves a memory of a few
// words to registers there, and a core for a small chip has more of these than the chip.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// Names of memories by part, in at most so many block RAMs: those first that fill a block RAM best. Lookup
/// memories are left out, since a block RAM gives its word a cycle later.
[[nodiscard]] std::map<std::string_view, std::set<std::string>> in_block_rams(const Core& core, int most);

}  // namespace hitpipe::rtl
