// The options by which every command that needs a design chooses it and its number format.
#pragma once

#include <optional>
#include <string>

#include "rtl_gen/catalogue/design.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

struct DesignChoice {
  std::string name;
  std::optional<std::string> bits;  ///< as the user wrote it; without: the design's own

  /// Throws as rtl::find_design does.
  [[nodiscard]] const rtl::Design& design() const { return rtl::find_design(name); }
  /// Throws as rtl::find_design and rtl::Design::parse_format do.
  [[nodiscard]] rtl::Format format() const {
    return bits ? design().parse_format(*bits) : design().default_format();
  }
};

/// The design's name (required), --bits.
void add_design_options(CLI::App& command, DesignChoice& choice);

}  // namespace hitpipe::cli
