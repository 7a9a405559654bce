#include <algorithm>
#include <bit>
#include <set>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/chaining.hpp"
#include "rtl_gen/schedule/divided_unit.hpp"
#include "rtl_gen/schedule/sharing.hpp"

namespace hitpipe::rtl {

namespace {

/// What one component must be able to do for an operation.
using OperationShape = std::tuple<Op, int, bool, int, std::vector<int>>;

OperationShape shape_of(const Graph& graph, NodeId id) {
  const Node& n = graph[id];
  std::vector<int> widths;
  for (const NodeId arg : n.operands()) widths.push_back(graph[arg].width);
  return {n.op, n.width, n.is_signed, n.submodule, widths};
}

[[noreturn]] void refuse_sharing(const Graph& graph, const std::string& why) {
  throw std::invalid_argument(fmt::format("{}: {}", graph.name(), why));
}

void check_sharing(const SharingProblem& problem) {
  if (problem.interval < 1 || problem.interval > most_interval)
    refuse_sharing(problem.graph,
                   fmt::format("interval {}: allowed is 1 to {}", problem.interval, most_interval));
  std::set<NodeId> seen;
  for (const SharingGroup& group : problem.groups) {
    const auto count = static_cast<std::int64_t>(group.operations.size());
    const std::int64_t most = std::int64_t{group.instances} * problem.interval;
    if (group.instances < 1 || count > most)
      refuse_sharing(problem.graph,
                     fmt::format("{} operations on {} instances: in {} cycles they carry out {}", count,
                                 group.instances, problem.interval, std::max<std::int64_t>(most, 0)));
    for (const NodeId id : group.operations) {
      if (!is_component(problem.graph[id].op) ||
          shape_of(problem.graph, id) != shape_of(problem.graph, group.operations.front()))
        refuse_sharing(problem.graph, fmt::format("operation %{} is not of the kind of its group", id));
      if (!seen.insert(id).second)
        refuse_sharing(problem.graph, fmt::format("operation %{} is in two groups", id));
    }
  }
}

/// For every node, the number of components and gates on the longest way to an output.
std::vector<int> heights(const Graph& graph) {
  std::vector<int> height(graph.size(), 0);
  for (NodeId id = graph.size(); id-- > 0;) {
    const int own = height[id] + (is_root(graph[id].op) ? 1 : 0);
    for (const NodeId arg : graph[id].operands()) height[arg] = std::max(height[arg], own);
  }
  return height;
}

class ModuloList {
 public:
  explicit ModuloList(const SharingProblem& problem)
      : graph_(problem.graph),
        library_(problem.library),
        earliest_(problem.earliest),
        made_{schedule_asap(problem.graph, problem.library, problem.clock_ps), {problem.interval, {}}},
        timing_(graph_, library_, made_.schedule.clock_ps),
        selected_(selected(problem)),
        selection_ps_(selection_ps(library_, selected_)),
        group_of_(graph_.size(), -1) {
    for (const SharingGroup& group : problem.groups) {
      for (const NodeId id : group.operations) group_of_[id] = static_cast<int>(first_instance_.size());
      first_instance_.push_back(static_cast<int>(phases_.size()));
      most_.push_back(most_operations(group, problem.interval));
      phases_.resize(phases_.size() + static_cast<std::size_t>(group.instances));
    }
    first_instance_.push_back(static_cast<int>(phases_.size()));
    reads_.resize(phases_.size());
    if (!phases_.empty() && selection_ps_ + made_.schedule.latch_ps > made_.schedule.clock_ps)
      refuse_sharing(
          graph_, fmt::format("a clock of {} ps is too short to select among {} operands; the smallest "
                              "that can be met is {} ps",
                              made_.schedule.clock_ps, selected_, selection_ps_ + made_.schedule.latch_ps));
    place_all();
    made_.schedule.stages = last_stage(graph_, made_.schedule);
  }
  [[nodiscard]] SharedSchedule take() { return std::move(made_); }

 private:
  /// The most operations of any instance.
  static int selected(const SharingProblem& problem) {
    int most = 1;
    for (const SharingGroup& group : problem.groups)
      most = std::max(most, most_operations(group, problem.interval));
    return most;
  }

  void place_all() {
    std::vector<int> waits(graph_.size(), 0);
    std::vector<std::vector<NodeId>> readers(graph_.size());
    const auto works = [&](NodeId id) { return is_root(graph_[id].op) && graph_[id].op != Op::input; };
    for (NodeId id = 0; id < graph_.size(); ++id) {
      if (!works(id)) continue;
      for_each_source(graph_, id, [&](NodeId source, Word) {
        if (!works(source)) return;
        readers[source].push_back(id);
        ++waits[id];
      });
    }
    const std::vector<int> height = heights(graph_);
    std::set<std::tuple<int, int, NodeId>> ready;
    const auto add = [&](NodeId id) { ready.insert({first_stage_of(id), -height[id], id}); };
    for (NodeId id = 0; id < graph_.size(); ++id)
      if (works(id) && waits[id] == 0) add(id);
    while (!ready.empty()) {
      const NodeId id = std::get<NodeId>(*ready.begin());
      ready.erase(ready.begin());
      place(id);
      for (const NodeId reader : readers[id])
        if (--waits[reader] == 0) add(reader);
    }
  }

  [[nodiscard]] int first_stage_of(NodeId id) const {
    return std::max(earliest_stage(graph_, made_.schedule, id), earliest_.empty() ? 0 : earliest_[id]);
  }

  void place(NodeId id) {
    int stage = first_stage_of(id);
    const Cell cell = timing_(id);
    const bool shares = group_of_[id] >= 0;
    const Op op = graph_[id].op;
    const auto operands = [&] {
      // A shared operand is selected and latched, and inverted only behind the latch.
      return operands_in(graph_, made_.schedule, id, shares ? Cell{} : cell,
                         library_.carry_delay_ps_per_bit(), stage);
    };
    const int first_ps = shares ? operands().all_ps + selection_ps_ : result_of(op, cell, operands()).all_ps;
    if (first_ps + made_.schedule.latch_ps > made_.schedule.clock_ps) ++stage;
    while (shares && !takes(id, stage)) ++stage;
    const Arrival result = shares ? result_of(op, cell) : result_of(op, cell, operands());
    Slot& slot = made_.schedule.slots[id];
    slot.stage = stage;
    slot.latched = cell.stages > 0;
    slot.finish = stage + (shares ? 1 : 0) + std::max(cell.stages, 1) - 1;
    slot.ready_ps = slot.latched ? 0 : result.all_ps;
    slot.low_ps = slot.latched ? 0 : result.low_ps;
  }

  /// Takes an instance that is free in the stage modulo the interval; false: there is none.
  bool takes(NodeId id, int stage) {
    const auto group = static_cast<std::size_t>(group_of_[id]);
    const std::uint64_t phase = std::uint64_t{1} << (stage % made_.binding.interval);
    // No instance gets so many operations that another would have none: its multiplexer would be slower.
    const auto is_free = [&](int i) {
      const std::uint64_t taken = phases_[static_cast<std::size_t>(i)];
      return (taken & phase) == 0 && std::popcount(taken) < most_[group];
    };
    const int end = first_instance_[group + 1];
    int best = first_instance_[group];
    while (best < end && !is_free(best)) ++best;
    if (best == end) return false;
    if (end - first_instance_[group] > 1) {
      // The one that reads most of the same operands already.
      std::vector<std::vector<int>> operands;
      for (std::size_t place = 0; place < graph_[id].operands().size(); ++place)
        operands.push_back(operand(id, place, stage));
      const auto reads_alike = [&](int i) {
        const auto& reads = reads_[static_cast<std::size_t>(i)];
        return std::count_if(operands.begin(), operands.end(),
                             [&](const std::vector<int>& read) { return reads.contains(read); });
      };
      auto most = reads_alike(best);
      for (int i = best + 1; i < end; ++i) {
        if (!is_free(i)) continue;
        const auto alike = reads_alike(i);
        if (alike > most) best = i;
        most = std::max(most, alike);
      }
      for (std::vector<int>& read : operands) reads_[static_cast<std::size_t>(best)].insert(std::move(read));
    }
    phases_[static_cast<std::size_t>(best)] |= phase;
    made_.binding.instance_of[id] = best;
    return true;
  }

  /// The place, the wires, and the values. Results of one component that are new are one: a register behind
  /// it has each of them in its turn.
  [[nodiscard]] std::vector<int> operand(NodeId id, std::size_t place, int stage) const {
    const NodeId arg = graph_[id].args[place];
    std::vector<int> key = wires_to(graph_, arg);
    key.push_back(static_cast<int>(place));
    for_each_source_of(graph_, arg, [&](NodeId source, Word) {
      const auto shared = made_.binding.instance_of.find(source);
      const bool is_new = stage <= made_.schedule.slots[source].finish + 1;
      if (shared != made_.binding.instance_of.end() && is_new)
        key.insert(key.end(), {1, shared->second});
      else
        key.insert(key.end(), {0, static_cast<int>(source)});
    });
    return key;
  }

  const Graph& graph_;
  const Library& library_;
  const std::vector<int>& earliest_;
  SharedSchedule made_;
  NodeTiming timing_;
  int selected_;
  int selection_ps_;
  std::vector<int> group_of_;                      ///< by node; -1: it does not share
  std::vector<int> first_instance_;                ///< by group
  std::vector<int> most_;                          ///< operations of an instance, by group
  std::vector<std::uint64_t> phases_;              ///< by instance: a bit for each phase that is taken
  std::vector<std::set<std::vector<int>>> reads_;  ///< by instance: what it reads at which place
};

}  // namespace

std::vector<SharingGroup> kinds_of(const Graph& graph) {
  std::map<OperationShape, std::vector<NodeId>> by_kind;
  for (NodeId id = 0; id < graph.size(); ++id)
    if (is_component(graph[id].op)) by_kind[shape_of(graph, id)].push_back(id);
  std::vector<SharingGroup> groups;
  for (auto& [kind, operations] : by_kind) {
    const int count = static_cast<int>(operations.size());
    if (count > 1) groups.push_back({std::move(operations), count});
  }
  return groups;
}

std::map<int, std::vector<NodeId>> Binding::instances() const {
  std::map<int, std::vector<NodeId>> all;
  for (const auto& [id, instance] : instance_of) all[instance].push_back(id);
  return all;
}

bool is_selected(const Graph& graph, const std::vector<NodeId>& operations, std::size_t place) {
  const NodeId first = graph[operations.front()].args[place];
  return graph[first].op != Op::constant ||
         !std::all_of(operations.begin(), operations.end(),
                      [&](NodeId id) { return graph[id].args[place] == first; });
}

int selection_ps(const Library& library, int operations) {
  const auto levels = std::bit_width(static_cast<unsigned>(operations - 1));
  return static_cast<int>(levels) * library.timing(Component::mux2, 1).delay_ps;
}

int most_operations(const SharingGroup& group, int interval) {
  // Each instance has one of them at least.
  return std::min(interval, static_cast<int>(group.operations.size()) - group.instances + 1);
}

SharedSchedule schedule_modulo(const SharingProblem& problem) {
  check_sharing(problem);
  SharedSchedule made = ModuloList(problem).take();
  const std::vector<std::string> broken = verify(problem.graph, problem.library, made.schedule, made.binding);
  if (!broken.empty())
    throw std::logic_error(
        fmt::format("{}: illegal shared schedule: {}", problem.graph.name(), fmt::join(broken, "; ")));
  return made;
}

}  // namespace hitpipe::rtl
