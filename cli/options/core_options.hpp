// The options by which commands choose a core.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/core/core.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace hitpipe::cli {

struct CoreChoice {
  int places = 8;  ///< of a ray's stack
  rtl::CoreOptions options{};

  /// With the stack's places, and in the format that the user wrote. Throws std::runtime_error, one line,
  /// when they are no power of two, or when there is no such format.
  [[nodiscard]] rtl::CoreOptions core(const std::optional<std::string>& bits) const;
};

/// Options that every command with a core has. Gives their names.
std::vector<std::string> add_core_options(CLI::App& command, CoreChoice& choice);
/// What only Verilog that is written needs to know: rays in flight, and widths of ports.
std::vector<std::string> add_core_port_options(CLI::App& command, CoreChoice& choice);

}  // namespace hitpipe::cli
