// The options by which every command that needs a design chooses it and its number format.
#pragma once

#include <string>

#include "rtl_gen/catalogue/design.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

struct DesignChoice {
  std::string name;
  std::string format = "20/24";

  /// Throws as rtl::find_design does.
  [[nodiscard]] const rtl::Design& design() const { return rtl::find_design(name); }
  /// Throws as rtl::parse_bits does.
  [[nodiscard]] hls::IntBits bits() const { return rtl::parse_bits(format); }
};

/// The design's name (required), --bits.
void add_design_options(CLI::App& command, DesignChoice& choice);

}  // namespace hitpipe::cli
