#include "area_model/thesis_accounting.hpp"

#include <algorithm>

#include "hls/box/int_format.hpp"
#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::area {

namespace {

using rtl::Graph;
using rtl::NodeId;
using rtl::Op;

/// q - p: a subtractor fed by multipliers.
bool is_side_relation(const Graph& graph, NodeId node) {
  if (graph[node].op != Op::sub) return false;
  bool products = true;
  rtl::for_each_source(graph, node,
                       [&](NodeId source, std::uint64_t) { products &= graph[source].op == Op::mul; });
  return products;
}

bool compares_side_relation(const Graph& graph, NodeId node) {
  if (graph[node].op != Op::less) return false;
  bool compares = false;
  rtl::for_each_source(graph, node,
                       [&](NodeId source, std::uint64_t) { compares |= is_side_relation(graph, source); });
  return compares;
}

}  // namespace

int printed_latch_bits(const Graph& graph, const rtl::Register& latch, const rtl::Format& format,
                       const rtl::Printed& printed) {
  const bool product = printed.products_at_n_bits && graph[latch.value].op == Op::mul;
  return product ? std::min(latch.width(), format.as<hls::IntBits>().coord) : latch.width();
}

int printed_component_bits(const Graph& graph, NodeId node, const rtl::Format& format,
                           const rtl::Printed& printed) {
  if (printed.side_relations_at_t && (is_side_relation(graph, node) || compares_side_relation(graph, node)))
    return format.as<hls::IntBits>().interval;
  return rtl::component_of(graph, node).bits;
}

}  // namespace hitpipe::area
