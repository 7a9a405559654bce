// What the commands `rtl`, `area` and `list` do with a machine in place of a design.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace hitpipe::cli {

struct MachineRtl {
  std::string out;
  std::string library;
  std::string module;  ///< empty: the machine's own name
  int cycles;          ///< of the testbench
  std::uint64_t seed;
  OutputFormat format;
};
/// Writes the files of a machine and says which. `bits` as the user wrote it; without: its own format. Throws
/// as rtl::machine_files() and host::write_files() do.
void emit_machine(const rtl::Machine& machine, const std::optional<std::string>& bits,
                  const MachineRtl& options);

/// Prices of machines, at one format each. Throws std::runtime_error, one line, for a format that one of them
/// does not have.
void print_machine_prices(const std::vector<const rtl::Machine*>& machines,
                          const std::optional<std::string>& bits, const std::string& library,
                          OutputFormat format);

[[nodiscard]] std::string machines_text(OutputFormat format);

/// For a command whose names may be machines: its help says where they are listed. Puts these options under a
/// heading of their own: a unit has them, a machine has not.
void of_units(CLI::App& command, const std::vector<std::string>& names);
/// Whether of_units() was called.
[[nodiscard]] bool takes_machines(const CLI::App& command);
/// Throws std::runtime_error, one line, when one of them was given for a machine.
void refuse_of_units(const CLI::App& command, const rtl::Machine& machine);

}  // namespace hitpipe::cli
