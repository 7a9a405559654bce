// What a core (docs/core.md) is asked about a ray, and what it answers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hls/machines/channels.hpp"
#include "hls/machines/failure.hpp"
#include "hls/machines/weights.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/int_triangle.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

struct CoreJob {
  ref::Ray ray;
  bool any = false;   ///< any hit will do
  bool none = false;  ///< the core is told that it is no ray
  /// Of a core with questions: the next crossing that is not before `from_t` and `from_number`, or with `any` the
  /// count of crossings.
  bool once = false;
  std::int64_t from_t = 0;
  std::uint32_t from_number = 0;
};
/// What int_triangle says of the hit (hls/world/triangle_operands.hpp).
struct CoreWeights {
  ref::Int128 det = 0, u = 0, v = 0;
};
struct CoreAnswer {
  ref::IntHit hit;  ///< t is the ray's length where nothing is hit
  hls::Failure failed = hls::not_failed;
  std::optional<CoreWeights> weights{};  ///< of a core that gives them
};

/// Rays may want crossings.
[[nodiscard]] inline bool has_questions(const rtl::Core& core) {
  return core.place_of(hls::channels::ray_once).has_value();
}
/// Answers say where in its triangle a ray hits.
[[nodiscard]] inline bool has_weights(const rtl::Core& core) {
  return core.place_of(hls::weights::HitDet::high).has_value();
}

/// The job's ray as the core is given it: the ports ray_any to ray_length or ray_len, in their order. Throws
/// as ref::int_ray() does where the core takes integers. What is none has a length of NaN where it takes floats.
[[nodiscard]] std::vector<rtl::Word> ray_fields(const rtl::Core& core, const CoreJob& job);

}  // namespace hitpipe::sim
