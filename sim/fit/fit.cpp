#include "sim/fit/fit.hpp"

#include <bit>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/prune/facts.hpp"
#include "sim/software.hpp"

namespace hitpipe::sim {

namespace {

struct Cutter {
  const rtl::Design& design;
  rtl::Format format;
  const rtl::Library& library;
  rtl::Graph traced;
  rtl::Demands set_up;

  [[nodiscard]] rtl::Pruned pruned(const rtl::Demands& demands) const {
    return rtl::prune(traced, demands, {.set_up = set_up, .shares = false});
  }
  [[nodiscard]] area::Price price(const rtl::Demands& demands) const {
    return area::price(rtl::make_pipeline(pruned(demands).graph, library), design, format, library);
  }
};

/// "the sign and 2 bits after it": the bits of a float that a demand fixes.
std::string fixed_text(const rtl::Facts& facts) {
  const std::uint64_t known = facts.zeros() | facts.ones();
  const int bits = std::popcount(known);
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

}  // namespace

FittedUnit fit(const rtl::Design& design, const rtl::Format& before,
               const std::optional<Precision>& precision, const ref::SceneDemands& scene,
               const rtl::Library& library) {
  const rtl::Format format = precision ? precision->format : before;
  const std::vector<DemandGroup> groups = port_demands(design, format, scene, precision);
  const Cutter cutter{design, format, library, design.trace(format),
                      rtl::set_up_demands(design.ports(format))};
  const rtl::Demands demands = all_of(groups);
  rtl::Pruned pruned = cutter.pruned(demands);
  rtl::Pipeline pipeline = rtl::make_pipeline(pruned.graph, library);
  area::Price price = area::price(pipeline, design, format, library);
  FittedUnit unit{make_unit(design, format, library, std::move(pipeline), demands),
                  before,
                  precision,
                  area::price(design, before, library, area::Account::built),
                  std::move(price),
                  std::move(pruned.report),
                  {}};

  if (unit.format != before) {
    const area::Price whole = area::price(design, unit.format, library, area::Account::built);
    unit.left_out.push_back(
        {fmt::format("bits: {} instead of {}", rtl::to_string(unit.format), rtl::to_string(before)),
         fmt::format(
             "{:.2f} % extra box tests and {:.2f} % extra triangle tests, measured on the scene's rays",
             precision->extra_box_tests_pct, precision->extra_triangle_tests_pct),
         unit.price_before.area_um2 - whole.area_um2});
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    unit.left_out.push_back({what_text(groups[i], unit.ports()), groups[i].why,
                             cutter.price(all_without(groups, i)).area_um2 - unit.price.area_um2});
  }
  return unit;
}

area::Price price_of_fit(const rtl::Design& design, const Precision& precision,
                         const ref::SceneDemands& scene, const rtl::Library& library) {
  const rtl::Format& format = precision.format;
  const Cutter cutter{design, format, library, design.trace(format),
                      rtl::set_up_demands(design.ports(format))};
  return cutter.price(all_of(port_demands(design, format, scene, precision)));
}

rtl::EmittedDesign fitted_files(const FittedUnit& unit, const rtl::Library& library) {
  const std::vector<rtl::Port> ports = unit.ports();
  const rtl::PrunedFrom from{ports, unit.demands, unit.report};
  return rtl::emit(*unit.design, unit.format, library, unit.pipeline,
                   {.pruned_from = unit.demands.empty() ? nullptr : &from, .verilog = &unit.verilog});
}

}  // namespace hitpipe::sim
