#include "rtl_gen/schedule/registers.hpp"

#include <algorithm>
#include <bit>

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::rtl {

Placement place_registers(const Graph& graph, const Schedule& schedule, Ports ports) {
  const int output_stage = ports == Ports::latched ? schedule.stages + 1 : schedule.stages;
  const auto first_boundary = [&](NodeId id) {
    return graph[id].op == Op::input ? (ports == Ports::latched ? 0 : 1) : schedule.slots[id].finish;
  };
  const auto boundaries = static_cast<std::size_t>(schedule.stages) + 1;
  std::vector<std::vector<std::uint64_t>> live(boundaries, std::vector<std::uint64_t>(graph.size(), 0));
  Placement placed;
  placed.used_bits.assign(graph.size(), 0);

  const auto read = [&](NodeId value, std::uint64_t bits, int stage) {
    placed.used_bits[value] |= bits;
    for (int b = first_boundary(value); b < stage; ++b) live[static_cast<std::size_t>(b)][value] |= bits;
  };
  // canonical() removed the nodes on which no output depends, so every reader counts.
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (!is_root(graph[id].op)) continue;
    const int stage = schedule.slots[id].stage;
    for_each_source(graph, id, [&](NodeId source, std::uint64_t bits) { read(source, bits, stage); });
  }
  for (const Output& out : graph.outputs()) {
    for_each_source_of(graph, out.node,
                       [&](NodeId source, std::uint64_t bits) { read(source, bits, output_stage); });
  }

  for (std::size_t b = 0; b < boundaries; ++b) {
    for (NodeId id = 0; id < graph.size(); ++id) {
      std::uint64_t rest = live[b][id];
      while (rest != 0) {
        const int low = std::countr_zero(rest);
        const int high = low + std::countr_one(rest >> low) - 1;
        placed.registers.push_back({.value = id, .boundary = static_cast<int>(b), .high = high, .low = low});
        rest &= ~bit_range(high, low);
      }
    }
  }
  return placed;
}

}  // namespace hitpipe::rtl
