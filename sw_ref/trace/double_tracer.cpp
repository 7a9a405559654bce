#include "sw_ref/hierarchy/double_nodes.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {

std::unique_ptr<Tracer> make_double_tracer(const TracerParts& parts) {
  return float_tracer<double>(DoubleNodes(parts.bvh), parts);
}

}  // namespace hitpipe::ref
