// The options that say by what units are priced: the component library, and the cost of a triangle test.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "sim/sweep/sweep.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

struct CostChoice {
  std::string library = std::string(rtl::default_library);
  std::optional<double> triangle_ns;
  std::optional<double> triangle_mm2;
  std::optional<double> triangle_luts;
  bool tests_only = false;  ///< the whole cost leaves out set-up, and energy is not estimated

  /// Throws what rtl::library_called() throws.
  [[nodiscard]] rtl::Library load() const { return rtl::library_called(library); }
  /// What the user does not give comes from sim::triangle_cost(), which throws for some libraries.
  [[nodiscard]] sim::TriangleCost triangle(const rtl::Library& priced_by) const;
  [[nodiscard]] bool says_triangle() const { return triangle_ns || triangle_mm2 || triangle_luts; }
};

/// The designs that the library can price, at their default formats. Throws std::runtime_error, one line,
/// for another when the user `named` them; else it is left out, with a line on standard error.
[[nodiscard]] std::vector<const rtl::Design*> priced_by(const rtl::Library& library,
                                                        std::vector<const rtl::Design*> designs, bool named);

/// Adds --triangle-ns and --triangle-mm2.
void add_triangle_options(CLI::App& command, CostChoice& choice);
/// Adds these, --library and --triangle-luts.
void add_cost_options(CLI::App& command, CostChoice& choice);

}  // namespace hitpipe::cli
