#include "area_model/price.hpp"

#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::area {

namespace {

constexpr std::int64_t printed_unit_um2 = 100;  // 0.0001 mm2, the last digit of Table 7.2

std::int64_t as_printed(std::int64_t area_um2) {
  return (area_um2 + printed_unit_um2 / 2) / printed_unit_um2 * printed_unit_um2;
}

Line line_of(const Part& part, int n, const rtl::Library& library) {
  rtl::Cell cell = library.cell(part.component, part.bits);
  if (part.by != 0) {
    // An array has one row of partial products for each bit of the narrower operand.
    cell.area_um2 = static_cast<int>((2 * std::int64_t{cell.area_um2} * part.by + part.bits) /
                                     (std::int64_t{2} * part.bits));
    cell.estimated = true;
  }
  return {.part = part, .n = n, .area_um2 = std::int64_t{n} * cell.area_um2, .estimated = cell.estimated};
}

/// Prices the counts of a pipeline; the total is left to the caller.
Price priced(const rtl::Pipeline& pipeline, const std::vector<Count>& counts, const rtl::Design& design,
             const rtl::Format& format, const rtl::Library& library) {
  Price price{.design = design.name,
              .format = format,
              .boxes = design.boxes_per_test(),
              .lines = {},
              .by_stage = std::vector<StagePrice>(static_cast<std::size_t>(pipeline.schedule.stages) + 1),
              .stages = pipeline.schedule.stages,
              .stage_delay_ps = pipeline.schedule.clock_ps};
  for (std::size_t stage = 0; stage < price.by_stage.size(); ++stage)
    price.by_stage[stage].stage = static_cast<int>(stage);

  std::map<Part, int> totals;
  for (const Count& count : counts) {
    StagePrice& stage = price.by_stage[static_cast<std::size_t>(count.stage)];
    stage.lines.push_back(line_of(count.part, count.n, library));
    stage.area_um2 += stage.lines.back().area_um2;
    totals[count.part] += count.n;
  }
  for (const auto& [part, n] : totals) price.lines.push_back(line_of(part, n, library));
  return price;
}

}  // namespace

Price price(const rtl::Pipeline& pipeline, const rtl::Design& design, const rtl::Format& format,
            const rtl::Library& library) {
  Price price = priced(pipeline, count_built(pipeline), design, format, library);
  for (const Line& line : price.lines) price.area_um2 += line.area_um2;
  return price;
}

Price price(const rtl::Design& design, const rtl::Format& format, const rtl::Library& library,
            Account account) {
  if (account == Account::printed && design.printed.rows.empty())
    throw std::runtime_error(
        fmt::format("design {}: not in Table 7.2, so there is no printed account of it, only the built one",
                    design.name));
  const rtl::Pipeline pipeline = rtl::make_pipeline(design.trace(format), library);
  if (account == Account::built) return price(pipeline, design, format, library);
  Price price = priced(pipeline, count_printed(pipeline, format, design.printed), design, format, library);
  for (const Line& line : price.lines) price.area_um2 += as_printed(line.area_um2);
  return price;
}

const std::vector<Entry>& table_7_2() {
  static const std::vector<Entry> entries = [] {
    std::map<int, Entry> by_row;
    for (const rtl::Design& design : rtl::designs())
      for (const rtl::PrintedRow& row : design.printed.rows)
        by_row.emplace(row.row, Entry{design.name, row.format});
    std::vector<Entry> sorted;
    for (const auto& [row, entry] : by_row) sorted.push_back(entry);
    return sorted;
  }();
  return entries;
}

const Entry& yardstick() {
  return table_7_2().front();
}

bool can_price_yardstick(const rtl::Library& library) {
  return library.has(rtl::Component::fp_subtract) && library.has(rtl::Component::fp_multiply) &&
         library.has(rtl::Component::fp_compare);
}

}  // namespace hitpipe::area
