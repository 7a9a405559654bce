// Co-simulation: a scene rendered by rays of all kinds whose every box test is answered by the emitted
// Verilog, and the same rays traced in software by a traversal that cannot miss a box.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/fit/guarded_feed.hpp"
#include "sim/ray_unit.hpp"
#include "sw_ref/demands/scene_demands.hpp"
#include "sw_ref/render/whitted.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::sim {

struct CosimOptions {
  int width = 256;
  int height = 256;
  int rays_in_flight = 32;  ///< 1..RayUnit::most_rays_in_flight
  int threads = 1;
  bool referee = false;
  ref::WhittedOptions light{};  ///< how far secondary rays are followed
  ref::CoarseAxes coarse{};     ///< that the unit's operands are on; the referee judges the boxes as they are
  bool ends = true;  ///< the unit hears where rays end; without, it is given endless ones and traces the same
  /// Of a fitted unit: what its rays and operands must be. A ray or operand that is not throws
  /// std::out_of_range.
  const ref::SceneDemands* scene_demands = nullptr;
  const OperandGuard* guard = nullptr;
  /// Told the finished share of the image, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
};

/// The image is cut into tiles, and each is traced by a unit of its own. So counts depend on the size of the
/// image and the number of rays in flight, but not on the number of threads. Only the seconds differ between
/// runs.
struct CosimResult {
  std::uint64_t rays_primary = 0;
  std::uint64_t rays_secondary = 0;
  std::uint64_t rays_shadow = 0;
  std::uint64_t rejected = 0;             ///< rays no unit accepts (outside the cube); they hit nothing
  std::uint64_t different_triangles = 0;  ///< closest hits: another triangle; shadow: blocked or not
  UnitCounts unit;
  ref::TraversalCounts reference;  ///< of the software traversal of the same rays on the same hierarchy
  int latency = 0;
  /// For the cycles of the Verilog alone, estimated from samples (sim/sampled_time.hpp); 0 when there were
  /// too few to sample.
  double rtl_seconds = 0;
  /// Processor time of the whole loops around the units: the Verilog, the set-up of rays and boxes, the C++
  /// datapath, traversals, shading, and the referee if there is one. The reference comes later and is not in
  /// it.
  double loop_seconds = 0;
  std::vector<glm::vec3> image;          ///< linear, row by row from the top
  std::vector<std::uint32_t> triangles;  ///< by pixel, found through the Verilog

  [[nodiscard]] double occupancy_pct() const;
  [[nodiscard]] double extra_box_tests_pct() const;
  [[nodiscard]] double extra_triangle_tests_pct() const;
  /// Box tests by rtl_seconds and by loop_seconds; 0 when those are.
  [[nodiscard]] double rtl_tests_per_s() const;
  [[nodiscard]] double loop_tests_per_s() const;

  /// No RTL mismatch and no different triangle. This says nothing of false misses.
  [[nodiscard]] bool same_as_software() const;
  /// Nothing when no referee looked for false misses.
  [[nodiscard]] std::optional<bool> without_false_miss() const;
  /// The same as software; of a conservative design the referee must also have looked and found no false
  /// miss.
  [[nodiscard]] bool verified(bool conservative) const;
};

/// Throws as make_feed(), RayUnit and ref::Whitted do, and std::invalid_argument, one line, for an image
/// without pixels.
[[nodiscard]] CosimResult cosimulate(const rtl::Design& design, rtl::Format format,
                                     const VerilatedDesign& verilated, const ref::Scene& scene,
                                     const ref::Bvh& bvh, const CosimOptions& options);

}  // namespace hitpipe::sim
