// The traversal of the integer world by Verilog: one unit answers every box test, another one every triangle
// test, and the divider says how far the triangles that are hit lie away and which is nearest. It is a
// ref::Tracer, so the renderer can use it.
#pragma once

#include <cstdint>
#include <memory>

#include "rays/trace/tracer.hpp"
#include "rays/world/int_scene.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/software/triangle_software.hpp"
#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

/// Hits of boxes and triangles are those with HIT; those of the divider are nearer than the best before.
struct WorldCounts {
  UnitCounts boxes, triangles, divisions;
  std::uint64_t rays = 0;
  std::uint64_t different = 0;  ///< rays whose answer is not that of exact integers
  ref::TraceCounts reference;   ///< by software with exact boxes, for the same rays

  WorldCounts& operator+=(const WorldCounts& other);
};

struct WorldUnits {
  const VerilatedDesign* boxes;      ///< a unit for one box or for two, in a format with S
  const VerilatedDesign* triangles;  ///< a triangle unit
  int rays_in_flight = 32;           ///< 1..65536
};

class WorldTracer final : public ref::Tracer {
 public:
  /// The scene must outlive it. It makes the divider, with a place for 32 tests. Throws std::runtime_error,
  /// one line, when the units' formats are not of the scene's world or a unit has no set-up for it, and
  /// std::invalid_argument for the number of rays in flight.
  WorldTracer(const ref::IntScene& scene, const WorldUnits& units);
  ~WorldTracer() override;

  /// Throws WrongHardware when a unit loses a test.
  void trace(const ref::TraceJob& job, ref::TraceCounts& counts) const override;
  [[nodiscard]] std::size_t bytes_per_node() const override;
  [[nodiscard]] std::size_t node_count() const override;

  /// Of all jobs so far.
  [[nodiscard]] WorldCounts counts() const;

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace hitpipe::sim
