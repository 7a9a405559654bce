#include "sw_ref/hierarchy/hierarchical_nodes.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {

std::unique_ptr<Tracer> make_fine_hierarchical_tracer(const TracerParts& parts) {
  return parts.options.encoding == Encoding::hierarchical_12
             ? any_float_tracer(HierarchicalNodes<12>(parts.bvh), parts)
             : any_float_tracer(HierarchicalNodes<16>(parts.bvh), parts);
}

}  // namespace hitpipe::ref
