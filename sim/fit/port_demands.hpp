// From what a scene demands to what a unit's ports are promised: the bounds of rays and boxes taken through
// the set-up that makes operands of them (sw_ref/quantise).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/prune/demands.hpp"
#include "sim/fit/precision.hpp"
#include "sw_ref/demands/scene_demands.hpp"

namespace hitpipe::sim {

/// Demands that stand or fall with one property of the scene.
struct DemandGroup {
  enum class What { numbers, low_bits, ends };

  std::string why;  ///< "the eye alone sends rays: origin.x = 0.25"
  What what;        ///< is left out
  rtl::Demands demands;
};

/// Ranges, only of ports that lose a bit or their sign by it: what says no more than the cube does is left
/// out. And of each coarse axis of `precision` a group whose ports have low zeros.
[[nodiscard]] std::vector<DemandGroup> port_demands(const rtl::Design& design, const rtl::Format& format,
                                                    const ref::SceneDemands& scene,
                                                    const std::optional<Precision>& precision = std::nullopt);

/// One demand for each port that groups speak of.
[[nodiscard]] rtl::Demands all_of(const std::vector<DemandGroup>& groups);
/// All but one group.
[[nodiscard]] rtl::Demands all_without(const std::vector<DemandGroup>& groups, std::size_t left_out);

}  // namespace hitpipe::sim
