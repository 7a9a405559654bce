#include "cli/text/area_text.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "area_model/figure.hpp"

namespace hitpipe::cli {

namespace {

using area::Line;
using area::Price;
using Cells = std::vector<std::string>;

constexpr std::size_t page_width = 80;
constexpr std::size_t usual_gap = 2;  // between columns

std::size_t column_width(const std::vector<std::vector<Cell>>& rows, std::size_t column) {
  std::size_t width = 0;
  for (const std::vector<Cell>& row : rows) width = std::max(width, row[column].text.size());
  return width;
}

/// With a narrower gap where the usual one would exceed the page.
std::string fitted(const std::vector<std::vector<Cell>>& rows) {
  std::size_t width = (rows.front().size() - 1) * usual_gap;
  for (std::size_t column = 0; column < rows.front().size(); ++column) width += column_width(rows, column);
  return aligned(rows, width <= page_width ? usual_gap : 1);
}

/// For example "int", "plucker", "24/24": three short lines as the head of a column, and the interval.
Cells column_head(const Price& price, bool with_interval) {
  const std::string name(price.design);
  const std::size_t split = std::min(name.find('_'), name.size());
  Cells head{name.substr(0, split), name.substr(std::min(split + 1, name.size())), to_string(price.format)};
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
  std::vector<std::vector<Cell>> rows(with_interval ? 3 : 2, {Cell{}});
  rows.push_back({{title}});
  for (const auto& [part, cells] : parts) rows.push_back({{names[part]}});
  if (total) rows.push_back({{"total"}});

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
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back({column[row], true});
    ++taken;
  }
  const std::string block = fmt::format("\n{}", aligned(rows));
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

/// A figure in a table of units: what CSV and JSON call it, and what a table as text has above it.
struct Column {
  const char* key;
  std::string head{}, unit{};
  std::function<std::string(const RatedPrice&)> digits;
  bool is_word = false;
};

std::string count(std::int64_t n) {
  return fmt::format("{}", n);
}

std::string block_name(const rtl::Chip& chip) {
  return chip.block ? chip.block->name : "DSP";
}

/// All columns of a kind of table, in the order of CSV.
std::vector<Column> columns_of(const AreaTable& table) {
  const rtl::Chip* const chip = table.library->chip();
  const auto of_price = [](auto figure) { return [figure](const RatedPrice& p) { return figure(p.price); }; };
  std::vector<Column> all;
  const auto add = [&](const char* key, std::string title, std::string unit, auto figure) {
    all.push_back({key, std::move(title), std::move(unit), of_price(figure)});
  };
  const auto add_word = [&](const char* key, std::string title, auto figure) {
    all.push_back({key, std::move(title), "", of_price(figure), true});
  };
  if (chip != nullptr && !table.rates)
    add_word("library", "", [&table](const Price&) { return table.library->name(); });
  add_word("design", "design", [](const Price& p) { return std::string(p.design); });
  add_word("bits", "bits", [](const Price& p) { return to_string(p.format); });
  add("stages", "stages", "", [](const Price& p) { return count(p.stages); });
  add("stage_delay_ns", "delay", "ns", [](const Price& p) { return area::delay_ns(p.stage_delay_ps); });
  add("clock_mhz", "clock", "MHz", area::clock_mhz);
  add("latency_ns", "latency", "ns", [](const Price& p) { return area::delay_ns(p.latency_ps()); });
  const auto boxes = [](const Price& p) { return count(p.boxes); };
  if (table.rates) {
    add("ii", "II", "", [](const Price& p) { return count(p.interval); });
    add("boxes_per_test", "boxes", "", boxes);
    add("boxes_per_second", "", "", [](const Price& p) { return count(p.boxes_per_second()); });
  } else if (chip != nullptr) {
    add("delay_estimated", "", "",
        [chip](const Price&) { return std::string(chip->estimated ? "true" : "false"); });
  }
  if (chip != nullptr) {
    add("lut", "LUT", "", [](const Price& p) { return count(p.taken.luts); });
    add("ff", "FF", "", [](const Price& p) { return count(p.taken.registers); });
    add("dsp", table.rates ? "blocks" : block_name(*chip), "",
        [](const Price& p) { return count(p.taken.blocks); });
    all.push_back({"dsp_name", "", "",
                   [chip](const RatedPrice&) { return chip->block ? chip->block->name : ""; }, true});
    add("logic_cells", "cells", "",
        [](const Price& p) { return p.logic_cells ? count(*p.logic_cells) : ""; });
    if (table.rates)
      all.push_back({"lut_of_ii_1_pct", "", "of II 1", [](const RatedPrice& p) {
                       return area::percent(p.price.taken.luts, p.every_cycle.taken.luts);
                     }});
    else
      add("boxes_per_test", "boxes", "", boxes);
    return all;
  }
  const auto area_of = [](const Price& p) { return area::area_mm2(p.area_um2); };
  const auto area_of_box = [](const Price& p) { return area::area_mm2(p.area_per_box_um2()); };
  if (table.rates) {
    add("area_mm2", "", "", area_of);
    add("area_per_box_mm2", "area", "mm2", area_of_box);
    all.push_back({"area_of_ii_1_pct", "", "of II 1", [](const RatedPrice& p) {
                     return area::percent(p.price.area_per_box_um2(), p.every_cycle.area_per_box_um2());
                   }});
    add("adp_mm2_ns", "x time", "mm2 ns", area::adp_mm2_ns);
    return all;
  }
  // In percent of the baseline, for each box, as all comparisons of designs.
  const auto share = [&table](auto figure) {
    return [&table, figure](const Price& p) {
      return table.baseline ? area::percent(figure(p), figure(*table.baseline)) : "";
    };
  };
  add("area_mm2", "area", "mm2", area_of);
  add("area_pct", "", "", share([](const Price& p) { return p.area_per_box_um2(); }));
  add("adp_mm2_ns", "ADP", "mm2 ns", area::adp_mm2_ns);
  add("adp_pct", "", "", share([](const Price& p) { return p.area_delay_per_box(); }));
  add("boxes_per_test", "boxes", "", boxes);
  add("area_per_box_mm2", "area", "a box", area_of_box);
  return all;
}

/// Of these columns, in this order. `boxes_M` is the rate of boxes in millions a second.
std::string summary(const AreaTable& table, const std::vector<std::string_view>& keys) {
  std::vector<Column> all = columns_of(table);
  all.push_back(
      {"boxes_M", "boxes", "M/s", [](const RatedPrice& p) { return area::megaboxes_per_second(p.price); }});
  std::vector<std::vector<Cell>> rows(2 + table.units.size());
  for (const std::string_view key : keys) {
    const Column& column =
        *std::find_if(all.begin(), all.end(), [&](const Column& each) { return each.key == key; });
    const bool right = !column.is_word;
    rows[0].push_back({column.head, right});
    rows[1].push_back({column.unit, right});
    for (std::size_t i = 0; i < table.units.size(); ++i) {
      const std::string digits = column.digits(table.units[i]);
      rows[i + 2].push_back({key.ends_with("_pct") && !digits.empty() ? digits + "%" : digits, right});
    }
  }
  return fitted(rows);
}

std::vector<Price> prices_of(const AreaTable& table) {
  std::vector<Price> prices;
  for (const RatedPrice& unit : table.units) prices.push_back(unit.price);
  return prices;
}

std::string chip_note(const rtl::Chip& chip, const std::string& more) {
  return fmt::format("On {}.{}{}\n", chip.device, more, chip.estimated ? " Delays are estimated." : "");
}

/// Appends a count for every part that some unit has, 0 if there is none, and the names of the estimated parts.
void append_parts(Row& row, const std::vector<Line>& lines, const std::set<area::Part>& parts) {
  for (const area::Part& part : parts) row[area::part_name(part)] = 0;
  Row estimated = Row::array();
  for (const Line& line : lines) {
    row[area::part_name(line.part)] = line.n;
    if (line.estimated) estimated.push_back(area::part_name(line.part));
  }
  row["estimated"] = estimated;
}

std::set<area::Part> parts_of(const AreaTable& table) {
  std::set<area::Part> parts;
  for (const RatedPrice& unit : table.units)
    for (const Line& line : unit.price.lines) parts.insert(line.part);
  return parts;
}

/// In CSV a figure keeps its zeros at the end. In JSON it is a number.
Row figure(const std::string& digits, bool is_word, OutputFormat format) {
  if (digits.empty()) return nullptr;
  return is_word || format == OutputFormat::csv ? Row(digits) : Row::parse(digits);
}

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
                        to_string(price.format), price.stages, area::delay_ns(price.stage_delay_ps));
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

}  // namespace

std::vector<Row> area_rows(const AreaTable& table, OutputFormat format) {
  const std::vector<Column> columns = columns_of(table);
  const std::set<area::Part> parts = parts_of(table);
  std::vector<Row> rows;
  for (const RatedPrice& unit : table.units) {
    Row& row = rows.emplace_back();
    for (const Column& column : columns)
      row[column.key] = figure(column.digits(unit), column.is_word, format);
    append_parts(row, unit.price.lines, parts);
  }
  return rows;
}

std::vector<Row> stage_rows(const AreaTable& table, OutputFormat format) {
  const rtl::Chip* const chip = table.library->chip();
  const std::set<area::Part> parts = parts_of(table);
  std::vector<Row> rows;
  for (const RatedPrice& unit : table.units) {
    for (const area::StagePrice& stage : unit.price.by_stage) {
      Row& row = rows.emplace_back(Row::object());
      if (chip != nullptr) row["library"] = table.library->name();
      row.update(
          {{"design", unit.price.design}, {"bits", to_string(unit.price.format)}, {"stage", stage.stage}});
      if (chip != nullptr)
        row.update({{"lut", stage.taken.luts},
                    {"ff", stage.taken.registers},
                    {"dsp", stage.taken.blocks},
                    {"dsp_name", chip->block ? Row(chip->block->name) : Row(nullptr)}});
      else
        row["area_mm2"] = figure(area::area_mm2(stage.area_um2), false, format);
      append_parts(row, stage.lines, parts);
    }
  }
  return rows;
}

std::string area_text(const AreaTable& table, const std::string& notes) {
  const std::vector<Price> prices = prices_of(table);
  const rtl::Chip* const chip = table.library->chip();
  const auto counts = [](const Line& line) { return count(line.n); };
  if (table.rates) {
    const std::string note =
        chip == nullptr
            ? "Area is for each box; x time: times the time from one box to the next.\n"
            : chip_note(*chip, chip->block ? fmt::format(" Blocks are {}.", chip->block->name) : "");
    return (chip != nullptr
                ? summary(table, {"design", "bits", "ii", "stages", "clock_mhz", "lut", "lut_of_ii_1_pct",
                                  "ff", "dsp", "boxes_M"})
                : summary(table, {"design", "bits", "ii", "stages", "clock_mhz", "area_per_box_mm2",
                                  "area_of_ii_1_pct", "boxes_M", "adp_mm2_ns"})) +
           note + part_columns("count", prices, counts);
  }
  if (chip != nullptr) {
    std::vector<std::string_view> keys{
        "design", "bits", "stages", "stage_delay_ns", "clock_mhz", "latency_ns", "lut", "ff", "dsp"};
    if (chip->packs_registers) keys.emplace_back("logic_cells");
    return summary(table, keys) + chip_note(*chip, "") +
           (chip->packs_registers ? "A cell has a table and the register behind it.\n" : "") + notes +
           part_columns("count", prices, counts) +
           part_columns(
               "LUT", prices, [](const Line& line) { return count(line.taken.luts); },
               [](const Price& price) { return count(price.taken.luts); }) +
           part_columns(
               "FF", prices, [](const Line& line) { return count(line.taken.registers); },
               [](const Price& price) { return count(price.taken.registers); });
  }
  // Where a test answers for several boxes the clock is left out, because the delay says the same and the page
  // is narrow.
  const bool one_box = std::all_of(prices.begin(), prices.end(), [](const Price& p) { return p.boxes == 1; });
  const std::string head =
      one_box ? summary(table, {"design", "bits", "stages", "stage_delay_ns", "clock_mhz", "latency_ns",
                                "area_mm2", "area_pct", "adp_mm2_ns", "adp_pct"})
              : summary(table, {"design", "bits", "stages", "stage_delay_ns", "latency_ns", "area_mm2",
                                "boxes_per_test", "area_per_box_mm2", "area_pct", "adp_mm2_ns", "adp_pct"}) +
                    fmt::format("ADP{} for each box that a test answers for.\n",
                                table.baseline ? fmt::format(" and percent of {} are", table.baseline->design)
                                               : " is");
  return head + part_columns("count", prices, counts) +
         part_columns(
             "area mm2", prices, [](const Line& line) { return area::area_mm2(line.area_um2); },
             [](const Price& price) { return area::area_mm2(price.area_um2); });
}

std::string by_stage_text(const AreaTable& table) {
  const std::vector<Price> prices = prices_of(table);
  if (const rtl::Chip* const chip = table.library->chip()) {
    const std::string name = block_name(*chip);
    const auto columns = [&](const rtl::ChipCells& taken) {
      return fmt::format("{:>5}  {:>5}  {:>{}}", taken.luts, taken.registers, taken.blocks, name.size());
    };
    return stages_text(prices, {.heading = fmt::format("  LUT     FF  {}", name),
                                .row = [&](const area::StagePrice& stage) { return columns(stage.taken); },
                                .total = [&](const Price& price) { return columns(price.taken); }});
  }
  const auto column = [](std::int64_t area_um2) { return fmt::format("{:>8}", area::area_mm2(area_um2)); };
  return stages_text(prices, {.heading = "area mm2",
                              .row = [&](const area::StagePrice& stage) { return column(stage.area_um2); },
                              .total = [&](const Price& price) { return column(price.area_um2); }});
}

}  // namespace hitpipe::cli
