// Turns what a scene demands into demands on a unit's ports. The bounds of rays and boxes go through the same
// set-up that makes the operands (sw_ref/quantise).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/prune/demands.hpp"
#include "sim/fit/precision.hpp"
#include "sw_ref/quantise/scene_demands.hpp"

namespace hitpipe::sim {

/// Demands that follow from one property of the scene.
struct DemandGroup {
  enum class What { numbers, low_bits, ends };

  std::string why;  ///< for example "the eye alone sends rays: origin.x = 0.25"
  What what;        ///< what the unit can leave out
  rtl::Demands demands;
};

/// Gives a range only to ports that lose a bit or their sign by it; all other ranges follow from the cube
/// anyway. Adds a group for each coarse axis of `precision`: low bits of its ports are 0.
[[nodiscard]] std::vector<DemandGroup> port_demands(const rtl::Design& design, const Format& format,
                                                    const ref::SceneDemands& scene,
                                                    const std::optional<Precision>& precision = std::nullopt);

/// One demand for each port in the groups.
[[nodiscard]] rtl::Demands all_of(const std::vector<DemandGroup>& groups);
/// All groups but one.
[[nodiscard]] rtl::Demands all_without(const std::vector<DemandGroup>& groups, std::size_t left_out);

}  // namespace hitpipe::sim
