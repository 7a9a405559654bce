// The options by which commands choose a core.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/core/core.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

struct CoreChoice {
  std::optional<std::string> bits;  ///< as the user wrote it; without: those of `options`
  int places = 8;                   ///< of a ray's stack
  int cache_kib = 0;                ///< 0: no cache
  rtl::CoreOptions options{};

  /// With the stack's places and the format that the user wrote. Throws std::runtime_error, one line, when
  /// the places are no power of two, or when there is no such format.
  [[nodiscard]] rtl::CoreOptions core() const;
  /// A cache that is too large for a core is a model in front of memory.
  [[nodiscard]] bool has_model() const { return cache_kib > rtl::CoreOptions::most_cache_kib; }
};

/// Adds --bits.
void add_core_bits_option(CLI::App& command, std::optional<std::string>& bits, const std::string& otherwise);

// Each of these adds options and returns them.

/// --stack, --levels, --triangle-ii, --door, --dma, --barycentrics and --questions.
std::vector<CLI::Option*> add_core_options(CLI::App& command, CoreChoice& choice);
/// These and --rays, for a command with one core.
std::vector<CLI::Option*> add_one_core_options(CLI::App& command, CoreChoice& choice);
/// The AXI bus to memory: --data-bits and --in-order.
std::vector<CLI::Option*> add_core_bus_options(CLI::App& command, CoreChoice& choice);
/// --cache, --cache-line and --cache-ways.
std::vector<CLI::Option*> add_core_cache_options(CLI::App& command, CoreChoice& choice,
                                                 int most_kib = rtl::CoreOptions::most_cache_kib);
/// --memory, as memory_port() reads it.
void add_memory_option(CLI::App& command, std::string& memory);
/// Widths of ports and block RAMs, which only Verilog that is written needs to know.
std::vector<CLI::Option*> add_core_port_options(CLI::App& command, CoreChoice& choice);
/// What a core has fewer bits for than an image: --number-bits, --leaf-bits and --step-bits.
std::vector<CLI::Option*> add_core_limit_options(CLI::App& command, CoreChoice& choice);

}  // namespace hitpipe::cli
