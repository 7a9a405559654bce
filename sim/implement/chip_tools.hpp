// The programs that put Verilog into a target. They are looked for before anything long begins.
#pragma once

#include <optional>

#include "sim/implement/target.hpp"
#include "sim/model/tool.hpp"

namespace hitpipe::sim {

struct ChipTools {
  Tool yosys;
  std::optional<Tool> nextpnr;  ///< where the target is placed
  std::optional<Tool> sta;      ///< where it is timed by OpenSTA
};

/// $YOSYS, $NEXTPNR_ICE40, $STA, or the programs of these names. Throws as find_tool() does; also when the
/// Liberty file is not there.
[[nodiscard]] ChipTools find_chip_tools(const Target& target);

}  // namespace hitpipe::sim
