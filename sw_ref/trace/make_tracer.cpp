#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/quantise/ray_check.hpp"
#include "sw_ref/trace/tracer_kinds.hpp"

namespace hitpipe::ref {
namespace {

void allow(bool possible, const char* message) {
  if (!possible) throw std::invalid_argument(message);
}

void check(const Bvh& bvh, const TracerOptions& options) {
  const bool plucker = options.algorithm == Algorithm::plu || options.algorithm == Algorithm::plu_dsa;
  const bool by_distance = options.algorithm == Algorithm::slabs_dist;
  const bool major = options.arithmetic == Arithmetic::major;
  const bool any_float = options.arithmetic == Arithmetic::any_float;
  const bool integer = options.arithmetic == Arithmetic::integer || major;
  const bool few_bits =
      options.encoding == Encoding::hierarchical_4 || options.encoding == Encoding::hierarchical_8;
  allow(!bvh.nodes.empty(), "tracer: the hierarchy has no node; build it first");
  allow(!plucker || options.arithmetic != Arithmetic::robust,
        "tracer: robust arithmetic is for slabs; with Pluecker take binary32 or binary64");
  allow(!major || !plucker, "tracer: a major axis is for slabs; take slabs or slabs_dsa");
  allow(!any_float || !plucker, "tracer: floats of any width are for slabs; take slabs or slabs_dsa");
  const bool pairs = options.encoding == Encoding::pairs;
  allow(!pairs || (major && options.algorithm == Algorithm::slabs_dsa && options.ends),
        "tracer: records of two boxes are for a major axis, slabs_dsa and rays with ends");
  allow(!integer || !by_distance,
        "tracer: integer units give no distance; with integers take slabs, slabs_dsa, plu or plu_dsa");
  allow(!any_float || !by_distance, "tracer: floats of any width give no distance; take slabs or slabs_dsa");
  allow(!integer || options.encoding == Encoding::plain || pairs,
        "tracer: integer arithmetic has nodes of its own; take the plain encoding");
  allow(!any_float || options.encoding == Encoding::plain,
        "tracer: floats of any width have nodes of their own; take the plain encoding");
  allow(!options.look_up_table || few_bits,
        "tracer: a look-up table is for hierarchical nodes of 4 or 8 bits");
  if (options.bundle != 1 && options.bundle != 64 && options.bundle != 256) {
    throw std::invalid_argument(
        fmt::format("tracer: bundles of {} rays; allowed are 1, 64 and 256", options.bundle));
  }
  allow(options.bundle == 1 || !by_distance,
        "tracer: the order by distance is of single rays; take bundle 1");
  allow(options.bundle == 1 || !integer, "tracer: integer units take single rays; take bundle 1");
  allow(options.bundle == 1 || !any_float, "tracer: floats of any width take single rays; take bundle 1");
  allow((integer && !major) || !options.coarse.any(), "tracer: coarse axes are of integer arithmetic");
  allow(options.ends || (options.bundle == 1 && !by_distance),
        "tracer: the order by distance and bundles need the ends of rays; take bundle 1 and another order");
  if (major && !options.major_bits.valid()) {
    const hls::MajorBits& bits = options.major_bits;
    throw std::invalid_argument(fmt::format("tracer: there is no format {}+{}/{}f{}", bits.coord, bits.finer,
                                            bits.mantissa, bits.fraction));
  }
  if (any_float && !options.float_bits.valid()) {
    throw std::invalid_argument(fmt::format("tracer: there is no format e{}m{}", options.float_bits.exponent,
                                            options.float_bits.fraction));
  }
  if (!integer || major) return;
  check_format(options.bits, "tracer");
  check_coarse(options.coarse, options.bits.coord, "tracer");
}

}  // namespace

void check_places(const TraceJob& job) {
  allow(job.triangles.size() == job.rays.size() && (job.work.empty() || job.work.size() == job.rays.size()),
        "tracer: places for answers and work must be as many as the rays");
}

std::unique_ptr<Tracer> make_tracer(const Mesh& mesh, const Bvh& bvh, const TracerOptions& options) {
  check(bvh, options);
  const TracerParts parts{mesh, bvh, options};
  switch (options.encoding) {
    case Encoding::hierarchical_4:
    case Encoding::hierarchical_8:
      return make_hierarchical_tracer(parts);
    case Encoding::hierarchical_12:
    case Encoding::hierarchical_16:
      return make_fine_hierarchical_tracer(parts);
    case Encoding::pairs:
      return make_major_pair_tracer(parts);
    case Encoding::plain:
      break;
  }
  switch (options.arithmetic) {
    case Arithmetic::integer:
      return make_integer_tracer(parts);
    case Arithmetic::major:
      return make_major_tracer(parts);
    case Arithmetic::any_float:
      return make_any_float_tracer(parts);
    case Arithmetic::binary64:
      return make_double_tracer(parts);
    case Arithmetic::binary32:
    case Arithmetic::robust:
      break;
  }
  return make_plain_tracer(parts);
}

}  // namespace hitpipe::ref
