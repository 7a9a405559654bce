// A unit: the hardware of a design at one format, whole or cut to what it demands of rays and boxes, with its
// Verilog. It is made here or read from a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/emit/ray_slots.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"

namespace hitpipe::sim {

struct Unit {
  const rtl::Design* design;
  rtl::Format format;
  std::string module;  ///< the top of its Verilog, without ray slots
  rtl::Pipeline pipeline;
  std::string verilog;
  rtl::FlowControl flow_control = rtl::FlowControl::stall;
  rtl::Demands demands{};                    ///< none of a whole unit
  std::optional<rtl::RaySlots> ray_slots{};  ///< a memory of rays before the unit, also in the Verilog

  ref::CoarseAxes coarse{};  ///< how its set-up rounds
  bool ends = true;          ///< false: its set-up says of every ray that it has no end

  /// The operands of the whole design. A cut unit may lack ports or bits of ports.
  [[nodiscard]] std::vector<rtl::Port> ports() const { return design->ports(format); }
};

/// The whole design, as read_unit() would read what `hitpipe rtl` writes of it.
[[nodiscard]] Unit make_unit(const rtl::Design& design, const rtl::Format& format,
                             const rtl::Library& library, rtl::FlowControl flow = rtl::FlowControl::stall,
                             int interval = 1);

/// A pipeline that prune() left of the design. The demands say how the set-up rounds and whether rays end.
[[nodiscard]] Unit make_unit(const rtl::Design& design, const rtl::Format& format,
                             const rtl::Library& library, rtl::Pipeline pipeline, rtl::Demands demands,
                             rtl::FlowControl flow = rtl::FlowControl::stall);

/// From a folder that `hitpipe fit` or `hitpipe rtl` wrote: the Verilog may be edited. `place` is the unit's
/// manifest, or a folder with one manifest of the design; the Verilog is beside it. Throws std::runtime_error
/// or std::invalid_argument, one line, when a file is missing or damaged, or belongs to another design or
/// library, and when the folder has units of the design under several names.
[[nodiscard]] Unit read_unit(const std::filesystem::path& place, const rtl::Design& design,
                             const rtl::Library& library);

/// The unit behind a memory of as many rays, rounded up to a power of two. Throws as rtl::ray_slots() does,
/// and std::invalid_argument, one line, for a unit without flow control.
[[nodiscard]] Unit behind_ray_slots(Unit unit, int slots);

/// Checks operands against a unit's demands. Operands that break a demand would give wrong answers unnoticed.
/// An OperandStep of a feed (sim/feeds/step_feed.hpp).
class DemandGuard {
 public:
  /// Ignores demands on ports that do not exist; check_demands() finds those.
  DemandGuard(const rtl::Demands& demands, const std::vector<rtl::Port>& ports);

  /// Throws std::out_of_range, one line that names port, number and demand.
  void operator()(const std::int64_t* operands) const;

 private:
  struct Bound {
    std::size_t port;
    rtl::PortDemand demand;
  };
  struct Order {
    std::size_t lesser, greater;
    rtl::OrderDemand demand;
  };
  std::vector<Bound> bounds_;
  std::vector<Order> orders_;
};

}  // namespace hitpipe::sim
