// The tracers of each node encoding. Each encoding has a file of template instances, so that they compile
// separately.
#pragma once

#include <memory>

#include "sw_ref/trace/tracer.hpp"

namespace hitpipe::ref {

struct TracerParts {
  const Mesh& mesh;
  const Bvh& bvh;
  TracerOptions options;  ///< a combination that exists
};

/// Throws std::invalid_argument unless there are as many places for answers, and for work if any, as rays.
void check_places(const TraceJob& job);

[[nodiscard]] std::unique_ptr<Tracer> make_plain_tracer(const TracerParts& parts);
[[nodiscard]] std::unique_ptr<Tracer> make_double_tracer(const TracerParts& parts);
[[nodiscard]] std::unique_ptr<Tracer> make_integer_tracer(const TracerParts& parts);
[[nodiscard]] std::unique_ptr<Tracer> make_major_tracer(const TracerParts& parts);
[[nodiscard]] std::unique_ptr<Tracer> make_any_float_tracer(const TracerParts& parts);
[[nodiscard]] std::unique_ptr<Tracer> make_major_pair_tracer(const TracerParts& parts);
/// 4 or 8 bits, with or without look-up table.
[[nodiscard]] std::unique_ptr<Tracer> make_hierarchical_tracer(const TracerParts& parts);
/// 12 or 16 bits.
[[nodiscard]] std::unique_ptr<Tracer> make_fine_hierarchical_tracer(const TracerParts& parts);

}  // namespace hitpipe::ref
