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
  hls::IntBits bits;               ///< of an integer design
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
  hls::IntBits most{24, 24};  ///< of an integer design
  double overhead_pct = 2.0;
  int threads = 1;
  std::function<void()> measured = [] {};  ///< told after each of them
};

/// Box tests beyond the reference's, in percent of them. Floats have neither bits nor axes to choose.
[[nodiscard]] double extra_box_tests_pct(const PrecisionSearch& search, hls::IntBits bits,
                                         const ref::CoarseAxes& coarse = {}, bool ends = true);

/// The fewest coordinate bits n, then the fewest interval bits t, with n and t no more than `most`'s, that
/// stay within the limit; bisection, as tests get fewer with n and with t. Then one low bit of an axis after
/// another, each where it costs the fewest tests, while the limit and the grid allow it. At last the ends of
/// rays, which are all that a float design has to lose. Nothing when not even `most` stays within the limit.
/// `most` must be a format of the design.
[[nodiscard]] std::optional<Precision> fewest_bits(const PrecisionSearch& search);

}  // namespace hitpipe::sim
