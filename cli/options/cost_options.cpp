#include "cli/options/cost_options.hpp"

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hitpipe::cli {

namespace {

constexpr double most_cost = 1e6;

/// CLI::Range accepts NaN.
std::string cost_problem(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end == '\0' && value >= 0 && value <= most_cost) return "";
  return fmt::format("Value {} not in range 0 to {}", text, most_cost);
}

}  // namespace

rtl::Library CostChoice::load() const {
  return library.empty() ? rtl::Library::thesis() : rtl::Library::load(library);
}

sim::TriangleCost CostChoice::triangle(const rtl::Library& priced_by) const {
  if ((!triangle_ns || !triangle_mm2) && !area::can_price_yardstick(priced_by))
    throw std::runtime_error(
        fmt::format("library {}: has no float components, so it cannot price a triangle test; give "
                    "--triangle-ns and --triangle-mm2",
                    priced_by.name()));
  sim::TriangleCost cost;
  if (!triangle_ns || !triangle_mm2) cost = sim::triangle_cost(priced_by);
  if (triangle_ns) cost.delay_ps = std::llround(*triangle_ns * 1e3);
  if (triangle_mm2) cost.area_um2 = std::llround(*triangle_mm2 * 1e6);
  return cost;
}

void add_cost_options(CLI::App& command, CostChoice& choice) {
  command
      .add_option("--library", choice.library, "Component library (JSON) in place of the thesis's Table 7.1")
      ->type_name("FILE");
  const auto add_cost = [&](const char* name, std::optional<double>& value, const std::string& what) {
    command.add_option(name, value, what + " (default: that of a float unit of the same library)")
        ->check(cost_problem)
        ->type_name("X");
  };
  add_cost("--triangle-ns", choice.triangle_ns, "Time after which a triangle unit begins another test");
  add_cost("--triangle-mm2", choice.triangle_mm2, "Area of that triangle unit");
}

}  // namespace hitpipe::cli
