#include "sim/implement/fitting_option.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "area_model/price.hpp"
#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"
#include "sim/implement/clocks.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim {

namespace {

constexpr std::size_t most_clocks = 6;
constexpr int intervals[] = {2, 3, 4, 6};
/// A synthesis of more lookup tables and registers takes a minute and longer.
constexpr int most_cells_to_synthesise = 15'000;

/// What the area model says that a unit takes. Only ratios of these are used, so that where a library has no
/// lookup tables an area stands for them.
rtl::ChipCells modelled(const rtl::Design& design, const FittingCandidate& unit, const rtl::Library& library,
                        rtl::FlowControl flow) {
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(design.trace(unit.format), library, unit.clock_ps, unit.interval);
  const area::Price price = area::price(pipeline, design, unit.format, library, flow);
  if (library.chip() != nullptr) return price.taken;
  rtl::ChipCells cells;
  for (const area::Line& line : price.lines) {
    switch (line.part.component) {
      case rtl::Component::latch:
      case rtl::Component::latch_enable:
        cells.registers += std::int64_t{line.n} * line.part.bits;
        break;
      case rtl::Component::int_multiply:
      case rtl::Component::fp_multiply:
      case rtl::Component::fp_multiply_rz:
        cells.blocks += line.n;
        break;
      default:
        cells.luts += line.area_um2;
    }
  }
  return cells;
}

/// The counts of a unit, changed as the model says.
std::vector<ResourceCount> estimated(const Implementation& unit, const rtl::ChipCells& before,
                                     const rtl::ChipCells& now) {
  const auto changed = [](int used, std::int64_t from, std::int64_t to) {
    return from == 0
               ? used
               : static_cast<int>(std::ceil(used * static_cast<double>(to) / static_cast<double>(from)));
  };
  const ResourceCount* const unit_luts = unit.count_of("luts");
  const int luts = unit_luts == nullptr ? 0 : unit_luts->used;
  std::vector<ResourceCount> counts = unit.counts;
  for (ResourceCount& count : counts) {
    if (count.name == "registers") count.used = changed(count.used, before.registers, now.registers);
    if (count.name == "dsps") count.used = changed(count.used, before.blocks, now.blocks);
    if (count.name == "luts" || count.name == "carries")
      count.used = changed(count.used, before.luts, now.luts);
    // A cell without a lookup table holds a register.
    if (count.name == "logic_cells")
      count.used =
          changed(luts, before.luts, now.luts) + changed(count.used - luts, before.registers, now.registers);
  }
  return counts;
}

bool is_large(const std::vector<ResourceCount>& counts) {
  int cells = 0;
  for (const ResourceCount& count : counts)
    if (count.name == "luts" || count.name == "registers") cells += count.used;
  return cells > most_cells_to_synthesise;
}

bool all_fit(const std::vector<ResourceCount>& counts) {
  return std::all_of(counts.begin(), counts.end(), [](const ResourceCount& count) { return count.fits(); });
}

/// Of what the unit took too much, and of what the tools count after packing.
std::string taken_text(const std::vector<ResourceCount>& counts, const Implementation& unit) {
  std::vector<std::string> taken;
  for (const ResourceCount& count : counts) {
    const ResourceCount* const before = unit.count_of(count.name);
    if (count.available && ((before != nullptr && !before->fits()) || count.name == "logic_cells"))
      taken.push_back(count.text());
  }
  return fmt::format("{}", fmt::join(taken, ", "));
}

/// Its counts, if it fits.
std::optional<std::vector<ResourceCount>> counts_if_it_fits(const rtl::Design& design,
                                                            const FittingCandidate& candidate,
                                                            const Target& target,
                                                            const ImplementOptions& given) {
  const host::ScratchFolder folder;
  ImplementOptions options = given;
  options.folder = folder.path();
  options.clock_ps = candidate.clock_ps;
  options.interval = candidate.interval;
  options.seeds = std::min(given.seeds, 1);
  options.simulate.reset();
  options.progress = [&](const std::string& step) {
    given.progress(fmt::format("trying {}: {}", candidate.option, step));
  };
  try {
    const Implementation unit = implement_unit(design, candidate.format, target, options);
    if (unit.excess().empty() && (!unit.placed || unit.placed->why_not.empty())) return unit.counts;
  } catch (const std::runtime_error&) {
    // A tool failed. The result of the user's own unit counts more.
  }
  return std::nullopt;
}

}  // namespace

std::vector<FittingCandidate> fitting_candidates(const rtl::Design& design, const Format& format,
                                                 const Target& target, const ImplementOptions& options) {
  std::vector<FittingCandidate> candidates;
  const rtl::Graph graph = design.trace(format);
  const rtl::Library library = options.library_for(target);
  const int own_ps =
      options.clock_ps ? *options.clock_ps : rtl::make_pipeline(graph, library).schedule.clock_ps;
  for (const int clock_ps : clocks_to_try(graph, library, most_clocks))
    if (clock_ps > own_ps)
      candidates.push_back({fmt::format("--clock-ps {}", clock_ps), format, clock_ps, options.interval});
  for (const int interval : intervals)
    if (interval > options.interval)
      candidates.push_back({fmt::format("--ii {}", interval), format, options.clock_ps, interval});
  if (const auto smaller = software_of(design).smaller_formats; smaller != nullptr) {
    const std::vector<std::vector<Format>> groups = smaller(format);
    for (auto group = groups.rbegin(); group != groups.rend(); ++group)
      if (group->back() != format)
        candidates.push_back({fmt::format("--bits {}", to_string(group->back())), group->back(),
                              options.clock_ps, options.interval});
  }
  return candidates;
}

std::string fitting_option(const rtl::Design& design, const Format& format, const Target& target,
                           const ImplementOptions& options, const Implementation& unit) {
  const rtl::Library library = options.library_for(target);
  const auto model = [&](const FittingCandidate& each) {
    return modelled(design, each, library, options.flow_control);
  };
  const rtl::ChipCells before = model({"", format, options.clock_ps, options.interval});
  const std::vector<FittingCandidate> candidates = fitting_candidates(design, format, target, options);
  for (const FittingCandidate& candidate : candidates) {
    options.progress(fmt::format("estimating {}", candidate.option));
    const std::vector<ResourceCount> estimate = estimated(unit, before, model(candidate));
    if (!all_fit(estimate)) continue;
    if (is_large(estimate))
      return fmt::format("with {} it takes {} by estimate", candidate.option, taken_text(estimate, unit));
    if (const auto counts = counts_if_it_fits(design, candidate, target, options))
      return fmt::format("with {} it takes {}", candidate.option, taken_text(*counts, unit));
  }
  return "none of the options tried (a longer --clock-ps, --ii up to 6, fewer --bits) fits";
}

}  // namespace hitpipe::sim
