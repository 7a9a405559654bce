#include "rtl_gen/prune/prune.hpp"

#include <functional>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/graph/canonical.hpp"

namespace hitpipe::rtl {

namespace {

struct Pass {
  const char* name;
  std::function<Graph(const Graph&, const Demands&)> run;
};

template <Graph (*Run)(const Graph&)>
Graph of_graph_alone(const Graph& graph, const Demands&) {
  return Run(graph);
}

const std::vector<Pass>& passes() {
  static const std::vector<Pass> all{{"fold_constants", fold_constants},
                                     {"decide_comparisons", decide_comparisons},
                                     {"simplify_muxes", simplify_muxes},
                                     {"simplify_gates", of_graph_alone<simplify_gates>},
                                     {"simplify_arithmetic", of_graph_alone<simplify_arithmetic>},
                                     {"narrow", narrow},
                                     {"narrow_units", narrow_units},
                                     {"share", of_graph_alone<share>}};
  return all;
}

/// A graph, and for each value that became smaller the pass that did so last.
struct Reduced {
  Graph graph;
  std::map<std::string, std::string> passes;
};

void note(const Pass& pass, const Graph& before, const Graph& after, Reduced& reduced) {
  const std::map<std::string, Named> left = named_values(after);
  for (const auto& [name, value] : named_values(before)) {
    const auto found = left.find(name);
    if (found == left.end() || found->second.bits < value.bits) reduced.passes[name] = pass.name;
  }
}

/// Tells `passed` of each pass, with the graphs before and after it.
template <class Passed>
Graph run_passes(Graph graph, const Demands& demands, Passed&& passed) {
  // No pass adds anything, so a few rounds are enough. The limit catches a faulty pass.
  constexpr int most_rounds = 1000;
  std::string before;
  for (int round = 0; before != to_text(graph); ++round) {
    if (round == most_rounds) throw std::logic_error(fmt::format("{}: pruning does not end", graph.name()));
    before = to_text(graph);
    for (const Pass& pass : passes()) {
      Graph next = canonical(pass.run(graph, demands));
      passed(pass, graph, next);
      graph = std::move(next);
    }
  }
  return graph;
}

Reduced reduce(const Graph& named, const Demands& demands) {
  Reduced reduced{named, {}};
  reduced.graph = run_passes(named, demands, [&](const Pass& pass, const Graph& before, const Graph& after) {
    note(pass, before, after, reduced);
  });
  return reduced;
}

int bits_left(const std::map<std::string, Named>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? 0 : found->second.bits;
}

std::vector<Cut> cuts_between(const Graph& before, const Reduced& after) {
  std::vector<Cut> cuts;
  const std::map<std::string, Named> left = named_values(after.graph);
  for (const auto& [name, value] : named_values(before)) {
    const int bits = bits_left(left, name);
    if (bits >= value.bits) continue;
    cuts.push_back({.name = name,
                    .kind = value.kind,
                    .bits_before = value.bits,
                    .bits_after = bits,
                    .pass = after.passes.at(name)});
  }
  return cuts;
}

/// Finds what each demand saves beyond the others by leaving it out.
void add_shares(const Graph& named, const Demands& demands, PruneReport& report) {
  for (std::size_t i = 0; i < demands.count(); ++i) {
    const std::string text = demand_text(demands, i);
    const Graph without = reduce(named, demands.without(i)).graph;
    const Size size = size_of(without);
    report.shares.push_back(
        {.demand = text, .nodes = size.nodes - report.after.nodes, .bits = size.bits - report.after.bits});
    const std::map<std::string, Named> left = named_values(without);
    for (Cut& cut : report.cuts)
      if (bits_left(left, cut.name) > cut.bits_after) cut.demands.push_back(text);
  }
}

std::vector<PortChange> port_changes(const Graph& before, const Graph& after) {
  std::map<std::string, int> left;
  for (const NodeId id : after.inputs()) left[after[id].name] = after[id].width;
  std::vector<PortChange> changes;
  for (const NodeId id : before.inputs()) {
    const int bits = left[before[id].name];
    if (bits != before[id].width) changes.push_back({before[id].name, before[id].width, bits});
  }
  return changes;
}

}  // namespace

Graph simplified(const Graph& graph, const Demands& demands) {
  return run_passes(graph, demands, [](const Pass&, const Graph&, const Graph&) {});
}

Pruned prune(const Graph& traced, const Demands& demands, const PruneOptions& options) {
  const std::vector<Port> ports = input_ports(traced);
  check_demands(demands, ports);
  const Graph plain = canonical(traced);
  const Size before = size_of(plain);
  if (implies(options.set_up, demands, ports)) return {traced, {.before = before, .after = before}};

  const Graph named = canonical(with_names(plain));
  Reduced reduced = reduce(named, demands);
  PruneReport report{.before = before, .after = size_of(reduced.graph)};
  report.cuts = cuts_between(named, reduced);
  if (options.shares) add_shares(named, demands, report);
  Graph graph = canonical(narrow_ports(reduced.graph, demands));
  report.ports = port_changes(traced, graph);
  return {std::move(graph), std::move(report)};
}

}  // namespace hitpipe::rtl
