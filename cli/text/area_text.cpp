#include "cli/text/area_text.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <span>

#include <fmt/format.h>

#include "area_model/figure.hpp"

namespace hitpipe::cli {

namespace {

using area::Line;
using area::Price;
using Cells = std::vector<std::string>;

constexpr std::size_t page_width = 80;
constexpr std::size_t usual_gap = 2;  // between columns

std::size_t column_width(const std::vector<Cells>& rows, std::size_t column) {
  std::size_t width = 0;
  for (const Cells& row : rows) width = std::max(width, row[column].size());
  return width;
}

/// The first columns are aligned left, all others right.
std::string aligned(const std::vector<Cells>& rows, std::size_t left_columns,
                    std::size_t between = usual_gap) {
  std::string text;
  for (const Cells& row : rows) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column) {
      const std::size_t width = column_width(rows, column);
      if (column > 0) line += std::string(between, ' ');
      line += column < left_columns ? fmt::format("{:<{}}", row[column], width)
                                    : fmt::format("{:>{}}", row[column], width);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

/// In percent of the baseline design; for each box, as all comparisons of designs.
std::string area_share(const Price& price, const std::optional<Price>& baseline) {
  return baseline ? area::percent(price.area_per_box_um2(), baseline->area_per_box_um2()) + "%" : "";
}
std::string area_delay_share(const Price& price, const std::optional<Price>& baseline) {
  return baseline ? area::percent(price.area_delay_per_box(), baseline->area_delay_per_box()) + "%" : "";
}

std::string summary(const std::vector<Price>& prices, const std::optional<Price>& baseline) {
  std::vector<Cells> rows{{"design", "bits", "stages", "delay", "clock", "latency", "area", "", "ADP", ""},
                          {"", "", "", "ns", "MHz", "ns", "mm2", "", "mm2 ns", ""}};
  for (const Price& p : prices) {
    rows.push_back({std::string(p.design), rtl::to_string(p.format), fmt::format("{}", p.stages),
                    area::delay_ns(p.stage_delay_ps), area::clock_mhz(p), area::delay_ns(p.latency_ps()),
                    area::area_mm2(p.area_um2), area_share(p, baseline), area::adp_mm2_ns(p),
                    area_delay_share(p, baseline)});
  }
  return aligned(rows, 2);
}

/// With a narrower gap where the usual one would exceed the page.
std::string fitted(const std::vector<Cells>& rows) {
  std::size_t width = (rows.front().size() - 1) * usual_gap;
  for (std::size_t column = 0; column < rows.front().size(); ++column) width += column_width(rows, column);
  return aligned(rows, 2, width <= page_width ? usual_gap : 1);
}

/// For designs of which one answers for several boxes in a test. The clock is left out, because the delay
/// says the same and the page is narrow.
std::string summary_of_boxes(const std::vector<Price>& prices, const std::optional<Price>& baseline) {
  std::vector<Cells> rows{
      {"design", "bits", "stages", "delay", "latency", "area", "boxes", "area", "", "ADP", ""},
      {"", "", "", "ns", "ns", "mm2", "", "a box", "", "mm2 ns", ""}};
  for (const Price& p : prices) {
    rows.push_back({std::string(p.design), rtl::to_string(p.format), fmt::format("{}", p.stages),
                    area::delay_ns(p.stage_delay_ps), area::delay_ns(p.latency_ps()),
                    area::area_mm2(p.area_um2), fmt::format("{}", p.boxes),
                    area::area_mm2(p.area_per_box_um2()), area_share(p, baseline), area::adp_mm2_ns(p),
                    area_delay_share(p, baseline)});
  }
  const std::string note =
      fmt::format("ADP{} for each box that a test answers for.\n",
                  baseline ? fmt::format(" and percent of {} are", baseline->design) : " is");
  return fitted(rows) + note;
}

/// For example "int", "plucker", "24/24": three short lines as the head of a column, and the interval.
Cells column_head(const Price& price, bool with_interval) {
  const std::string name(price.design);
  const std::size_t split = std::min(name.find('_'), name.size());
  Cells head{name.substr(0, split), name.substr(std::min(split + 1, name.size())),
             rtl::to_string(price.format)};
  if (with_interval) head.push_back(fmt::format("II {}", price.interval));
  return head;
}

using Show = std::function<std::string(const Line&)>;
using Total = std::function<std::string(const Price&)>;

/// A row for each part, a column for each design, and a row for the total if there is one. Uses as many
/// blocks as the width of the page needs.
std::string part_columns(const std::string& title, std::span<const Price> prices, const Show& show,
                         const Total& total = {}) {
  std::map<area::Part, std::map<const Price*, std::string>> parts;
  std::map<area::Part, std::string> names;
  for (const Price& price : prices) {
    for (const Line& line : price.lines) {
      parts[line.part][&price] = show(line);
      names[line.part] = area::part_name(line.part) + (line.estimated ? " est." : "");
    }
  }
  const bool with_interval =
      std::any_of(prices.begin(), prices.end(), [](const Price& p) { return p.interval > 1; });
  std::vector<Cells> rows(with_interval ? 3 : 2, Cells{""});
  rows.push_back({title});
  for (const auto& [part, cells] : parts) rows.push_back({names[part]});
  if (total) rows.push_back({"total"});

  std::size_t width = column_width(rows, 0);
  std::size_t taken = 0;
  for (const Price& price : prices) {
    Cells column = column_head(price, with_interval);
    for (const auto& [part, cells] : parts) column.push_back(cells.contains(&price) ? cells.at(&price) : "-");
    if (total) column.push_back(total(price));
    std::size_t needed = 0;
    for (const std::string& cell : column) needed = std::max(needed, cell.size());
    width += usual_gap + needed;
    if (taken > 0 && width > page_width) break;
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(column[row]);
    ++taken;
  }
  const std::string block = fmt::format("\n{}", aligned(rows, 1));
  return taken < prices.size() ? block + part_columns(title, prices.subspan(taken), show, total) : block;
}

/// Items separated by commas, in lines that begin at `indent`. The first line has begun already.
std::string listed(const Cells& items, std::size_t indent) {
  std::string text;
  std::size_t column = indent;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? "," : "");
    if (column > indent && column + 1 + item.size() > page_width) {
      text += fmt::format("\n{:{}}", "", indent);
      column = indent;
    } else if (column > indent) {
      text += ' ';
      ++column;
    }
    text += item;
    column += item.size();
  }
  return text;
}

}  // namespace

std::string area_text(const std::vector<Price>& prices, const std::optional<Price>& baseline) {
  const bool one_box = std::all_of(prices.begin(), prices.end(), [](const Price& p) { return p.boxes == 1; });
  return (one_box ? summary(prices, baseline) : summary_of_boxes(prices, baseline)) +
         part_columns("count", prices, [](const Line& line) { return fmt::format("{}", line.n); }) +
         part_columns(
             "area mm2", prices, [](const Line& line) { return area::area_mm2(line.area_um2); },
             [](const Price& price) { return area::area_mm2(price.area_um2); });
}

namespace {

/// What a stage takes, in columns, and their heading.
struct StageColumns {
  std::string heading;
  std::function<std::string(const area::StagePrice&)> row;
  std::function<std::string(const Price&)> total;
};

std::string stages_text(const std::vector<Price>& prices, const StageColumns& columns) {
  std::string text;
  for (const Price& price : prices) {
    text += fmt::format("{}{} {}, {} stages of {} ns\n", text.empty() ? "" : "\n", price.design,
                        rtl::to_string(price.format), price.stages, area::delay_ns(price.stage_delay_ps));
    text += fmt::format("stage  {}  components\n", columns.heading);
    for (const area::StagePrice& stage : price.by_stage) {
      Cells items;
      for (const Line& line : stage.lines) {
        items.push_back(
            fmt::format("{} {}{}", line.n, area::part_name(line.part), line.estimated ? " est." : ""));
      }
      const std::string head = fmt::format("{:>5}  {}  ", stage.stage, columns.row(stage));
      std::string line = head + listed(items, head.size());
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    text += fmt::format("total  {}\n", columns.total(price));
  }
  return text;
}

std::string block_name(const rtl::Chip& chip) {
  return chip.block ? chip.block->name : "DSP";
}

}  // namespace

std::string by_stage_text(const std::vector<Price>& prices) {
  const auto column = [](std::int64_t area_um2) { return fmt::format("{:>8}", area::area_mm2(area_um2)); };
  return stages_text(prices, {.heading = "area mm2",
                              .row = [&](const area::StagePrice& stage) { return column(stage.area_um2); },
                              .total = [&](const Price& price) { return column(price.area_um2); }});
}

std::string chip_text(const std::vector<Price>& prices, const rtl::Library& library,
                      const std::string& notes) {
  const rtl::Chip& chip = *library.chip();
  std::vector<Cells> rows{
      {"design", "bits", "stages", "delay", "clock", "latency", "LUT", "FF", block_name(chip)},
      {"", "", "", "ns", "MHz", "ns", "", "", ""}};
  if (chip.packs_registers) {
    rows[0].emplace_back("cells");
    rows[1].emplace_back();
  }
  const auto count = [](std::int64_t n) { return fmt::format("{}", n); };
  for (const Price& p : prices) {
    rows.push_back({std::string(p.design), rtl::to_string(p.format), count(p.stages),
                    area::delay_ns(p.stage_delay_ps), area::clock_mhz(p), area::delay_ns(p.latency_ps()),
                    count(p.taken.luts), count(p.taken.registers), count(p.taken.blocks)});
    if (p.logic_cells) rows.back().push_back(count(*p.logic_cells));
  }
  const std::string note =
      fmt::format("On {}.{}{}\n", chip.device, chip.estimated ? " Delays are estimated." : "",
                  chip.packs_registers ? "\nA cell has a table and the register behind it." : "");
  return fitted(rows) + note + notes +
         part_columns("count", prices, [&](const Line& line) { return count(line.n); }) +
         part_columns(
             "LUT", prices, [&](const Line& line) { return count(line.taken.luts); },
             [&](const Price& price) { return count(price.taken.luts); }) +
         part_columns(
             "FF", prices, [&](const Line& line) { return count(line.taken.registers); },
             [&](const Price& price) { return count(price.taken.registers); });
}

std::string chip_by_stage_text(const std::vector<Price>& prices, const rtl::Chip& chip) {
  const std::string name = block_name(chip);
  const auto columns = [&](const rtl::ChipCells& taken) {
    return fmt::format("{:>5}  {:>5}  {:>{}}", taken.luts, taken.registers, taken.blocks, name.size());
  };
  return stages_text(prices, {.heading = fmt::format("  LUT     FF  {}", name),
                              .row = [&](const area::StagePrice& stage) { return columns(stage.taken); },
                              .total = [&](const Price& price) { return columns(price.taken); }});
}

std::string rates_text(const std::vector<RatedPrice>& units, const rtl::Library& library) {
  const rtl::Chip* const chip = library.chip();
  std::vector<Cells> rows{{"design", "bits", "II", "stages", "clock"}, {"", "", "", "", "MHz"}};
  const auto add = [](Cells& row, const Cells& more) { row.insert(row.end(), more.begin(), more.end()); };
  if (chip != nullptr) {
    add(rows[0], {"LUT", "", "FF", "blocks", "boxes"});
    add(rows[1], {"", "of II 1", "", "", "M/s"});
  } else {
    add(rows[0], {"area", "", "boxes", "x time"});
    add(rows[1], {"mm2", "of II 1", "M/s", "mm2 ns"});
  }
  const auto count = [](std::int64_t n) { return fmt::format("{}", n); };
  std::vector<Price> prices;
  for (const auto& [p, every_cycle] : units) {
    rows.push_back({std::string(p.design), rtl::to_string(p.format), count(p.interval), count(p.stages),
                    area::clock_mhz(p)});
    const std::string rate = area::megaboxes_per_second(p);
    if (chip != nullptr) {
      add(rows.back(), {count(p.taken.luts), area::percent(p.taken.luts, every_cycle.taken.luts) + "%",
                        count(p.taken.registers), count(p.taken.blocks), rate});
    } else {
      add(rows.back(), {area::area_mm2(p.area_per_box_um2()),
                        area::percent(p.area_per_box_um2(), every_cycle.area_per_box_um2()) + "%", rate,
                        area::adp_mm2_ns(p)});
    }
    prices.push_back(p);
  }
  std::string text = fitted(rows);
  if (chip != nullptr)
    text += fmt::format("On {}.{}{}\n", chip->device,
                        chip->block ? fmt::format(" Blocks are {}.", chip->block->name) : "",
                        chip->estimated ? " Delays are estimated." : "");
  else
    text += "Area is for each box; x time: times the time from one box to the next.\n";
  return text + part_columns("count", prices, [&](const Line& line) { return count(line.n); });
}

}  // namespace hitpipe::cli
