// A ray unit: a Verilated box-test pipeline whose HIT steers the walks of many rays at once.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "rays/mesh/mesh.hpp"
#include "rays/tree/bvh.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/cosim/station.hpp"
#include "sim/cosim/walk.hpp"
#include "sim/software/feed.hpp"
#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

/// A ray on its way through the unit; `id` is the caller's.
struct RayJob {
  ref::Ray ray;
  ref::Query query = ref::Query::closest;
  std::uint32_t id = 0;
};

/// What became of it.
struct RayAnswer {
  ref::Hit hit;
  std::uint64_t box_tests = 0, triangle_tests = 0;
};

class RayUnit {
 public:
  struct Options {
    const VerilatedDesign* verilated;
    rtl::Evaluate evaluate;  ///< as in StationSoftware, and so is the next
    std::optional<rtl::Evaluate> on_float_unit{};
    const SceneFeed* feed;
    const ref::Bvh* bvh;
    const ref::Mesh* mesh;
    int rays_in_flight;  ///< 1..Station::most_rays
    bool referee;        ///< exact arithmetic judges every answer
  };

  /// Throws as Station does.
  explicit RayUnit(const Options& options);

  /// Runs until `next` has no more rays and all have ended. `ended` may make new rays for `next` to hand out.
  /// Throws WrongHardware when the Verilog loses a box test.
  void run(const std::function<std::optional<RayJob>()>& next,
           const std::function<void(const RayJob&, const RayAnswer&)>& ended);

  [[nodiscard]] UnitCounts counts() const;
  [[nodiscard]] double rtl_seconds() const { return station_.rtl_seconds(); }

 private:
  template <class Walk>
  class World;

  Options options_;
  Station station_;
  std::unique_ptr<RayFeed> rays_;
  UnitCounts judged_;  ///< what the station does not count
};

}  // namespace hitpipe::sim
