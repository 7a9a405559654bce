#include "sim/fit/fit.hpp"

#include <bit>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim {

namespace {

struct Cutter {
  const rtl::Design& design;
  Format format;
  const rtl::Library& library;
  rtl::Graph traced;
  rtl::Demands set_up;
  FitRate rate;

  [[nodiscard]] rtl::Pruned pruned(const rtl::Demands& demands) const {
    return rtl::prune(traced, demands, {.set_up = set_up, .shares = false});
  }
  [[nodiscard]] rtl::Pipeline pipeline(const rtl::Graph& graph, int interval) const {
    return rtl::make_pipeline(graph, library, std::nullopt, interval);
  }
  [[nodiscard]] area::Price price(const rtl::Pipeline& pipeline) const {
    return area::price(pipeline, design, format, library);
  }
  [[nodiscard]] bool is_reached_by(const area::Price& price) const {
    return static_cast<double>(price.boxes_per_second()) >= rate.boxes_per_second;
  }
  /// The smallest unit that reaches the rate, or a test in each cycle. A longer interval may be larger.
  [[nodiscard]] area::Price smallest(const rtl::Graph& graph) const {
    if (rate.boxes_per_second <= 0) return price(pipeline(graph, rate.interval));
    area::Price best = price(pipeline(graph, 1));
    for (int interval = 2; interval <= rtl::most_interval; ++interval) {
      area::Price next = price(pipeline(graph, interval));
      if (!is_reached_by(next)) break;
      if (next.area_um2 < best.area_um2) best = std::move(next);
    }
    return best;
  }
  /// The same with all groups, or without what is promised of numbers if that is smaller: a promise narrows
  /// operations, and a component is shared by operations of one width alone.
  [[nodiscard]] area::Price smallest(const std::vector<DemandGroup>& groups) const {
    area::Price best = smallest(pruned(all_of(groups)).graph);
    if (best.interval == 1 && rate.boxes_per_second <= 0) return best;
    std::vector<DemandGroup> others;
    for (const DemandGroup& group : groups)
      if (group.what != DemandGroup::What::numbers) others.push_back(group);
    area::Price bare = smallest(pruned(all_of(others)).graph);
    return is_reached_by(bare) && bare.area_um2 < best.area_um2 ? bare : best;
  }
};

std::string millions(double per_second) {
  return fmt::format("{:.4g}", per_second / 1e6);
}

/// "the sign and 2 bits after it": the bits of a float that a demand fixes.
std::string fixed_text(const rtl::Facts& facts) {
  const rtl::Word known = facts.zeros() | facts.ones();
  const int bits = rtl::count_of_ones(known);
  if (bits == facts.width()) return "all bits";
  const bool sign = (known >> (facts.width() - 1) & 1) != 0;
  const int after = sign ? bits - 1 : bits;
  if (after == 0) return "the sign";
  return fmt::format("{}{} bit{} after {}", sign ? "the sign and " : "", after, after == 1 ? "" : "s",
                     sign ? "it" : "the sign");
}

/// What a group fixes of float ports: "the sign of ymin, ymax". Empty if it has other ports.
std::string fixed_text(const DemandGroup& group, const std::vector<rtl::Port>& ports) {
  std::vector<std::pair<std::string, std::vector<std::string>>> fixed;
  for (const rtl::PortDemand& demand : group.demands.ports) {
    const rtl::Port& port = ports[rtl::index_of(ports, demand.port).value()];
    if (port.kind != hls::Kind::real) return "";
    const std::string bits = fixed_text(rtl::facts_of(demand, port.width, port.is_signed));
    if (fixed.empty() || fixed.back().first != bits) fixed.push_back({bits, {}});
    fixed.back().second.push_back(port.name);
  }
  std::vector<std::string> texts;
  for (const auto& [bits, names] : fixed)
    texts.push_back(fmt::format("{} of {}", bits, fmt::join(names, ", ")));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string what_text(const DemandGroup& group, const std::vector<rtl::Port>& ports) {
  std::vector<std::string> names;
  for (const rtl::PortDemand& demand : group.demands.ports) names.push_back(demand.port);
  switch (group.what) {
    case DemandGroup::What::ends:
      return "the ends of rays";
    case DemandGroup::What::low_bits:
      return fmt::format("low bits of {}: {}", fmt::join(names, ", "), group.demands.ports.front().low_zeros);
    case DemandGroup::What::numbers:
      break;
  }
  if (const std::string fixed = fixed_text(group, ports); !fixed.empty()) return fixed;
  return fmt::format("numbers of {} that never come", fmt::join(names, ", "));
}

/// The groups that make the unit smaller. In a test in each cycle all do. Components of fewer bits cost less,
/// but a component is shared by operations of one width alone. Low bits that are dropped stay so: the ranges
/// of the other groups hold only with them.
std::vector<DemandGroup> worth_using(const std::vector<DemandGroup>& groups, const Cutter& cutter,
                                     int interval) {
  if (interval == 1) return groups;
  struct Choice {
    std::vector<DemandGroup> groups;
    std::int64_t area_um2;
  };
  const auto chosen = [&](const std::vector<bool>& used) {
    Choice choice;
    for (std::size_t i = 0; i < groups.size(); ++i)
      if (used[i]) choice.groups.push_back(groups[i]);
    const rtl::Graph graph = cutter.pruned(all_of(choice.groups)).graph;
    choice.area_um2 = cutter.price(cutter.pipeline(graph, interval)).area_um2;
    return choice;
  };
  // One group after another, as long as that makes the unit smaller.
  const auto stays = [&](std::size_t i) { return groups[i].what == DemandGroup::What::low_bits; };
  const auto improved = [&](std::vector<bool> used) {
    for (std::size_t i = 0; i < groups.size(); ++i)
      if (stays(i)) used[i] = true;
    Choice best = chosen(used);
    for (std::size_t unchanged = 0, i = 0; unchanged < groups.size(); i = (i + 1) % groups.size()) {
      if (stays(i)) {
        ++unchanged;
        continue;
      }
      used[i] = !used[i];
      Choice other = chosen(used);
      if (other.area_um2 < best.area_um2) {
        best = std::move(other);
        unchanged = 0;
      } else {
        used[i] = !used[i];
        ++unchanged;
      }
    }
    return best;
  };
  Choice from_all = improved(std::vector<bool>(groups.size(), true));
  Choice from_none = improved(std::vector<bool>(groups.size(), false));
  return from_none.area_um2 < from_all.area_um2 ? from_none.groups : from_all.groups;
}

}  // namespace

FittedUnit fit(const rtl::Design& design, const Format& before, const std::optional<Precision>& precision,
               const ref::SceneDemands& scene, const rtl::Library& library, const FitRate& rate) {
  const Format format = precision ? precision->format : before;
  const Cutter cutter{
      design, format, library, design.trace(format), rtl::set_up_demands(design.ports(format)), rate};
  const std::vector<DemandGroup> all = port_demands(design, format, scene, precision);
  const std::vector<DemandGroup> groups = worth_using(all, cutter, cutter.smallest(all).interval);
  const rtl::Demands demands = all_of(groups);
  rtl::Pruned pruned = cutter.pruned(demands);
  area::Price price = cutter.smallest(pruned.graph);
  const int interval = price.interval;
  if (!cutter.is_reached_by(price))
    throw std::runtime_error(
        fmt::format("{} {}: {} million boxes a second are asked for; it takes {} million at most",
                    design.name, to_string(format), millions(rate.boxes_per_second),
                    millions(static_cast<double>(price.boxes_per_second()))));
  rtl::Pipeline pipeline = cutter.pipeline(pruned.graph, interval);
  FittedUnit unit{
      rtl::make_unit(design, format, library, std::move(pipeline), demands, std::move(pruned.report)),
      before,
      precision,
      area::price(design, before, library, area::Account::built),
      std::move(price),
      {}};

  if (unit.format != before) {
    const area::Price whole = area::price(design, unit.format, library, area::Account::built);
    unit.left_out.push_back(
        {fmt::format("bits: {} instead of {}", to_string(unit.format), to_string(before)),
         fmt::format(
             "{:.2f} % extra box tests and {:.2f} % extra triangle tests, measured on the scene's rays",
             precision->extra_box_tests_pct, precision->extra_triangle_tests_pct),
         unit.price_before.area_um2 - whole.area_um2});
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const rtl::Graph without = cutter.pruned(all_without(groups, i)).graph;
    unit.left_out.push_back(
        {what_text(groups[i], unit.ports()), groups[i].why,
         cutter.price(cutter.pipeline(without, interval)).area_um2 - unit.price.area_um2});
  }
  if (interval > 1) {
    const area::Price every_cycle = cutter.price(cutter.pipeline(pruned.graph, 1));
    const std::string asked = rate.boxes_per_second > 0
                                  ? millions(rate.boxes_per_second) + " million boxes a second are asked for"
                                  : "no more is asked for";
    unit.left_out.push_back({fmt::format("rate: a test every {} cycles", interval), asked,
                             every_cycle.area_um2 - unit.price.area_um2});
  }
  return unit;
}

std::optional<area::Price> price_of_fit(const rtl::Design& design, const Precision& precision,
                                        const ref::SceneDemands& scene, const rtl::Library& library,
                                        const FitRate& rate) {
  const Format& format = precision.format;
  const Cutter cutter{
      design, format, library, design.trace(format), rtl::set_up_demands(design.ports(format)), rate};
  const area::Price price = cutter.smallest(port_demands(design, format, scene, precision));
  return cutter.is_reached_by(price) ? std::optional(price) : std::nullopt;
}

}  // namespace hitpipe::sim
