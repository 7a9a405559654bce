// The options that say by what units are priced: the component library, and the cost of a triangle test.
#pragma once

#include <optional>
#include <string>

#include "area_model/price.hpp"
#include "sim/sweep/sweep.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

struct CostChoice {
  std::string library;  ///< empty: the thesis's
  std::optional<double> triangle_ns;
  std::optional<double> triangle_mm2;

  /// Throws what rtl::Library::load() throws.
  [[nodiscard]] rtl::Library load() const;
  /// What the user does not say is the cost of the library's float triangle unit. Throws std::runtime_error,
  /// one line, when the library cannot price that.
  [[nodiscard]] sim::TriangleCost triangle(const rtl::Library& priced_by) const;
  [[nodiscard]] bool says_triangle() const { return triangle_ns || triangle_mm2; }
};

/// Adds --library, --triangle-ns and --triangle-mm2.
void add_cost_options(CLI::App& command, CostChoice& choice);

}  // namespace hitpipe::cli
