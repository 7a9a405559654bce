// The options by which commands choose a core. Most of them are what its features say (rtl_gen/core/feature.hpp).
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/core/core_options.hpp"
#include "rtl_gen/core/feature.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

struct CoreChoice {
  std::optional<std::string> bits;  ///< as the user wrote it; without: those of `options`
  rtl::CoreOptions options{};

  /// With the format that the user wrote. Throws std::runtime_error, one line, when there is no such format.
  [[nodiscard]] rtl::CoreOptions core() const;
};

/// Adds --bits.
void add_core_bits_option(CLI::App& command, std::optional<std::string>& bits, const std::string& otherwise);

/// Numbers above those of an option, which the command takes as something else. `value` is 0 without one.
struct Beyond {
  std::string_view option;
  int most;
  int& value;
  std::string what;  ///< behind the help of the option
};
/// Adds the options of these groups, and returns them.
std::vector<CLI::Option*> add_core_options(CLI::App& command, CoreChoice& choice,
                                           std::initializer_list<rtl::CoreOption::Group> groups,
                                           const std::optional<Beyond>& beyond = {});
/// --memory, as memory_port() reads it.
void add_memory_option(CLI::App& command, std::string& memory);

}  // namespace hitpipe::cli
