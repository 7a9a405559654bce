#include "area_model/habits.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::area {

namespace {

using rtl::Graph;
using rtl::NodeId;
using rtl::Op;

constexpr std::array<Habits, 4> printed_rows{{
    {.design = "fp_slabs", .input_latches = true, .products_at_n_bits = false, .side_relations_at_t = false},
    {.design = "fp_plucker",
     .input_latches = false,
     .products_at_n_bits = false,
     .side_relations_at_t = false},
    {.design = "int_slabs", .input_latches = true, .products_at_n_bits = true, .side_relations_at_t = false},
    {.design = "int_plucker",
     .input_latches = false,
     .products_at_n_bits = false,
     .side_relations_at_t = true},
}};

/// q - p: a subtractor whose operands are products.
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

const Habits& printed_habits(std::string_view design) {
  const auto found = std::find_if(printed_rows.begin(), printed_rows.end(),
                                  [&](const Habits& h) { return h.design == design; });
  if (found == printed_rows.end()) {
    throw std::runtime_error(fmt::format(
        "design {}: not in Table 7.2, so there is no printed account of it, only the built one", design));
  }
  return *found;
}

int printed_latch_bits(const Graph& graph, const rtl::Register& latch, rtl::Format format,
                       const Habits& habits) {
  const bool product = habits.products_at_n_bits && graph[latch.value].op == Op::mul;
  return product ? std::min(latch.width(), format.bits().coord) : latch.width();
}

int printed_component_bits(const Graph& graph, NodeId node, rtl::Format format, const Habits& habits) {
  if (habits.side_relations_at_t && (is_side_relation(graph, node) || compares_side_relation(graph, node)))
    return format.bits().interval;
  return rtl::component_of(graph, node).bits;
}

}  // namespace hitpipe::area
