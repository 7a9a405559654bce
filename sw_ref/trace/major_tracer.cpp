#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/trace/int_major.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {

std::unique_ptr<Tracer> make_major_tracer(const TracerParts& parts) {
  const hls::MajorBits bits = parts.options.major_bits;
  return std::make_unique<StoreTracer<IntNodes, IntMajorTestMaker>>(
      IntNodes(parts.bvh, bits.coord, {}, bits.finer), IntMajorTestMaker(bits), parts);
}

}  // namespace hitpipe::ref
