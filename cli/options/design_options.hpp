// The options by which commands choose designs and their number formats.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sim/sweep/plan.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

/// The design of a command that takes one.
struct DesignChoice {
  std::string name;
  std::optional<std::string> bits;  ///< as the user wrote it; without: the design's own

  /// Throws what rtl::find_design() throws.
  [[nodiscard]] const rtl::Design& design() const { return rtl::find_design(name); }
  /// Throws what rtl::find_design() and rtl::Design::parse_format() throw.
  [[nodiscard]] Format format() const {
    return bits ? design().parse_format(*bits) : design().default_format;
  }
};

/// Adds the design's name (required) and --bits.
void add_design_options(CLI::App& command, DesignChoice& choice);

/// The designs of a command that takes several.
struct DesignsChoice {
  /// Why a design cannot be used, one line; empty when it can.
  using WhyNot = std::string (*)(const rtl::Design&);
  using Formats = std::function<std::vector<Format>(const rtl::Design&)>;

  std::vector<std::string> names;  ///< empty: all designs that can be used
  std::vector<std::string> bits;   ///< "20/24" for every design that has it, "int_slabs=20/24" for one

  /// For a command that takes one design with one format here. Throws std::runtime_error, one line, if there
  /// are more or none.
  [[nodiscard]] DesignChoice only(const std::string& command) const;
  /// Each design once. Throws std::runtime_error when a name is unknown or a named design cannot be used.
  /// Without names, designs that cannot be used are left out, with a line on standard error.
  [[nodiscard]] std::vector<const rtl::Design*> designs(WhyNot why_not) const;
  /// The formats that the user gave for each design. A design without one gets its formats from
  /// `otherwise`. Throws std::runtime_error for a format that none of these designs has.
  [[nodiscard]] std::vector<sim::DesignFormats> formats(const std::vector<const rtl::Design*>& designs,
                                                        const Formats& otherwise) const;
};

/// Adds the designs' names. `otherwise` tells the help which designs are the default.
CLI::Option* add_designs_option(CLI::App& command, DesignsChoice& choice, const std::string& otherwise);
/// Adds --bits. `otherwise` tells the help which formats are the default.
CLI::Option* add_bits_option(CLI::App& command, DesignsChoice& choice, const std::string& otherwise);

/// --library. `library` holds the default; rtl::library_called() reads it.
void add_library_option(CLI::App& command, std::string& library);
/// --block-luts, as rtl::library_called() takes it.
void add_block_luts_option(CLI::App& command, std::optional<int>& block_luts);

/// Adds --ii, of commands that make a unit. `more` ends its help.
CLI::Option* add_interval_option(CLI::App& command, int& value, const std::string& more = "");

/// The same for a command that compares units of several intervals.
CLI::Option* add_intervals_option(CLI::App& command, std::vector<int>& values, const std::string& what);

/// Adds --flow-control, of commands that make a unit or price one. `more` ends its help.
CLI::Option* add_flow_control_option(CLI::App& command, rtl::FlowControl& value,
                                     const std::string& more = "");

}  // namespace hitpipe::cli
