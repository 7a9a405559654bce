#include "area_model/mapped_registers.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "rtl_gen/graph/sources.hpp"

namespace hitpipe::area {

namespace {

using rtl::NodeId;
using rtl::Word;

/// Registers of one value, in the order of their boundaries, and the stages that read it, each with the bits.
struct Waiting {
  std::vector<const rtl::Register*> registers;
  std::vector<std::pair<int, Word>> reads;

  /// Whether anything but the next register reads the bit in this one.
  [[nodiscard]] bool is_read(const rtl::Register& r, int bit, int interval) const {
    return std::any_of(reads.begin(), reads.end(), [&](const std::pair<int, Word>& read) {
      return read.first > r.boundary && read.first <= r.boundary + interval && (read.second >> bit & 1) != 0;
    });
  }
};

std::map<NodeId, Waiting> waiting_values(const rtl::Graph& graph, const rtl::Schedule& schedule,
                                         const rtl::Placement& placement) {
  std::map<NodeId, Waiting> values;
  for (const rtl::Register& r : placement.registers)
    if (!r.in_block && !r.is_shared()) values[r.value].registers.push_back(&r);
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (!rtl::is_root(graph[id].op)) continue;
    rtl::for_each_source(graph, id, [&](NodeId source, Word bits) {
      const auto found = values.find(source);
      if (found != values.end()) found->second.reads.emplace_back(schedule.slots[id].stage, bits);
    });
  }
  return values;
}

}  // namespace

MappedCells mapped_registers(const rtl::Graph& graph, const rtl::SharedSchedule& shared,
                             const rtl::Placement& placement, const rtl::Chip& chip) {
  MappedCells cells;
  const auto taken_by = [&](const rtl::Register& r) -> rtl::ChipCells& {
    return cells[{r.boundary, Part{rtl::Component::latch, r.width()}}];
  };
  for (const rtl::Register& r : placement.registers)
    if (!r.in_block) taken_by(r).registers += r.width();
  if (chip.shortest_shift_register == 0) return cells;

  const int interval = shared.binding.interval;
  const auto has_enable = [](const rtl::Register& r) { return r.holds() && !r.loads_again; };
  for (const auto& [value, waiting] : waiting_values(graph, shared.schedule, placement)) {
    for (int bit = 0; bit < graph[value].width; ++bit) {
      std::vector<const rtl::Register*> row;
      const auto end = [&] {
        if (static_cast<int>(row.size()) >= chip.shortest_shift_register) {
          ++taken_by(*row.front()).luts;
          for (const rtl::Register* const r : row) --taken_by(*r).registers;
        }
        row.clear();
      };
      for (const rtl::Register* const r : waiting.registers) {
        if (bit < r->low || bit > r->high) continue;
        const bool continues = !row.empty() && row.back()->boundary + interval == r->boundary &&
                               has_enable(*row.back()) == has_enable(*r);
        if (!continues) end();
        row.push_back(r);
        if (waiting.is_read(*r, bit, interval)) end();
      }
      end();
    }
  }
  return cells;
}

MappedCells mapped_tags(const rtl::Pipeline& pipeline, const rtl::Chip& chip) {
  MappedCells cells;
  const int registers = pipeline.schedule.stages / pipeline.interval() + 1;
  const Part tag{rtl::Component::latch, tag_bits, Purpose::tag};
  const bool shifts = chip.shortest_shift_register != 0 && registers >= chip.shortest_shift_register;
  for (int i = 0; i < registers; ++i) cells[{i * pipeline.interval(), tag}].registers = shifts ? 0 : tag_bits;
  if (shifts) cells[{0, tag}].luts = tag_bits;
  return cells;
}

}  // namespace hitpipe::area
