#include "sim/implement/chip_tools.hpp"

#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "host/environment.hpp"

namespace hitpipe::sim {

Tool find_chip_tool(const char* variable, const std::string& otherwise, const std::string& package,
                    const std::string& version_option) {
  Tool tool{host::program_of(variable, otherwise), ""};
  std::string& program = tool.words.front();
  if (program.find('/') != std::string::npos) program = std::filesystem::absolute(program).string();
  const host::Outcome asked = tool.run({version_option});
  const std::string& said = asked.out.empty() ? asked.err : asked.out;
  if (asked.succeeded()) tool.version = said.substr(0, said.find('\n'));
  if (tool.version.empty())
    throw std::runtime_error(fmt::format("{}: cannot be run; install the package {} or set {} to the program",
                                         tool.name(), package, variable));
  return tool;
}

ChipTools find_chip_tools(const Target& target) {
  ChipTools tools{.yosys = find_chip_tool("YOSYS", "yosys", "yosys", "-V"), .nextpnr = {}, .sta = {}};
  if (target.placement)
    tools.nextpnr = find_chip_tool("NEXTPNR_ICE40", "nextpnr-ice40", "nextpnr-ice40", "--version");
  if (!target.liberty.empty()) {
    tools.sta = find_chip_tool("STA", "sta", "opensta", "-version");
    if (!std::filesystem::exists(target.liberty))
      throw std::runtime_error(
          fmt::format("{}: is not there; install the package {}", target.liberty, target.package));
  }
  return tools;
}

}  // namespace hitpipe::sim
