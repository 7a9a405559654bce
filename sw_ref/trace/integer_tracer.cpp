#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/trace/int_plucker.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {
namespace {

template <class Maker>
std::unique_ptr<Tracer> tracer(const TracerParts& parts) {
  const hls::IntBits bits = parts.options.bits;
  const CoarseAxes& coarse = parts.options.coarse;
  Maker make_test(bits, coarse);  // first: it checks both
  return std::make_unique<StoreTracer<IntNodes, Maker>>(IntNodes(parts.bvh, bits.coord, coarse), make_test,
                                                        parts);
}

}  // namespace

std::unique_ptr<Tracer> make_integer_tracer(const TracerParts& parts) {
  return is_plucker(parts.options.algorithm) ? tracer<IntPluckerTestMaker>(parts)
                                             : tracer<IntSlabsTestMaker>(parts);
}

}  // namespace hitpipe::ref
