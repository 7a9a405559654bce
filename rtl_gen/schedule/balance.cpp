#include "rtl_gen/schedule/balance.hpp"

#include <stdexcept>

#include "rtl_gen/schedule/logic_levels.hpp"

namespace hitpipe::rtl {

namespace {

const Library& levels() {
  static const Library library = Library::from_json(logic_levels_json, "logic_levels.json");
  return library;
}

/// A clock period in which all the logic fits into one stage.
int whole_delay(const Graph& graph) {
  int sum = levels().latch_delay_ps();
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (is_root(graph[id].op) && graph[id].op != Op::input) sum += timing_of(graph, id, levels()).delay_ps;
  }
  return sum;
}

}  // namespace

Schedule balance(const Graph& graph, int stages) {
  if (stages < 1) throw std::invalid_argument(graph.name() + ": a component has at least one stage");
  // A longer clock needs fewer stages: bisect for the shortest that fits.
  Schedule best = schedule_asap(graph, levels(), whole_delay(graph));
  int too_short = schedule_asap(graph, levels()).clock_ps - 1;
  while (best.clock_ps - too_short > 1) {
    Schedule tried = schedule_asap(graph, levels(), too_short + (best.clock_ps - too_short) / 2);
    if (tried.stages <= stages) {
      best = std::move(tried);
    } else {
      too_short = tried.clock_ps;
    }
  }
  best.stages = stages;
  return best;
}

}  // namespace hitpipe::rtl
