#include "sim/fit/fit.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/prune/promises.hpp"
#include "sw_ref/encode/int_nodes.hpp"

namespace hitpipe::sim {

namespace {

struct Cutter {
  const rtl::Design& design;
  rtl::Format format;
  const rtl::Library& library;
  rtl::Graph traced;
  rtl::Demands promised;

  [[nodiscard]] rtl::Pruned pruned(const rtl::Demands& demands) const {
    return rtl::prune(traced, demands, {.promised = promised, .shares = false});
  }
  [[nodiscard]] area::Price price(const rtl::Demands& demands) const {
    return area::price(rtl::make_pipeline(pruned(demands).graph, library), {design.name, format}, library);
  }
};

std::string what_text(const rtl::Demands& demands) {
  std::vector<std::string> names;
  for (const rtl::PortDemand& demand : demands.ports) names.push_back(demand.port);
  if (names.front() == "rinf") return "the ends of rays";
  const int low_zeros = demands.ports.front().low_zeros;
  return low_zeros > 0 ? fmt::format("low bits of {}: {}", fmt::join(names, ", "), low_zeros)
                       : fmt::format("numbers of {} that never come", fmt::join(names, ", "));
}

}  // namespace

FittedUnit fit(const rtl::Design& design, rtl::Format before, const std::optional<Precision>& precision,
               const ref::SceneDemands& scene, const rtl::Library& library) {
  const rtl::Format format = precision && !before.is_float() ? rtl::Format(precision->bits) : before;
  const std::vector<DemandGroup> groups =
      port_demands(design, format, scene, precision.value_or(Precision{}));
  const Cutter cutter{design, format, library, design.trace(format), rtl::promises(design, format)};
  const rtl::Demands demands = all_of(groups);
  rtl::Pruned pruned = cutter.pruned(demands);
  rtl::Pipeline pipeline = rtl::make_pipeline(pruned.graph, library);
  area::Price price = area::price(pipeline, {design.name, format}, library);
  FittedUnit unit{.design = &design,
                  .before = before,
                  .format = format,
                  .precision = precision,
                  .price_before = area::price(design, before, library, area::Account::built),
                  .price = std::move(price),
                  .demands = demands,
                  .ports = rtl::input_ports(cutter.traced),
                  .report = std::move(pruned.report),
                  .pipeline = std::move(pipeline),
                  .left_out = {}};

  if (unit.format != before) {
    const area::Price whole = area::price(design, unit.format, library, area::Account::built);
    unit.left_out.push_back(
        {fmt::format("bits: {} instead of {}", rtl::to_string(unit.format), rtl::to_string(before)),
         measured_text(precision->extra_box_tests_pct), unit.price_before.area_um2 - whole.area_um2});
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    unit.left_out.push_back({what_text(groups[i].demands), groups[i].why,
                             cutter.price(all_without(groups, i)).area_um2 - unit.price.area_um2});
  }
  return unit;
}

std::size_t bytes_per_node(rtl::Format format, const ref::CoarseAxes& coarse) {
  if (format.is_float()) return sizeof(ref::BvhNode);
  ref::Bvh one;
  one.nodes.push_back({{glm::vec3(0), glm::vec3(0)}, 1, 0});
  return ref::IntNodes(one, format.bits().coord, coarse).bytes_per_node;
}

}  // namespace hitpipe::sim
