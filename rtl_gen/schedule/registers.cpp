#include "rtl_gen/schedule/registers.hpp"

#include <algorithm>

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::rtl {

Placement place_registers(const Graph& graph, const Schedule& schedule, Ports ports, int interval) {
  const int output_stage = ports == Ports::latched ? schedule.stages + 1 : schedule.stages;
  const auto first_boundary = [&](NodeId id) {
    return graph[id].op == Op::input ? (ports == Ports::latched ? 0 : 1) : schedule.slots[id].finish;
  };
  const auto boundaries = static_cast<std::size_t>(schedule.stages) + 1;
  using BitsByBoundary = std::vector<std::vector<Word>>;  // and by value
  BitsByBoundary live(boundaries, std::vector<Word>(graph.size(), 0));
  BitsByBoundary held = live;
  Placement placed;
  placed.used_bits.assign(graph.size(), 0);

  const auto read = [&](NodeId value, Word bits, int stage) {
    placed.used_bits[value] |= bits;
    for (int b = first_boundary(value); b < stage; b += interval) {
      const auto boundary = static_cast<std::size_t>(b);
      live[boundary][value] |= bits;
      if (interval > 1 && stage > b + 1) held[boundary][value] |= bits;
    }
  };
  // canonical() removed the nodes on which no output depends, so every reader counts.
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (!is_root(graph[id].op)) continue;
    const int stage = schedule.slots[id].stage;
    for_each_source(graph, id, [&](NodeId source, Word bits) { read(source, bits, stage); });
  }
  for (const Output& out : graph.outputs()) {
    for_each_source_of(graph, out.node, [&](NodeId source, Word bits) { read(source, bits, output_stage); });
  }

  for (std::size_t b = 0; b < boundaries; ++b) {
    for (NodeId id = 0; id < graph.size(); ++id) {
      for_each_run(live[b][id], [&](int high, int low) {
        placed.registers.push_back({.value = id,
                                    .boundary = static_cast<int>(b),
                                    .high = high,
                                    .low = low,
                                    .holds = (held[b][id] & bit_range(high, low)) != 0});
      });
    }
  }
  return placed;
}

namespace {

/// For each value, the last stage in which something other than a block reads it; 0 if nothing does.
std::vector<int> last_read_outside(const Graph& graph, const Schedule& schedule, const Block& block,
                                   const Binding& binding) {
  std::vector<int> last(graph.size(), 0);
  // A zero above an operand is no register's, and then Yosys leaves the register outside.
  const auto is_plain = [&](NodeId value) {
    while (graph[value].op == Op::slice || (graph[value].op == Op::extend && graph[value].is_signed))
      value = graph[value].args[0];
    return is_root(graph[value].op);
  };
  const auto read = [&](NodeId value, int stage) {
    for_each_source_of(graph, value,
                       [&](NodeId source, Word) { last[source] = std::max(last[source], stage); });
  };
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    if (!is_root(n.op)) continue;
    for (const NodeId arg : n.operands()) {
      const bool into_block =
          n.op == Op::mul && !binding.shares(id) && (n.is_signed || block.reads_unsigned) && is_plain(arg);
      if (!into_block) read(arg, schedule.slots[id].stage);
    }
  }
  for (const Output& out : graph.outputs()) read(out.node, schedule.stages + 1);
  return last;
}

/// One register in place of the runs of bits behind each block.
void widen_product_registers(Placement& placement, const Graph& graph, const Schedule& schedule,
                             const Binding& binding) {
  std::vector<Register> widened;
  for (const Register& r : placement.registers) {
    const bool behind_block = graph[r.value].op == Op::mul && !binding.shares(r.value) &&
                              schedule.slots[r.value].finish == r.boundary;
    if (!behind_block) {
      widened.push_back(r);
      continue;
    }
    const bool first =
        widened.empty() || widened.back().value != r.value || widened.back().boundary != r.boundary;
    if (first)
      widened.push_back(
          {.value = r.value, .boundary = r.boundary, .high = r.high, .low = 0, .in_block = true});
    Register& whole = widened.back();
    whole.holds |= r.holds;
    whole.unread |= bit_range(r.high, first ? 0 : whole.high + 1) & ~bit_range(r.high, r.low);
    whole.high = r.high;
    placement.used_bits[r.value] |= whole.unread;
  }
  placement.registers = std::move(widened);
}

}  // namespace

void use_block_registers(Placement& placement, const Graph& graph, const Schedule& schedule,
                         const Library& library, const Binding& binding) {
  if (library.chip() == nullptr || !library.chip()->block) return;
  const Block& block = *library.chip()->block;
  if (block.operand_registers) {
    const std::vector<int> outside = last_read_outside(graph, schedule, block, binding);
    // Only the register that the block reads can be in it, not those that hold the value before.
    std::vector<int> last(graph.size(), -1);
    for (const Register& r : placement.registers) last[r.value] = std::max(last[r.value], r.boundary);
    for (Register& r : placement.registers)
      r.in_block = outside[r.value] <= r.boundary && r.boundary == last[r.value];
  }
  if (block.product_registers) widen_product_registers(placement, graph, schedule, binding);
}

}  // namespace hitpipe::rtl
