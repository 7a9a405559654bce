#include "area_model/price.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "area_model/mapped_registers.hpp"
#include "area_model/mapped_tables.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/machine/module.hpp"
#include "rtl_gen/schedule/divided_unit.hpp"

namespace hitpipe::area {

namespace {

constexpr std::int64_t printed_unit_um2 = 100;  // 0.0001 mm2, the last digit of Table 7.2

std::int64_t as_printed(std::int64_t area_um2) {
  return (area_um2 + printed_unit_um2 / 2) / printed_unit_um2 * printed_unit_um2;
}

/// Whether what such a part takes depends on what is around it, where a chip's tables are mapped.
bool is_mapped(const Part& part) {
  switch (part.component) {
    case rtl::Component::int_subtract:
    case rtl::Component::int_compare:
    case rtl::Component::mux2:
    case rtl::Component::gate:
      return true;
    case rtl::Component::latch:
      return part.purpose == Purpose::datapath || part.purpose == Purpose::tag;
    default:
      return false;
  }
}

/// The cells of a unit on a chip: of its parts, which are gates, adders and blocks like all others.
rtl::ChipCells taken_by(const rtl::DividedUnit& inside, const rtl::Library& library) {
  rtl::ChipCells taken;
  const bool maps = library.chip()->maps_tables;
  for (const Count& count : count_logic(inside.body, inside.schedule, inside.placement, Gates::counted)) {
    if (count.part.purpose == Purpose::block || (maps && is_mapped(count.part))) continue;
    taken += count.n * library.cell(count.part.component, count.part.bits).taken;
  }
  if (!maps) return taken;
  for (const auto& [part, cells] :
       mapped_cells(inside.body, {inside.schedule, {}}, inside.placement, *library.chip()))
    taken += cells;
  return taken;
}

/// Prices of parts. A chip's library has no prices of units; they follow from the units of the graph.
class PartPrices {
 public:
  PartPrices(const rtl::Pipeline& pipeline, const rtl::Library& library) : library_(library) {
    if (library.chip() == nullptr) return;
    for (const auto& unit : pipeline.graph.submodules()) {
      const rtl::DividedUnit inside = rtl::divided(*unit, library, pipeline.schedule.clock_ps);
      const std::pair part(rtl::component_called(unit->component), unit->bits);
      units_[part] = {.bits = unit->bits, .estimated = true, .taken = taken_by(inside, library)};
      packed_[part] = packed_bits(inside.body, {inside.schedule, {}}, inside.placement);
    }
  }

  [[nodiscard]] Line line(const Part& part, int n) const {
    if (part.purpose == Purpose::block) return {.part = part, .n = n};
    const auto unit = units_.find({part.component, part.bits});
    rtl::Cell cell = unit != units_.end() ? unit->second : library_.cell(part.component, part.bits);
    if (part.by != 0) {
      // An array has one row of partial products for each bit of the narrower operand.
      cell.area_um2 = static_cast<int>((2 * std::int64_t{cell.area_um2} * part.by + part.bits) /
                                       (std::int64_t{2} * part.bits));
      cell.estimated = true;
    }
    return {.part = part,
            .n = n,
            .area_um2 = std::int64_t{n} * cell.area_um2,
            .taken = n * cell.taken,
            .estimated = cell.estimated && library_.chip() == nullptr};
  }

  /// Register bits inside n parts that are in the cells of their tables.
  [[nodiscard]] std::int64_t packed(const Part& part, int n) const {
    const auto unit = packed_.find({part.component, part.bits});
    return unit == packed_.end() ? 0 : std::int64_t{n} * unit->second;
  }

 private:
  const rtl::Library& library_;
  std::map<std::pair<rtl::Component, int>, rtl::Cell> units_;
  std::map<std::pair<rtl::Component, int>, int> packed_;
};

/// Prices the counts of a pipeline; the total is left to the caller.
Price priced(const rtl::Pipeline& pipeline, const std::vector<Count>& counts, const rtl::Design& design,
             const Format& format, const rtl::Library& library) {
  Price price{.design = design.name,
              .format = format,
              .boxes = design.kind.objects,
              .interval = pipeline.interval(),
              .lines = {},
              .by_stage = std::vector<StagePrice>(static_cast<std::size_t>(pipeline.schedule.stages) + 1),
              .stages = pipeline.schedule.stages,
              .stage_delay_ps = pipeline.schedule.clock_ps};
  for (std::size_t stage = 0; stage < price.by_stage.size(); ++stage)
    price.by_stage[stage].stage = static_cast<int>(stage);

  const PartPrices prices(pipeline, library);
  const bool maps = library.chip() != nullptr && library.chip()->maps_tables;
  MappedCells mapped;
  if (maps) {
    mapped = mapped_cells(pipeline.graph, {pipeline.schedule, pipeline.binding}, pipeline.placement,
                          *library.chip());
    mapped.merge(mapped_tags(pipeline, *library.chip()));
  }
  std::map<Part, int> totals;
  std::map<Part, rtl::ChipCells> taken;
  for (const Count& count : counts) {
    StagePrice& stage = price.by_stage[static_cast<std::size_t>(count.stage)];
    Line& line = stage.lines.emplace_back(prices.line(count.part, count.n));
    if (maps && is_mapped(count.part)) line.taken = mapped[{count.stage, count.part}];
    stage.area_um2 += line.area_um2;
    stage.taken += line.taken;
    totals[count.part] += count.n;
    taken[count.part] += line.taken;
  }
  for (const auto& [part, n] : totals) {
    price.lines.push_back(prices.line(part, n));
    price.lines.back().taken = taken[part];
  }
  for (const Line& line : price.lines) price.taken += line.taken;
  if (library.chip() != nullptr && library.chip()->packs_registers) {
    std::int64_t packed =
        packed_bits(pipeline.graph, {pipeline.schedule, pipeline.binding}, pipeline.placement);
    for (const auto& [part, n] : totals) packed += prices.packed(part, n);
    price.logic_cells = price.taken.luts + price.taken.registers - packed;
  }
  return price;
}

}  // namespace

Price price(const rtl::Pipeline& pipeline, const rtl::Design& design, const Format& format,
            const rtl::Library& library, rtl::FlowControl flow) {
  const Gates gates = library.chip() != nullptr ? Gates::counted : Gates::left_out;
  Price price =
      priced(pipeline, count_built(pipeline, register_of(flow, library), gates), design, format, library);
  for (const Line& line : price.lines) price.area_um2 += line.area_um2;
  return price;
}

Price price(const rtl::Design& design, const Format& format, const rtl::Library& library, Account account,
            rtl::FlowControl flow, int interval) {
  if (account == Account::printed && design.printed.rows.empty())
    throw std::runtime_error(
        fmt::format("design {}: not in Table 7.2, so there is no printed account of it, only the built one",
                    design.name));
  if (account == Account::printed && library.chip() != nullptr)
    throw std::runtime_error(fmt::format(
        "library {}: it is a chip's and has no areas, so there is no printed account, only the built one",
        library.name()));
  if (account == Account::printed && interval != 1)
    throw std::runtime_error(fmt::format(
        "--ii {}: the thesis's units take a test in each cycle, so only the built account has others",
        interval));
  const rtl::Pipeline pipeline = rtl::make_pipeline(design.trace(format), library, std::nullopt, interval);
  if (account == Account::built) return price(pipeline, design, format, library, flow);
  Price price = priced(pipeline, count_printed(pipeline, format, design.printed), design, format, library);
  for (const Line& line : price.lines) price.area_um2 += as_printed(line.area_um2);
  return price;
}

MachinePrice price(const rtl::MachineGraph& machine, const rtl::Library& library) {
  rtl::Pipeline step{rtl::canonical(machine.graph), {}, {}};
  step.schedule = rtl::schedule_as_stated(step.graph, 1);
  step.placement = rtl::place_registers(step.graph, step.schedule, rtl::Ports::direct);
  MachinePrice price{.lines = {}, .clock_ps = rtl::longest_path(machine, library).clock_ps};
  step.schedule.clock_ps = price.clock_ps;
  const Gates gates = library.chip() != nullptr ? Gates::counted : Gates::left_out;
  std::map<Part, int> parts;
  std::map<Part, rtl::ChipCells> taken;
  const bool maps = library.chip() != nullptr && library.chip()->maps_tables;
  if (maps) {
    for (const auto& [key, cells] :
         mapped_cells(step.graph, {step.schedule, {}}, step.placement, *library.chip()))
      taken[key.second] += cells;
  }
  for (const Count& count : count_logic(step.graph, step.schedule, step.placement, gates))
    parts[count.part] += count.n;
  for (const hls::Field& field : machine.state) {
    ++parts[{rtl::Component::latch, field.width}];
    taken[{rtl::Component::latch, field.width}].registers += field.width;
    price.register_bits += field.width;
  }
  for (const hls::MemoryShape& memory : machine.memories)
    price.memory_bits += std::int64_t{memory.words} * memory.width;
  const PartPrices prices(step, library);
  for (const auto& [part, n] : parts) {
    price.lines.push_back(prices.line(part, n));
    if (maps && is_mapped(part)) price.lines.back().taken = taken[part];
    price.area_um2 += price.lines.back().area_um2;
    price.taken += price.lines.back().taken;
  }
  return price;
}

const std::vector<Entry>& table_7_2() {
  static const std::vector<Entry> entries = [] {
    std::map<int, Entry> by_row;
    for (const rtl::Design& design : rtl::designs())
      for (const rtl::ThesisRow& row : design.printed.rows)
        by_row.emplace(row.row, Entry{design.name, row.format});
    std::vector<Entry> sorted;
    for (const auto& [row, entry] : by_row) sorted.push_back(entry);
    return sorted;
  }();
  return entries;
}

const Entry& baseline_design() {
  return table_7_2().front();
}

bool can_price_baseline(const rtl::Library& library) {
  return library.has(rtl::Component::fp_subtract) && library.has(rtl::Component::fp_multiply) &&
         library.has(rtl::Component::fp_compare);
}

}  // namespace hitpipe::area
