#include "area_model/mapped_tables.hpp"

#include <algorithm>
#include <vector>

#include "area_model/gate_network.hpp"
#include "area_model/mapped_registers.hpp"
#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::area {

namespace {

using rtl::Component;
using rtl::Graph;
using rtl::Node;
using rtl::NodeId;
using rtl::Op;
using rtl::Word;
using Signal = GateNetwork::Signal;
using Bits = std::vector<Signal>;

/// The bits of a graph as gates.
class Mapper {
 public:
  Mapper(const Graph& graph, const rtl::SharedSchedule& shared, const rtl::Placement& placement,
         const rtl::Chip& chip)
      : graph_(graph), shared_(shared), placement_(placement), chip_(chip), made_(graph.size()) {}

  MappedCells cells() {
    for (NodeId id = 0; id < graph_.size(); ++id) {
      if (!rtl::is_root(graph_[id].op)) continue;
      if (graph_[id].op == Op::input || placement_.used_bits[id] == 0) {
        made_[id] = leaves(graph_[id].width);
      } else {
        made_[id] = shared_.binding.shares(id) ? shared_operation(id) : operation(id);
      }
    }
    for (const rtl::Register& r : placement_.registers) {
      for (const rtl::Passing& in : r.values()) {
        if (graph_[in.value].op != Op::input && shared_.schedule.slots[in.value].finish == in.boundary)
          leaves_here(in.value, rtl::bit_range(r.high, r.low));
      }
    }
    for (const rtl::Output& output : graph_.outputs()) {
      rtl::for_each_source_of(graph_, output.node,
                              [&](NodeId source, Word bits) { leaves_here(source, bits); });
    }
    for (const auto& [instance, operations] : shared_.binding.instances()) add_instance(operations);
    const std::vector<int> tables = network_.tables(chip_.lut_inputs, static_cast<int>(owners_.size()));
    for (std::size_t i = 0; i < owners_.size(); ++i) cells_[owners_[i]].luts += tables[i];
    return cells_;
  }

 private:
  Bits leaves(int width) {
    Bits bits;
    for (int i = 0; i < width; ++i) bits.push_back(network_.leaf());
    return bits;
  }

  /// Bits of a value are latched, or leave.
  void leaves_here(NodeId value, Word bits) {
    for (int i = 0; i < graph_[value].width; ++i)
      if ((bits >> i & 1) != 0) network_.reads(made_[value][static_cast<std::size_t>(i)]);
  }

  void leave(const Bits& bits) {
    for (const Signal bit : bits) network_.reads(bit);
  }

  /// What a reader in this stage gets of a value.
  Bits read(NodeId value, int stage) {
    const Node& n = graph_[value];
    const auto operand = [&](std::size_t i) { return read(n.args[i], stage); };
    Bits bits;
    switch (n.op) {
      case Op::constant:
        for (int i = 0; i < n.width; ++i)
          bits.push_back((n.value >> i & 1) != 0 ? GateNetwork::one : GateNetwork::zero);
        return bits;
      case Op::slice:
        bits = operand(0);
        return {bits.begin() + n.low, bits.begin() + n.low + n.width};
      case Op::concat: {
        bits = operand(1);
        const Bits high = operand(0);
        bits.insert(bits.end(), high.begin(), high.end());
        return bits;
      }
      case Op::extend:
        bits = operand(0);
        bits.resize(static_cast<std::size_t>(n.width), n.is_signed ? bits.back() : GateNetwork::zero);
        return bits;
      case Op::invert:
        bits = operand(0);
        for (Signal& bit : bits) bit ^= 1U;
        return bits;
      default:
        break;
    }
    const rtl::Slot& slot = shared_.schedule.slots[value];
    if (!slot.latched && n.op != Op::input && slot.finish >= stage) return made_[value];
    const auto [latched, is_new] = latched_.try_emplace({value, stage});
    if (is_new) latched->second = leaves(n.width);
    return latched->second;
  }

  Bits operation(NodeId id) {
    const Node& n = graph_[id];
    std::vector<Bits> operands;
    for (const NodeId arg : n.operands()) operands.push_back(read(arg, shared_.schedule.slots[id].stage));
    if (n.op == Op::mul || n.op == Op::call) {
      for (const Bits& operand : operands) leave(operand);
      return leaves(n.width);
    }
    begin(id);
    return logic(id, operands);
  }

  /// Its operands are selected and latched.
  Bits shared_operation(NodeId id) {
    const Node& n = graph_[id];
    for (const NodeId arg : n.operands()) leave(read(arg, shared_.schedule.slots[id].stage));
    return leaves(n.width);
  }

  void begin(NodeId id) {
    const Part part = is_component(graph_[id].op)
                          ? Part{component_of(graph_, id).component, component_of(graph_, id).bits}
                          : Part{Component::gate, graph_[id].width};
    begin(shared_.schedule.slots[id].stage, part);
  }
  void begin(int stage, const Part& part) {
    network_.begin_owner(static_cast<int>(owners_.size()));
    owners_.emplace_back(stage, part);
  }

  Bits logic(NodeId id, const std::vector<Bits>& operands) {
    const Node& n = graph_[id];
    const Word used = placement_.used_bits[id];
    const Bits &a = operands[0], &b = operands[1];
    switch (n.op) {
      case Op::add:
      case Op::sub:
        return sum(a, b, n.op == Op::sub, rtl::width_of_bits(used));
      case Op::less:
        return {less(a, b, n.is_signed)};
      case Op::equal: {
        Signal same = GateNetwork::one;
        for (std::size_t i = 0; i < a.size(); ++i)
          same = network_.both(same, network_.differ(a[i], b[i]) ^ 1U);
        return {same};
      }
      default:
        break;
    }
    Bits bits;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n.width); ++i) {
      if ((used >> i & 1) == 0)
        bits.push_back(GateNetwork::zero);
      else if (n.op == Op::mux)
        bits.push_back(network_.select(a[0], b[i], operands[2][i]));
      else if (n.op == Op::bit_xor)
        bits.push_back(network_.differ(a[i], b[i]));
      else
        bits.push_back(n.op == Op::bit_and ? network_.both(a[i], b[i]) : network_.either(a[i], b[i]));
    }
    return bits;
  }

  /// The operands of a carry chain whose tables take no logic before it.
  void add_chain(const Bits& a, const Bits& b, bool subtracts) {
    const bool inverts = subtracts && chip_.subtrahend_delay_ps > 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      network_.reads_as_is(a[i]);
      network_.reads_as_is(inverts ? b[i] ^ 1U : b[i]);
    }
  }

  Bits sum(const Bits& a, const Bits& b, bool subtracts, int width) {
    Bits bits = leaves(static_cast<int>(a.size()));
    std::size_t low = 0;
    const auto end = static_cast<std::size_t>(width);
    for (; low < end && b[low] == GateNetwork::zero; ++low) bits[low] = a[low];
    for (; !subtracts && low < end && a[low] == GateNetwork::zero; ++low) bits[low] = b[low];
    if (!chip_.carry_takes_logic) {
      add_chain({a.begin() + static_cast<std::ptrdiff_t>(low), a.begin() + width},
                {b.begin() + static_cast<std::ptrdiff_t>(low), b.begin() + width}, subtracts);
      cells_[owners_.back()].luts += static_cast<std::int64_t>(end - low);
      return bits;
    }
    for (std::size_t i = low; i < end; ++i) {
      network_.reads(a[i]);
      network_.reads(network_.differ(a[i], b[i]));
    }
    return bits;
  }

  Signal less(const Bits& a, const Bits& b, bool is_signed) {
    const std::size_t width = a.size();
    const auto is_constant = [](Signal s) { return s <= GateNetwork::one; };
    if (is_signed && std::all_of(b.begin(), b.end(), [](Signal s) { return s == GateNetwork::zero; }))
      return a.back();
    if (!chip_.carry_takes_logic) {
      add_chain(a, b, true);
      return network_.leaf();
    }
    // As Yosys has it: a carry chain's bit for as many bits as a table reads, from the top down. It says
    // whether they are the same, and whether b has the greater ones.
    Signal same = GateNetwork::one, greater = GateNetwork::zero;
    int left = chip_.lut_inputs, chunks = 0;
    for (std::size_t i = width; i-- > 0;) {
      const int cost = (is_constant(a[i]) ? 0 : 1) + (is_constant(b[i]) ? 0 : 1);
      if (cost > left) {
        network_.reads(same);
        network_.reads(greater);
        same = GateNetwork::one;
        greater = GateNetwork::zero;
        left = chip_.lut_inputs;
        ++chunks;
      }
      left -= cost;
      const bool turned = is_signed && i == width - 1;
      const Signal here = turned ? network_.both(a[i], b[i] ^ 1U) : network_.both(a[i] ^ 1U, b[i]);
      greater = network_.either(greater, network_.both(same, here));
      same = network_.both(same, network_.differ(a[i], b[i]) ^ 1U);
    }
    if (chunks == 0) return greater;
    network_.reads(same);
    network_.reads(greater);
    return network_.leaf();
  }

  /// A component that operations share, and the multiplexers of its operands.
  void add_instance(const std::vector<NodeId>& operations) {
    const Node& first = graph_[operations.front()];
    int stage = shared_.schedule.stages;
    for (const NodeId id : operations) stage = std::min(stage, shared_.schedule.slots[id].stage);
    const rtl::RegisterTable registers(placement_, shared_.binding.interval);
    std::vector<Bits> operands;
    for (std::size_t place = 0; place < first.operands().size(); ++place) {
      const int width = graph_[first.args[place]].width;
      if (!is_selected(graph_, operations, place)) {
        operands.push_back(read(first.args[place], stage));
        continue;
      }
      operands.push_back(leaves(width));
      cells_[{stage, {Component::latch, width}}].registers += width;
      begin(stage, {Component::mux2, width});
      select(width, selected_values(graph_, shared_, registers, operations, place));
    }
    if (first.op == Op::mul || first.op == Op::call) return;
    begin(operations.front());
    owners_.back().first = stage;
    leave(logic(operations.front(), operands));
  }

  void select(int width, int values) {
    std::vector<Bits> left;
    for (int i = 0; i < values; ++i) left.push_back(leaves(width));
    while (left.size() > 1) {
      const Signal which = network_.leaf();
      std::vector<Bits> chosen;
      for (std::size_t i = 0; i + 1 < left.size(); i += 2) {
        Bits& bits = chosen.emplace_back();
        for (std::size_t bit = 0; bit < left[i].size(); ++bit)
          bits.push_back(network_.select(which, left[i][bit], left[i + 1][bit]));
      }
      if (left.size() % 2 == 1) chosen.push_back(left.back());
      left = std::move(chosen);
    }
    leave(left.front());
  }

  const Graph& graph_;
  const rtl::SharedSchedule& shared_;
  const rtl::Placement& placement_;
  const rtl::Chip& chip_;
  GateNetwork network_;
  std::vector<Bits> made_;  ///< by node
  std::map<std::pair<NodeId, int>, Bits> latched_;
  std::vector<std::pair<int, Part>> owners_;
  MappedCells cells_;
};

}  // namespace

MappedCells mapped_cells(const Graph& graph, const rtl::SharedSchedule& shared,
                         const rtl::Placement& placement, const rtl::Chip& chip) {
  MappedCells cells = Mapper(graph, shared, placement, chip).cells();
  for (const auto& [key, taken] : mapped_registers(graph, shared, placement, chip)) cells[key] += taken;
  return cells;
}

}  // namespace hitpipe::area
