#include "sw_ref/hierarchy/fp_nodes.hpp"
#include "sw_ref/trace/fp_slabs_safe.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {

std::unique_ptr<Tracer> make_any_float_tracer(const TracerParts& parts) {
  const hls::FpBits& bits = parts.options.float_bits;
  return std::make_unique<StoreTracer<FpNodes, FpSlabsSafeTestMaker>>(FpNodes(parts.bvh, bits),
                                                                      FpSlabsSafeTestMaker(bits), parts);
}

}  // namespace hitpipe::ref
