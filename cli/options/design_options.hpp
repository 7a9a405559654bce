// The options by which every command chooses designs and their number formats.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/sweep/plan.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

/// Of a command for one design.
struct DesignChoice {
  std::string name;
  std::optional<std::string> bits;  ///< as the user wrote it; without: the design's own

  /// Throws as rtl::find_design does.
  [[nodiscard]] const rtl::Design& design() const { return rtl::find_design(name); }
  /// Throws as rtl::find_design and rtl::Design::parse_format do.
  [[nodiscard]] rtl::Format format() const {
    return bits ? design().parse_format(*bits) : design().default_format;
  }
};

/// The design's name (required), --bits.
void add_design_options(CLI::App& command, DesignChoice& choice);

/// Of a command for several designs.
struct DesignsChoice {
  /// Why a design cannot be used, one line; empty when it can.
  using WhyNot = std::string (*)(const rtl::Design&);
  using Formats = std::function<std::vector<rtl::Format>(const rtl::Design&)>;

  std::vector<std::string> names;  ///< none: all that can be used
  std::vector<std::string> bits;   ///< "20/24" for every design that has it, "int_slabs=20/24" for one

  /// Each once. Throws std::runtime_error for a name that is none, and for a design named that cannot be
  /// used. Of all designs those are left out, with a line on standard error.
  [[nodiscard]] std::vector<const rtl::Design*> designs(WhyNot why_not) const;
  /// The formats that the user gave for each, or those of `otherwise` where none was given. Throws
  /// std::runtime_error for a format that no design of these has.
  [[nodiscard]] std::vector<sim::DesignFormats> formats(const std::vector<const rtl::Design*>& designs,
                                                        const Formats& otherwise) const;
};

/// --designs.
CLI::Option* add_designs_option(CLI::App& command, DesignsChoice& choice);
/// --bits; `otherwise` says in the help what is taken without it.
CLI::Option* add_bits_option(CLI::App& command, DesignsChoice& choice, const std::string& otherwise);

}  // namespace hitpipe::cli
