// How much a box test loses on stiff rays, whose direction components differ by orders of magnitude. The
// three IRDVCs share one scale (section 6.2.1), so a small component leaves few bits to the others. Two
// components have magnitudes in [1, 2). The third, on any axis, is smaller by 2^-r, or exactly zero.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "rays/tree/bvh.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/software/box_software.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/judge/interval.hpp"

namespace hitpipe::sim {

/// r of the ratio 2^r. Nothing when the small component is zero.
using Stiffness = std::optional<int>;

/// 0, 2, ... 40, zero.
[[nodiscard]] std::span<const Stiffness> stiffnesses();

struct StiffnessOptions {
  std::uint64_t tests = 60'000;  ///< for each stiffness, divided among the kinds of box
  std::uint64_t rays = 2'000;    ///< through the scene, for each stiffness
  std::uint64_t seed = 1;        ///< cases depend only on the seed and their number
  int threads = 1;
  /// Gets the finished share, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
};

/// Boxes of one kind. Half a side is 2^-half_side of half the cube's side, or down to half of that. Aimed:
/// the ray passes through the box, or beside it at a distance of at most half its side. Not aimed: ray and
/// box lie anywhere.
struct StiffBoxes {
  Stiffness stiffness;
  int half_side = 0;
  bool aimed = false;
  std::uint64_t tests = 0;
  std::uint64_t hits = 0;  ///< by the exact referee
  std::uint64_t false_hits = 0;
  std::uint64_t false_misses = 0;

  /// In percent of the boxes that the ray misses.
  [[nodiscard]] double false_hit_pct() const;
  /// 95 %.
  [[nodiscard]] ref::Interval false_hit_pct_interval() const;
};

/// By stiffness, half side and aim.
[[nodiscard]] std::vector<StiffBoxes> stiff_boxes(const MakeBoxTest& make, const StiffnessOptions& options);

/// Sums the kinds of box of each stiffness, in order.
[[nodiscard]] std::vector<StiffBoxes> over_all_kinds(const std::vector<StiffBoxes>& boxes);

/// Endless rays from anywhere in the cube through a hierarchy. The design's C++ answers each box test.
struct StiffTraversals {
  Stiffness stiffness;
  std::uint64_t rays = 0;
  std::uint64_t box_tests = 0;
  std::uint64_t reference_box_tests = 0;  ///< by conservative float slabs in software, for the same rays
  std::uint64_t different_triangles = 0;
  ref::GroupedRatio work{};  ///< box tests over the reference's; a ray is a group

  [[nodiscard]] double extra_box_tests_pct() const;
  /// 95 %, by the spread among the rays.
  [[nodiscard]] ref::Interval extra_box_tests_pct_interval() const;
};

/// Results by stiffness. Throws what make_feed() throws.
[[nodiscard]] std::vector<StiffTraversals> stiff_traversals(const rtl::Design& design, Format format,
                                                            const ref::Mesh& mesh, const ref::Bvh& bvh,
                                                            const StiffnessOptions& options);

/// Draws a direction of this stiffness.
[[nodiscard]] glm::vec3 stiff_direction(ref::adversary::Random& random, Stiffness stiffness);

}  // namespace hitpipe::sim
