#include "sw_ref/hierarchy/hierarchical_nodes.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {

std::unique_ptr<Tracer> make_hierarchical_tracer(const TracerParts& parts) {
  const bool table = parts.options.look_up_table;
  if (parts.options.encoding == Encoding::hierarchical_4) {
    return table ? any_float_tracer(HierarchicalNodes<4, true>(parts.bvh), parts)
                 : any_float_tracer(HierarchicalNodes<4>(parts.bvh), parts);
  }
  return table ? any_float_tracer(HierarchicalNodes<8, true>(parts.bvh), parts)
               : any_float_tracer(HierarchicalNodes<8>(parts.bvh), parts);
}

}  // namespace hitpipe::ref
