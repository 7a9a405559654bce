#include "rtl_gen/schedule/registers.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::rtl {

std::vector<Passing> Register::values() const {
  std::vector<Passing> all{{value, boundary, last}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

bool Register::holds() const {
  const std::vector<Passing> all = values();
  return std::any_of(all.begin(), all.end(), [](const Passing& p) { return p.last > p.boundary + 1; });
}

bool in_one_cycle(const Passing& x, const Passing& y, int interval) {
  // The cycles from one value's first to the other's, modulo the interval.
  const auto after = [&](const Passing& from, const Passing& to) {
    return ((to.boundary - from.boundary) % interval + interval) % interval;
  };
  return x.value != y.value && (after(x, y) < x.last - x.boundary || after(y, x) < y.last - y.boundary);
}

namespace {

/// The bits that one register saves in place of two; 0 or less: they stay two.
int saved_bits(const Register& x, const Register& y, int interval) {
  const std::vector<Passing> of_y = y.values();
  for (const Passing& a : x.values()) {
    for (const Passing& b : of_y)
      if (in_one_cycle(a, b, interval)) return 0;
  }
  return x.width() + y.width() - (std::max(x.high, y.high) - std::min(x.low, y.low) + 1);
}

/// Results of one component share registers where that saves bits. The widest come first, and each joins the
/// register with which it saves most.
void merge_results(Placement& placement, const Schedule& schedule, const Binding& binding) {
  std::map<int, std::vector<std::size_t>> behind;  // by instance
  for (std::size_t i = 0; i < placement.registers.size(); ++i) {
    const Register& r = placement.registers[i];
    if (binding.shares(r.value) && schedule.slots[r.value].finish == r.boundary)
      behind[binding.instance_of.at(r.value)].push_back(i);
  }
  std::vector<bool> gone(placement.registers.size(), false);
  for (auto& [instance, all] : behind) {
    std::stable_sort(all.begin(), all.end(), [&](std::size_t x, std::size_t y) {
      return placement.registers[x].width() > placement.registers[y].width();
    });
    std::vector<std::size_t> kept;
    for (const std::size_t i : all) {
      const Register& r = placement.registers[i];
      std::size_t best = i;
      int most = 0;
      for (const std::size_t k : kept) {
        const int saved = saved_bits(placement.registers[k], r, binding.interval);
        if (saved > most) best = k;
        most = std::max(most, saved);
      }
      if (best == i) {
        kept.push_back(i);
        continue;
      }
      Register& into = placement.registers[best];
      into.others.push_back({r.value, r.boundary, r.last});
      into.high = std::max(into.high, r.high);
      into.low = std::min(into.low, r.low);
      gone[i] = true;
    }
  }
  std::size_t i = 0;
  std::erase_if(placement.registers, [&](const Register&) { return gone[i++]; });
}

}  // namespace

Placement place_registers(const Graph& graph, const Schedule& schedule, Ports ports, const Binding& binding) {
  const int interval = binding.interval;
  const int output_stage = ports == Ports::latched ? schedule.stages + 1 : schedule.stages;
  const auto first_boundary = [&](NodeId id) {
    return graph[id].op == Op::input ? (ports == Ports::latched ? 0 : 1) : schedule.slots[id].finish;
  };
  std::vector<std::vector<std::pair<Word, int>>> reads(graph.size());  // bits and stages, by value
  Placement placed;
  placed.used_bits.assign(graph.size(), 0);

  const auto read = [&](NodeId value, Word bits, int stage) {
    placed.used_bits[value] |= bits;
    reads[value].emplace_back(bits, stage);
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

  for (NodeId id = 0; id < graph.size(); ++id) {
    // The bits that are live at a boundary are those that a later stage reads.
    for (int b = first_boundary(id);; b += interval) {
      Word live = 0;
      for (const auto& [bits, stage] : reads[id])
        if (b < stage) live |= bits;
      if (live == 0) break;
      for_each_run(live, [&](int high, int low) {
        int last = 0;
        for (const auto& [bits, stage] : reads[id])
          if ((bits & bit_range(high, low)) != 0) last = std::max(last, stage);
        placed.registers.push_back(
            {.value = id, .boundary = b, .high = high, .low = low, .last = std::min(last, b + interval)});
      });
    }
  }
  std::stable_sort(placed.registers.begin(), placed.registers.end(),
                   [](const Register& x, const Register& y) { return x.boundary < y.boundary; });
  merge_results(placed, schedule, binding);
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
      widened.push_back({.value = r.value,
                         .boundary = r.boundary,
                         .high = r.high,
                         .low = 0,
                         .in_block = true,
                         .last = r.last});
    Register& whole = widened.back();
    whole.last = std::max(whole.last, r.last);
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
    for (const Register& r : placement.registers)
      for (const Passing& p : r.values()) last[p.value] = std::max(last[p.value], p.boundary);
    for (Register& r : placement.registers) {
      const std::vector<Passing> values = r.values();
      r.in_block = std::all_of(values.begin(), values.end(), [&](const Passing& p) {
        return outside[p.value] <= p.boundary && p.boundary == last[p.value];
      });
    }
  }
  if (block.product_registers) widen_product_registers(placement, graph, schedule, binding);
}

RegisterTable::RegisterTable(const Placement& placement, int interval)
    : placement_(placement), interval_(interval) {
  for (std::size_t i = 0; i < placement.registers.size(); ++i)
    for (const Passing& p : placement.registers[i].values()) held_.push_back({p.value, p.boundary, i});
  std::sort(held_.begin(), held_.end(), [](const Held& x, const Held& y) {
    return std::tuple(x.value, x.boundary, x.at) < std::tuple(y.value, y.boundary, y.at);
  });
}

std::optional<std::size_t> RegisterTable::find(NodeId value, int high, int low, int stage) const {
  // A register holds its value for as many stages as the interval has cycles.
  const int first = std::max(0, stage - interval_);
  auto it = std::lower_bound(held_.begin(), held_.end(), std::pair(value, first),
                             [](const Held& held, const std::pair<NodeId, int>& wanted) {
                               return std::pair(held.value, held.boundary) < wanted;
                             });
  std::optional<std::size_t> found;
  for (; it != held_.end() && it->value == value && it->boundary < stage; ++it) {
    const Register& r = placement_.registers[it->at];
    if (r.low <= low && r.high >= high) found = it->at;
  }
  return found;
}

int selected_values(const Graph& graph, const SharedSchedule& shared, const RegisterTable& registers,
                    const std::vector<NodeId>& operations, std::size_t place) {
  std::set<std::vector<int>> values;  // wires, and the registers or components that they come from
  for (const NodeId id : operations) {
    const NodeId arg = graph[id].args[place];
    std::vector<int> value = wires_to(graph, arg);
    for_each_source_of(graph, arg, [&](NodeId source, Word all) {
      for_each_run(all, [&](int high, int low) {
        const auto found = registers.find(source, high, low, shared.schedule.slots[id].stage);
        const auto instance = shared.binding.instance_of.find(source);
        if (found)
          value.insert(value.end(), {0, static_cast<int>(*found)});
        else if (instance != shared.binding.instance_of.end())
          value.insert(value.end(), {1, instance->second});
        else
          value.insert(value.end(), {2, static_cast<int>(source)});
        value.insert(value.end(), {high, low});
      });
    });
    values.insert(std::move(value));
  }
  return static_cast<int>(values.size());
}

}  // namespace hitpipe::rtl
