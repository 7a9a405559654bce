// Operations that share components, in a unit that takes a test every `interval` cycles.
//
// The problem (SharingProblem): a graph, a component library, an interval, and groups of operations with the
// number of components that each group may use. A solution (SharedSchedule) is a schedule and a Binding: for
// each operation of a group the component, called instance, that carries it out. verify() checks the rules of
// schedule.hpp and these:
//   7. An operation that shares reads its operands in its first stage. A multiplexer selects them among those
//      of the other operations, and they are latched at the end of that stage. The component works in the
//      stages after it. So its operands come out of latches, and no loop of logic can close through two
//      instances that work for one another.
//   8. Operations of one instance are of one kind: one component with the same widths and signs could carry
//      out each of them.
//   9. Two operations of one instance never start in the same stage modulo the interval.
// An instance has stages of its own where the library says so; it takes operands in every cycle.
#pragma once

#include <bit>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

inline constexpr int most_interval = 64;

/// Width of the counter that says which cycle of the interval it is; 0 if a test can begin in every cycle.
[[nodiscard]] constexpr int phase_bits(int interval) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(interval - 1)));
}

/// Operations, by their nodes, and on how many components they run.
struct SharingGroup {
  std::vector<NodeId> operations;
  int instances = 1;
};

struct SharingProblem {
  const Graph& graph;
  const Library& library;
  int interval = 1;
  std::vector<SharingGroup> groups{};  ///< an operation is in one group at most; in none: it does not share
  std::optional<int> clock_ps{};       ///< nothing: the period of schedule_asap()
  std::vector<int> earliest{};         ///< by node: the first stage in which it may start; empty: any
};

struct Binding {
  int interval = 1;
  /// By node; an operation that is not here has a component of its own. Instances are numbered from 0, over
  /// all groups.
  std::map<NodeId, int> instance_of{};

  [[nodiscard]] bool shares(NodeId id) const { return instance_of.contains(id); }
  /// The operations of each instance.
  [[nodiscard]] std::map<int, std::vector<NodeId>> instances() const;
};

/// Whether the operations' operand at this place is selected and latched: a constant that all read is not.
[[nodiscard]] bool is_selected(const Graph& graph, const std::vector<NodeId>& operations, std::size_t place);

struct SharedSchedule {
  Schedule schedule;
  Binding binding;
};

/// The operations of a graph that components can carry out in turn, in groups of one kind with at least two
/// operations. `instances` is the number of operations.
[[nodiscard]] std::vector<SharingGroup> kinds_of(const Graph& graph);

/// The delay of the multiplexer before an instance that carries out so many operations.
[[nodiscard]] int selection_ps(const Library& library, int operations);

/// The most operations that one instance of the group may carry out.
[[nodiscard]] int most_operations(const SharingGroup& group, int interval);

/// Throws std::invalid_argument, one line, for an interval that is not 1 to 64, for a group whose operations
/// are more than its instances carry out in an interval, are of several kinds or in two groups, and for a
/// clock that is too short.
///
/// Modulo scheduling by list: in the order in which their operands can be there, and the longest way to an
/// output first, each operation takes the first stage in which an instance of its group is free modulo the
/// interval. A graph has no cycle, so no operation needs to be moved again. Without groups it is
/// schedule_asap(). The result has passed verify().
[[nodiscard]] SharedSchedule schedule_modulo(const SharingProblem& problem);

/// The rules that a shared schedule breaks, one line each.
[[nodiscard]] std::vector<std::string> verify(const Graph& graph, const Library& library,
                                              const Schedule& schedule, const Binding& binding);

}  // namespace hitpipe::rtl
