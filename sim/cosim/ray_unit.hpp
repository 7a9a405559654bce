// A ray unit: a Verilated box-test pipeline whose HIT steers the traversal of many rays at once. In each
// cycle one ray that does not wait for an answer sends its next box. The tag tells which ray an answer
// belongs to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/cosim/ray_writer.hpp"
#include "sim/cosim/sampled_time.hpp"
#include "sim/cosim/walk.hpp"
#include "sim/feeds/feed.hpp"
#include "sim/unit/verilated_design.hpp"
#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/scene/mesh.hpp"

namespace hitpipe::sim {

/// A ray on its way through the unit; `id` is the caller's.
struct RayJob {
  ref::Ray ray;
  ref::Query query = ref::Query::closest;
  std::uint32_t id = 0;
};

/// Throws std::invalid_argument, one line, when there are not enough slots.
void check_slots(int rays_in_flight, int slots);

class RayUnit {
 public:
  struct Options {
    const VerilatedDesign* verilated;
    rtl::Evaluate evaluate;  ///< the same datapath in C++, bit by bit
    /// The same by the host's floating-point unit. It takes the place of `evaluate` in all tests but one in
    /// bit_level_stride. Nothing: all tests are compared bit by bit.
    std::optional<rtl::Evaluate> on_float_unit{};
    const SceneFeed* feed;
    const ref::Bvh* bvh;
    const ref::Mesh* mesh;
    int rays_in_flight;  ///< 1..most_rays_in_flight, and no more than there are ray slots
    bool referee;        ///< exact arithmetic judges every answer
  };

  static constexpr int most_rays_in_flight = 65'536;  ///< a tag has 16 bits
  /// A prime, so that the tests compared bit by bit are not always of the same rays.
  static constexpr int bit_level_stride = 61;

  /// A ray in flight has the slot of its number when the unit has slots. Throws std::invalid_argument, one
  /// line, for a number of rays in flight that is not allowed.
  explicit RayUnit(const Options& options);

  /// Runs until `next` has no more rays and all have ended. `ended` may make new rays for `next` to hand out.
  /// Throws WrongHardware when the Verilog loses a box test.
  void run(const std::function<std::optional<RayJob>()>& next,
           const std::function<void(const RayJob&, const ref::Hit&)>& ended);

  [[nodiscard]] const UnitCounts& counts() const { return counts_; }
  /// Time for the cycles of the Verilog alone, estimated from samples (sim/cosim/sampled_time.hpp).
  [[nodiscard]] double rtl_seconds() const { return rtl_time_.seconds(); }

 private:
  template <class Walk>
  struct Slot {
    RayJob job;
    std::optional<typename Walk::Traversal> traversal;
    /// Results by the C++ datapath for the test on its way.
    std::array<std::int64_t, rtl::Evaluate::most_results> expected{};
    std::uint64_t turn = 0;  ///< tests that were sent before it; answers keep their order
    bool waiting = false;    ///< for an answer
  };

  template <class Walk>
  void walk(const Walk& walk, const std::function<std::optional<RayJob>()>& next,
            const std::function<void(const RayJob&, const ref::Hit&)>& ended);
  template <class Walk>
  void receive(const Walk& walk, std::size_t number, Slot<Walk>& slot, bool in_turn);

  Options options_;
  Model model_;
  std::unique_ptr<RayFeed> rays_;
  std::optional<RayWriter> writer_;  // of a unit with ray slots
  std::vector<std::int64_t> operands_;
  std::vector<std::int64_t> results_;  ///< of the Verilog
  UnitCounts counts_;
  SampledTime<> rtl_time_;
};

}  // namespace hitpipe::sim
