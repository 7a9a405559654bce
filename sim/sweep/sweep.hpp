// Measures units on a whole scene or a list of rays in it. Each row is a co-simulation with the referee. It
// is priced, and compared with the software traversal and its image.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "area_model/price.hpp"
#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"
#include "rtl_gen/component/library.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/sweep/plan.hpp"
#include "sim/sweep/row.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::sim {

struct SweepOptions {
  int width = 256;
  int height = 256;
  int threads = 1;  ///< rows measured at the same time; no count depends on it
  ref::WhittedOptions light{};
  std::span<const AskedRay> rays{};                       ///< as CosimOptions has them
  std::string program{"hitpipe"};                         ///< the caller's name and version, as rows name it
  std::string hierarchy{};                                ///< how it was made, as rows name it
  const rtl::Library* library = &rtl::Library::thesis();  ///< units are scheduled and priced by it
  bool tests_only = false;                                ///< no set-up and no energy in the cost
  TriangleCost triangle{};                                ///< decides no count
  /// Gets the triangles of CosimResult when a point is measured, from any thread, one at a time.
  std::function<void(const SweepPoint&, std::span<const std::uint32_t> triangles)> answered{};
  /// Gets the finished share of the rows, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
};

/// Why a library cannot price a design, one line; empty when it can.
[[nodiscard]] std::string why_not_priced(const rtl::Design& design, const Format& format,
                                         const rtl::Library& library);

/// A row that holds a unit and its price, and nothing counted.
[[nodiscard]] SweepRow priced_row(const rtl::Design& design, const Format& format, const area::Price& price);
/// Adds the counts of a co-simulation. False hits and misses stay 0 if no referee judged.
void add_counts(SweepRow& row, const CosimResult& result);

/// The cost of a test by the float triangle unit of this library (area_model/triangle_unit.hpp). A library
/// without float components gets an estimate: its first unit of Table 7.2 times what a triangle unit costs
/// more than that unit in the thesis's library. Throws std::runtime_error when it cannot price any.
[[nodiscard]] TriangleCost triangle_cost(const rtl::Library& library);

/// What the divisions of a ray's set-up cost in this library, as far as the design says them.
[[nodiscard]] SetUpCost set_up_cost(const rtl::Design& design, const Format& format,
                                    const rtl::Library& library);

[[nodiscard]] SweepSubject sweep_subject(const ref::Scene& scene, const ref::Bvh& bvh,
                                         const SweepOptions& options);

/// Measures each point, all on the same hierarchy, in an order of its own.  `finished`
/// gets each row as soon as it is known, from any thread, one at a time. Throws what cosimulate() and
/// VerilatedDesign throw; `finished` has then had all rows that were finished before.
void run_sweep(const ref::Scene& scene, const ref::Bvh& bvh, std::span<const SweepPoint> points,
               const SweepOptions& options, const std::function<void(const SweepRow&)>& finished);

}  // namespace hitpipe::sim
