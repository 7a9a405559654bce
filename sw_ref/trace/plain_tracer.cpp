#include "sw_ref/hierarchy/plain_nodes.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {

std::unique_ptr<Tracer> make_plain_tracer(const TracerParts& parts) {
  const PlainNodes nodes(parts.bvh);
  if (parts.options.arithmetic == Arithmetic::robust) return store_tracer<RobustSlabs>(nodes, parts);
  return float_tracer<float>(nodes, parts);
}

}  // namespace hitpipe::ref
