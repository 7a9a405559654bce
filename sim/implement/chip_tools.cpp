#include "sim/implement/chip_tools.hpp"

#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::sim {

ChipTools find_chip_tools(const Target& target) {
  ChipTools tools{.yosys = find_tool("YOSYS", "yosys", "yosys", "-V"), .nextpnr = {}, .sta = {}};
  if (target.placement) tools.nextpnr = find_tool("NEXTPNR_ICE40", "nextpnr-ice40", "nextpnr-ice40");
  if (!target.liberty.empty()) {
    tools.sta = find_tool("STA", "sta", "opensta", "-version");
    if (!std::filesystem::exists(target.liberty))
      throw std::runtime_error(
          fmt::format("{}: is not there; install the package {}", target.liberty, target.package));
  }
  return tools;
}

}  // namespace hitpipe::sim
