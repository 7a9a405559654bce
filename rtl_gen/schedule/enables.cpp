#include <algorithm>
#include <set>

#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl {

namespace {

/// Collects the values in registers from which logic of one stage makes some bits.
class RegisteredSources {
 public:
  struct Source {
    std::size_t at;  ///< among the placement's registers
    NodeId value;

    friend auto operator<=>(const Source&, const Source&) = default;
  };

  RegisteredSources(const Graph& graph, const Schedule& schedule, const Binding& binding,
                    const RegisterTable& table, int stage)
      : graph_(graph), schedule_(schedule), binding_(binding), table_(table), stage_(stage) {}

  /// False: some bits come from a port, from a shared component or from one that has stages of its own, so
  /// they change in every cycle.
  bool collect(NodeId value, Word bits) {
    bool all = true;
    for_each_run(bits, [&](int high, int low) {
      if (const auto found = table_.find(value, high, low, stage_))
        sources_.insert({*found, value});
      else
        all = all && collect_operands(value);
    });
    return all;
  }

  [[nodiscard]] const std::set<Source>& sources() const { return sources_; }

 private:
  bool collect_operands(NodeId value) {
    if (graph_[value].op == Op::input || binding_.shares(value) || schedule_.slots[value].latched)
      return false;
    if (!seen_.insert(value).second) return true;
    bool all = true;
    for_each_source(graph_, value, [&](NodeId source, Word bits) { all = all && collect(source, bits); });
    return all;
  }

  const Graph& graph_;
  const Schedule& schedule_;
  const Binding& binding_;
  const RegisterTable& table_;
  int stage_;
  std::set<Source> sources_;
  std::set<NodeId> seen_;
};

/// Whether the register, with its enable, has the value up to this stage and loads no other before.
bool can_keep(const Register& r, NodeId value, int stage, int interval) {
  if (!r.holds()) return false;
  const std::vector<Passing> all = r.values();
  Passing longer = *std::find_if(all.begin(), all.end(), [&](const Passing& p) { return p.value == value; });
  longer.last = std::max(longer.last, stage);
  return longer.last <= longer.boundary + interval &&
         std::none_of(all.begin(), all.end(),
                      [&](const Passing& other) { return in_one_cycle(longer, other, interval); });
}

void keep(Register& r, NodeId value, int stage) {
  int* last = &r.last;
  for (Passing& other : r.others)
    if (other.value == value) last = &other.last;
  *last = std::max(*last, stage);
}

}  // namespace

void drop_needless_enables(Placement& placement, const Graph& graph, const Schedule& schedule,
                           const Binding& binding) {
  const RegisterTable table(placement, binding.interval);
  // From the last stage back: a register without an enable needs those before it for longer.
  for (auto r = placement.registers.rbegin(); r != placement.registers.rend(); ++r) {
    if (!r->holds() || r->is_shared()) continue;
    RegisteredSources from(graph, schedule, binding, table, r->boundary);
    if (!from.collect(r->value, bit_range(r->high, r->low))) continue;
    const int last_load = r->last - 1;
    const bool kept = std::all_of(from.sources().begin(), from.sources().end(), [&](const auto& source) {
      return can_keep(placement.registers[source.at], source.value, last_load, binding.interval);
    });
    if (!kept) continue;
    for (const auto& source : from.sources()) keep(placement.registers[source.at], source.value, last_load);
    r->loads_again = true;
  }
}

}  // namespace hitpipe::rtl
