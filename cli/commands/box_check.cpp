#include "cli/commands/box_check.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "cli/commands/categories.hpp"
#include "cli/text/progress.hpp"
#include "sim/check/check.hpp"
#include "sim/check/shares.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::cli {

namespace {

std::string why_not_compared(const rtl::Design& design) {
  if (design.kind == hls::triangle_kind)
    return fmt::format("design {}: tests triangles; check it alone, in one format", design.name);
  return sim::software_of(design).box_test == nullptr ? sim::missing(design, sim::set_up_part) : "";
}

}  // namespace

std::vector<ref::adversary::Category> box_categories(const rtl::Design& design,
                                                     const std::vector<std::string>& names) {
  const auto general = ref::adversary::categories();
  std::vector<ref::adversary::Category> all(general.begin(), general.end());
  const std::vector<ref::adversary::Category>& own = sim::software_of(design).categories;
  all.insert(all.end(), own.begin(), own.end());
  return chosen_of(all, names);
}

CheckFindings check_box_unit(const rtl::Design& design, const Format& format, const BoxCheck& check) {
  std::optional<Progress> progress;
  std::optional<sim::VerilatedDesign> verilated;
  const std::string unit = fmt::format("{} {}: ", design.name, to_string(format));
  if (check.rtl) {
    progress.emplace(unit + "compiling the Verilog");
    verilated.emplace(rtl::make_unit(design, format, rtl::Library::thesis(), {.interval = check.interval}));
  }
  progress.emplace(unit + "judging");
  const sim::MakeBoxTest& comparison = sim::software_of(design).comparison_test;
  const bool compares = check.comparison && comparison;
  const double runs = compares ? 2.0 : 1.0;
  double finished = 0;
  sim::CheckOptions options{.categories = box_categories(design, check.categories),
                            .tests = check.tests,
                            .seed = check.seed,
                            .piece = check.piece,
                            .threads = check.threads,
                            .rtl = verilated ? &*verilated : nullptr,
                            .progress = [&](double share) { progress->show((finished + share) / runs); }};
  CheckFindings found{{std::string(design.name), format, check.seed, check.rtl}};
  found.categories = sim::check([&] { return sim::make_box_test(design, format); }, options);
  if (compares) {
    finished = 1;
    options.rtl = nullptr;
    found.comparison = sim::check(comparison, options);
  }
  return found;
}

std::vector<sim::DesignFormats> compared_units(const DesignsChoice& choice) {
  std::vector<const rtl::Design*> designs = choice.designs(why_not_compared);
  if (choice.names.empty())
    std::erase_if(designs, [](const rtl::Design* design) { return !design->conservative; });
  return choice.formats(designs,
                        [](const rtl::Design& design) { return std::vector{design.default_format}; });
}

UnitsFindings check_box_units(const std::vector<sim::DesignFormats>& units, const BoxCheck& check) {
  UnitsFindings found;
  for (const sim::DesignFormats& each : units)
    for (const Format& format : each.formats)
      found.units.push_back(check_box_unit(*each.design, format, check));
  return found;
}

std::uint64_t batches_of_each(const std::vector<sim::DesignFormats>& units, const BoxCheck& check) {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (const sim::DesignFormats& each : units) {
    const std::size_t categories = box_categories(*each.design, check.categories).size();
    least = std::min(least, sim::Shares(check.tests, categories).batches());
  }
  return least;
}

}  // namespace hitpipe::cli
