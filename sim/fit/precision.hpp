// Precision by need: the fewest bits whose extra box tests stay within a limit, of the format and then of
// single axes, found by tracing the scene's own rays through the software's integer units, whose answers are
// the datapath's.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "sw_ref/demands/scene_demands.hpp"
#include "sw_ref/experiment/recording.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"

namespace hitpipe::sim {

/// Every ray of an image, and the box tests that a traversal without extra ones takes for them.
struct SceneRays {
  std::vector<ref::RecordedBatch> batches;
  ref::RenderCounts reference;

  [[nodiscard]] std::uint64_t count() const { return reference.total().rays; }
};
[[nodiscard]] SceneRays scene_rays(const ref::Scene& scene, const ref::Bvh& bvh,
                                   const ref::RenderOptions& options);

/// What a scene's own rays were seen to do without.
struct Precision {
  rtl::Format format;
  double extra_box_tests_pct = 0;  ///< of the format alone
  ref::CoarseAxes coarse{};
  double coarse_extra_box_tests_pct = 0;   ///< without the dropped bits too
  bool ends = true;                        ///< box tests hear where rays end
  double endless_extra_box_tests_pct = 0;  ///< if they did not, bits and axes as above
  int formats_measured = 0;                ///< each with its coarse axes, with and without ends
};

/// "1.66 % extra box tests, measured on the scene's rays".
[[nodiscard]] std::string measured_text(double extra_box_tests_pct);

struct PrecisionSearch {
  const rtl::Design* design;
  const ref::Scene* scene;
  const ref::Bvh* bvh;
  const ref::SceneDemands* demands;
  const SceneRays* rays;
  rtl::Format most;
  double overhead_pct = 2.0;
  int threads = 1;
  std::function<void()> measured = [] {};  ///< told after each of them
};

/// Box tests beyond the reference's, in percent of them. Throws std::runtime_error for a design without a
/// software traversal.
[[nodiscard]] double extra_box_tests_pct(const PrecisionSearch& search, const rtl::Format& format,
                                         const ref::CoarseAxes& coarse = {}, bool ends = true);

/// Of the formats up to `most` (Software::up_to) the first group with a format within the limit, and the
/// first of that group: of n/t the fewest n, then the fewest t. By bisection, as more bits never take more
/// tests. Then one low bit of an axis after another, each where it costs the fewest tests, while the limit
/// and the grid allow it. At last the ends of rays, which are all that a design with one format has to lose.
/// Nothing when not even `most`, a format of the design, stays within the limit.
[[nodiscard]] std::optional<Precision> fewest_bits(const PrecisionSearch& search);

}  // namespace hitpipe::sim
