// Co-simulation: renders a scene with rays of all kinds, or traces a list of rays, where the emitted Verilog
// answers every box test. The same rays are also traced in software, by a traversal that cannot miss a box.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/trace/tracer.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/operands/ray_list.hpp"
#include "sw_ref/judge/interval.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::ref {
struct SceneDemands;
}  // namespace hitpipe::ref

namespace hitpipe::sim {

class VerilatedDesign;

struct CosimOptions {
  int width = 256;
  int height = 256;
  int rays_in_flight = 32;  ///< 1..Station::most_rays
  int threads = 1;
  bool referee = false;
  bool bit_level = false;       ///< the bit-level C++ datapath judges every test of a float design
  ref::WhittedOptions light{};  ///< which rays follow the primary ones
  /// If there are any, these rays are traced in place of a picture's. Width, height and light mean nothing.
  std::span<const AskedRay> rays{};
  /// What the rays of a fitted unit must be. If one is not, std::out_of_range is thrown.
  const ref::SceneDemands* scene_demands = nullptr;
  /// Gets the finished share of the image, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
};

/// The image is cut into tiles, and each tile is traced by a unit of its own; a list of rays is cut into
/// parts. So counts depend on the size of the image and on the number of rays in flight, but not on the
/// number of threads. Only the seconds differ between runs. Rays of a list for any hit count as shadow rays,
/// others as primary rays.
struct CosimResult {
  std::uint64_t rays_primary = 0;
  std::uint64_t rays_secondary = 0;
  std::uint64_t rays_shadow = 0;
  std::uint64_t rejected = 0;             ///< rays outside the cube, which no unit accepts; they hit nothing
  std::uint64_t different_triangles = 0;  ///< another closest triangle, or another answer of a shadow ray
  UnitCounts unit;
  ref::TraceCounts reference;  ///< by software, for the same rays and hierarchy
  /// Tests above the reference's. The rays of a pixel are a group, and so is a ray of a list.
  ref::ExtraWork extra_box_tests, extra_triangle_tests;
  int latency = 0;
  int interval = 1;  ///< a test may begin every so many cycles
  /// Time for the cycles of the Verilog alone, estimated from samples (sim/cosim/sampled_time.hpp). 0 when
  /// there were too few cycles to sample.
  double rtl_seconds = 0;
  /// Processor time of the whole loops around the units: the Verilog, the set-up of rays and boxes, the C++
  /// datapath, traversals, shading, and the referee if there is one. The software reference runs later and is
  /// not included.
  double loop_seconds = 0;
  std::vector<glm::vec3> image;          ///< linear, row by row from the top; empty for a list
  std::vector<std::uint32_t> triangles;  ///< by pixel, or by ray of a list, found through the Verilog

  [[nodiscard]] double occupancy_pct() const;
  [[nodiscard]] double extra_box_tests_pct() const;
  [[nodiscard]] double extra_triangle_tests_pct() const;
  /// Tests through the pipeline divided by rtl_seconds and by loop_seconds. 0 when those are 0.
  [[nodiscard]] double rtl_tests_per_s() const;
  [[nodiscard]] double loop_tests_per_s() const;
  /// The same for the boxes that the tests answered for.
  [[nodiscard]] double rtl_boxes_per_s() const;
  [[nodiscard]] double loop_boxes_per_s() const;

  /// No RTL mismatch and no different triangle. This says nothing about false misses.
  [[nodiscard]] bool same_as_software() const;
  /// Nothing when no referee looked for false misses.
  [[nodiscard]] std::optional<bool> without_false_miss() const;
  /// same_as_software() holds. For a conservative design, the referee must also have looked and found no
  /// false miss.
  [[nodiscard]] bool verified(bool conservative) const;
};

/// The unit is given its own coarse axes and ends of rays, and every operand is checked against its demands;
/// the referee judges the original boxes. Throws what make_feed(), RayUnit and ref::Whitted throw,
/// std::invalid_argument, one line, for an image without pixels, and std::out_of_range, one line, for a scene
/// that does not keep to the unit's demands.
[[nodiscard]] CosimResult cosimulate(const VerilatedDesign& verilated, const ref::Scene& scene,
                                     const ref::Bvh& bvh, const CosimOptions& options);

}  // namespace hitpipe::sim
