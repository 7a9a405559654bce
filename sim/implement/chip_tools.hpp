// The programs that put Verilog into a target. They are looked for before anything long begins.
#pragma once

#include <optional>

#include "sim/implement/target.hpp"
#include "sim/tool.hpp"

namespace hitpipe::sim {

/// $variable, or `otherwise` if that is not set. Unlike find_tool() it leaves it to the caller how the
/// program is asked for its version, and takes an answer on standard error. Throws std::runtime_error, one
/// line that names the package, when there is no answer.
[[nodiscard]] Tool find_chip_tool(const char* variable, const std::string& otherwise,
                                  const std::string& package, const std::string& version_option);

struct ChipTools {
  Tool yosys;
  std::optional<Tool> nextpnr;  ///< where the target is placed
  std::optional<Tool> sta;      ///< where it is timed by OpenSTA
};

/// $YOSYS, $NEXTPNR_ICE40, $STA, or the programs of these names. Throws as find_chip_tool() does; also when
/// the Liberty file is not there.
[[nodiscard]] ChipTools find_chip_tools(const Target& target);

}  // namespace hitpipe::sim
