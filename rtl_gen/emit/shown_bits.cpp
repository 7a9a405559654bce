#include "rtl_gen/emit/shown_bits.hpp"

namespace hitpipe::rtl {

ShownBits::ShownBits(const Graph& graph, const std::vector<Port>& ports) : lanes_(graph) {
  for (const NodeId id : graph.inputs()) places_.push_back(index_of(ports, graph[id].name));
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (graph[id].op == Op::constant) continue;
    for (int bit = 0; bit < graph[id].width; ++bit)
      for (const bool value : {false, true}) hidden_.push_back({id, bit, value});
  }
}

std::vector<Vector> ShownBits::new_ones(std::span<const Vector> vectors) {
  std::vector<std::vector<std::int64_t>> operands;
  for (const Vector& vector : vectors) {
    std::vector<std::int64_t>& own = operands.emplace_back();
    for (const std::size_t place : places_) own.push_back(vector.operands[place]);
  }
  lanes_.load(operands);
  std::uint64_t taken = 0;
  std::erase_if(hidden_, [&](const Bit& hidden) {
    const std::uint64_t bit = std::uint64_t{1} << hidden.bit;
    Lanes wrong = lanes_.right(hidden.node);
    for (std::uint64_t& each : wrong) each = hidden.value ? each & ~bit : each | bit;
    const std::uint64_t shown = lanes_.shown_by(hidden.node, wrong);
    if ((shown & taken) == 0) taken |= shown & (~shown + 1);
    return shown != 0;
  });
  std::vector<Vector> chosen;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if ((taken >> i & 1U) != 0) chosen.push_back(vectors[i]);
  return chosen;
}

}  // namespace hitpipe::rtl
