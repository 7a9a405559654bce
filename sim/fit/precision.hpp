// Finds the fewest bits whose extra box tests stay within a limit: first for the format, then for single
// axes. It traces the scene's own rays with software traversals that answer as the datapath does.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "rays/world/coarse_axes.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sw_ref/quantise/scene_demands.hpp"
#include "sw_ref/render/recording.hpp"

namespace hitpipe::sim {

/// A format of the design, and its cost on the scene's rays.
struct CostedFormat {
  Format format;
  double cost;
};

/// What the scene's own rays do not need, as measured.
struct Precision {
  Format format;
  double extra_box_tests_pct = 0;  ///< with this format alone
  double extra_triangle_tests_pct = 0;
  ref::CoarseAxes coarse{};
  double coarse_extra_box_tests_pct = 0;  ///< with this format and coarse axes
  bool ends = true;                       ///< the unit knows where rays end
  /// With this format and these axes, all rays endless. Nothing when no operand says that a ray is endless.
  std::optional<double> endless_extra_box_tests_pct{};
  int formats_measured = 0;  ///< each with its coarse axes, with and without ends
  /// Of a search for the least cost: where it began, `most` first.
  std::vector<CostedFormat> starts{};
  double cost = 0;  ///< of that search's result; none of the starts has less
};

/// "1.66 % extra box tests, measured on the scene's rays".
[[nodiscard]] std::string measured_text(double extra_box_tests_pct);

/// What a unit of that precision costs for the tests that it makes on the scene's rays.
using PrecisionCost = std::function<double(const Precision& precision, const ref::TraceCounts& tests)>;

/// Format, low bits that are dropped, whether the unit knows where rays end.
using PrecisionKey = std::tuple<FormatNumbers, std::array<int, 3>, bool>;

struct PrecisionSearch {
  const rtl::Design* design;
  const ref::Scene* scene;
  const ref::Bvh* bvh;
  const ref::SceneDemands* demands;
  const ref::Recording* rays;  ///< by a traversal without extra tests
  Format most;
  double overhead_pct = 2.0;
  PrecisionCost cost{};  ///< if there is one, its least decides, and the limit only says where to begin
  bool limited = false;  ///< with a cost: the limit holds nevertheless
  bool far = false;      ///< with a cost: looks at formats beyond the neighbours too
  int threads = 1;
  std::function<void()> measured = [] {};  ///< called after each measurement
  /// What was measured, also for copies of this search.
  std::shared_ptr<std::map<PrecisionKey, ref::TraceCounts>> known =
      std::make_shared<std::map<PrecisionKey, ref::TraceCounts>>();
};

/// Box tests beyond the reference's, in percent of the reference's. Throws std::runtime_error for a design
/// without a software traversal.
[[nodiscard]] double extra_box_tests_pct(const PrecisionSearch& search, const Format& format,
                                         const ref::CoarseAxes& coarse = {}, bool ends = true);

/// Searches the groups of formats up to `most` (Software::up_to). Takes the first group that has a format
/// within the limit, then the first such format of the group: for n/t the fewest n, then the fewest t. It
/// searches by bisection, because more bits never need more tests. Then it drops one low bit of an axis after
/// another, each time where that costs the fewest tests, as long as the limit and the grid allow it. At last
/// it tries to drop the ends of rays. A design with one format can lose only these. Returns nothing when even
/// `most`, which must be a format of the design, is not within the limit.
///
/// With a cost, the search begins at several formats: `most`, the format that is found so, and up to `most` the
/// design's default and the formats in which it is studied. From each it goes to neighbours in the group and in
/// the next two groups on each side, as long as the cost falls, and the least of all is taken. A low bit of an axis is
/// dropped, and so are the ends of rays, if that lowers the cost. Unless it is limited, there is a result.
[[nodiscard]] std::optional<Precision> fewest_bits(const PrecisionSearch& search);

}  // namespace hitpipe::sim
