#include "area_model/gate_network.hpp"

#include <algorithm>
#include <utility>

namespace hitpipe::area {

namespace {

/// Some gates or leaves that decide a gate: the inputs of a table that could make it.
struct Cut {
  std::array<std::uint32_t, GateNetwork::most_table_inputs> inputs{};
  int size = 0;
  float flow = 0;  ///< tables for it and for what is below, shared among their readers

  [[nodiscard]] bool same_inputs(const Cut& other) const {
    return size == other.size && std::equal(inputs.begin(), inputs.begin() + size, other.inputs.begin());
  }
};

/// False if both together have too many inputs.
bool merge(const Cut& a, const Cut& b, int most, Cut& into) {
  int i = 0, j = 0, n = 0;
  while (i < a.size || j < b.size) {
    if (n == most) return false;
    const auto at = [](const Cut& cut, int k) { return cut.inputs[static_cast<std::size_t>(k)]; };
    const bool of_a = j == b.size || (i < a.size && at(a, i) <= at(b, j));
    const bool of_b = i == a.size || (j < b.size && at(b, j) <= at(a, i));
    into.inputs[static_cast<std::size_t>(n++)] = of_a ? at(a, i) : at(b, j);
    i += of_a ? 1 : 0;
    j += of_b ? 1 : 0;
  }
  into.size = n;
  return true;
}

constexpr std::size_t most_cuts = 8;

}  // namespace

GateNetwork::Signal GateNetwork::leaf() {
  gates_.push_back({Kind::leaf, {}, -1});
  return static_cast<Signal>(gates_.size() - 1) << 1U;
}

GateNetwork::Signal GateNetwork::record(Kind kind, Signal a, Signal b) {
  if (a > b) std::swap(a, b);
  const auto [known, is_new] = known_.try_emplace({kind, a, b}, static_cast<Signal>(gates_.size()) << 1U);
  if (is_new) gates_.push_back({kind, {a, b}, owner_});
  return known->second;
}

GateNetwork::Signal GateNetwork::both(Signal a, Signal b) {
  if (a == zero || b == zero || a == (b ^ 1U)) return zero;
  if (a == one || a == b) return b;
  if (b == one) return a;
  return record(Kind::both, a, b);
}

GateNetwork::Signal GateNetwork::differ(Signal a, Signal b) {
  const Signal inverted = (a ^ b) & 1U;
  a &= ~1U;
  b &= ~1U;
  if (a == b) return inverted;
  if (a == zero) return b ^ inverted;
  if (b == zero) return a ^ inverted;
  return record(Kind::differ, a, b) ^ inverted;
}

GateNetwork::Signal GateNetwork::select(Signal s, Signal if_one, Signal if_zero) {
  if (if_one == if_zero) return if_one;
  if (if_one == (if_zero ^ 1U)) return differ(s, if_zero);
  return either(both(s, if_one), both(s ^ 1U, if_zero));
}

void GateNetwork::reads_as_is(Signal s) {
  const bool inverts = (s & 1U) != 0 && s != one && gates_[s >> 1U].kind == Kind::leaf;
  reads(inverts ? record(Kind::both, s, s) : s);
}

std::vector<int> GateNetwork::tables(int inputs, int owners) const {
  std::vector<float> readers(gates_.size(), 0);
  for (const Gate& gate : gates_) {
    if (gate.kind == Kind::leaf) continue;
    for (const Signal arg : gate.args) readers[arg >> 1U] += 1;
  }
  std::vector<std::uint32_t> read = read_;
  std::sort(read.begin(), read.end());
  read.erase(std::unique(read.begin(), read.end()), read.end());
  for (const std::uint32_t at : read) readers[at] += 1;

  std::vector<int> made(static_cast<std::size_t>(owners), 0);
  // The second time it is known which gates have a table of their own, and how many tables read them.
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<std::vector<Cut>> cuts(gates_.size());
    std::vector<float> flow(gates_.size(), 0);
    for (std::uint32_t at = 0; at < gates_.size(); ++at) {
      const Gate& gate = gates_[at];
      const Cut itself{.inputs = {at}, .size = 1};
      if (gate.kind == Kind::leaf) {
        cuts[at] = {itself};
        continue;
      }
      std::vector<Cut>& best = cuts[at];
      for (const Cut& a : cuts[gate.args[0] >> 1U]) {
        for (const Cut& b : cuts[gate.args[1] >> 1U]) {
          Cut cut;
          if (!merge(a, b, inputs, cut)) continue;
          cut.flow = 1;
          for (int i = 0; i < cut.size; ++i) {
            const std::uint32_t input = cut.inputs[static_cast<std::size_t>(i)];
            cut.flow += flow[input] / std::max(1.0F, readers[input]);
          }
          const auto place = std::find_if(best.begin(), best.end(), [&](const Cut& other) {
            return cut.flow < other.flow || (cut.flow == other.flow && cut.size < other.size);
          });
          if (place == best.end() && best.size() == most_cuts) continue;
          if (std::any_of(best.begin(), best.end(), [&](const Cut& other) { return cut.same_inputs(other); }))
            continue;
          best.insert(place, cut);
          if (best.size() > most_cuts) best.pop_back();
        }
      }
      flow[at] = best.front().flow;
      best.push_back(itself);
    }
    std::fill(readers.begin(), readers.end(), 0.0F);
    std::fill(made.begin(), made.end(), 0);
    for (const std::uint32_t at : read) readers[at] += 1;
    for (std::uint32_t at = static_cast<std::uint32_t>(gates_.size()); at-- > 0;) {
      if (readers[at] == 0 || gates_[at].kind == Kind::leaf) continue;
      ++made[static_cast<std::size_t>(gates_[at].owner)];
      const Cut& cut = cuts[at].front();
      for (int i = 0; i < cut.size; ++i) readers[cut.inputs[static_cast<std::size_t>(i)]] += 1;
    }
  }
  return made;
}

}  // namespace hitpipe::area
