#include "cli/options/cost_options.hpp"

#include <cmath>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "host/talk.hpp"

namespace hitpipe::cli {

namespace {

void add_cost(CLI::App& command, const char* name, std::optional<double>& value, const std::string& what) {
  command
      .add_option(name, value, what + " (default: a float unit's in the same library; an estimate on a chip)")
      ->transform(number_from(0.0, 1e6))
      ->type_name("X");
}

}  // namespace

sim::TriangleCost CostChoice::triangle(const rtl::Library& priced_by) const {
  const bool all = triangle_ns && (priced_by.chip() != nullptr ? triangle_luts : triangle_mm2);
  sim::TriangleCost cost = all ? sim::TriangleCost{} : sim::triangle_cost(priced_by);
  if (triangle_ns) cost.delay_ps = std::llround(*triangle_ns * 1e3);
  if (triangle_mm2) cost.area_um2 = std::llround(*triangle_mm2 * 1e6);
  if (triangle_luts) cost.luts = std::llround(*triangle_luts);
  return cost;
}

std::vector<const rtl::Design*> priced_by(const rtl::Library& library,
                                          std::vector<const rtl::Design*> designs, bool named) {
  std::erase_if(designs, [&](const rtl::Design* design) {
    const std::string why = sim::why_not_priced(*design, design->default_format, library);
    if (why.empty()) return false;
    if (named) throw std::runtime_error(why);
    host::note(fmt::format("left out: {}", why));
    return true;
  });
  return designs;
}

void add_triangle_options(CLI::App& command, CostChoice& choice) {
  add_cost(command, "--triangle-ns", choice.triangle_ns,
           "Time after which a triangle unit begins another test");
  add_cost(command, "--triangle-mm2", choice.triangle_mm2, "Area of that triangle unit");
  command.add_flag("--tests-only", choice.tests_only,
                   "The whole cost is that of tests: no divisions of rays' set-up, no energy");
}

void add_cost_options(CLI::App& command, CostChoice& choice) {
  add_library_option(command, choice.library);
  add_triangle_options(command, choice);
  add_cost(command, "--triangle-luts", choice.triangle_luts, "Lookup tables of that triangle unit on a chip");
}

}  // namespace hitpipe::cli
