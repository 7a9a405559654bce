#include "thesis/printed.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>
#include <utility>

#include "thesis/printed_tables.hpp"

namespace hitpipe::thesis {
namespace {

/// Cuts at every `mark`; the text after the last one is a part too.
std::vector<std::string> split(std::string_view text, char mark) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(mark);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

PrintedRow::PrintedRow(Columns columns, std::vector<std::string> cells)
    : columns_(std::move(columns)), cells_(std::move(cells)) {
  if (cells_.size() != columns_->size()) throw std::logic_error("printed table: a row is cut short");
}

const std::string& PrintedRow::text(std::string_view column) const {
  const auto at = std::find(columns_->begin(), columns_->end(), column);
  if (at == columns_->end()) throw std::out_of_range("printed table: no column " + std::string(column));
  return cells_[static_cast<std::size_t>(at - columns_->begin())];
}

std::optional<double> PrintedRow::number(std::string_view column) const {
  const std::string& cell = text(column);
  if (cell.empty()) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size())
    throw std::logic_error("printed table: \"" + cell + "\" is no number");
  return value;
}

PrintedTable::PrintedTable(std::string_view csv) {
  while (!csv.empty() && csv.back() == '\n') csv.remove_suffix(1);
  const std::vector<std::string> lines = split(csv, '\n');
  columns_ = std::make_shared<const std::vector<std::string>>(split(lines.front(), ','));
  for (std::size_t i = 1; i < lines.size(); ++i) rows_.emplace_back(columns_, split(lines[i], ','));
}

const PrintedRow* PrintedTable::find(const std::vector<std::string_view>& keys) const {
  const auto has_keys = [&](const PrintedRow& row) {
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (row.text((*columns_)[i]) != keys[i]) return false;
    return true;
  };
  const auto at = std::find_if(rows_.begin(), rows_.end(), has_keys);
  return at == rows_.end() ? nullptr : &*at;
}

const PrintedTable& printed_table(std::string_view number) {
  static const std::map<std::string, PrintedTable, std::less<>> tables = [] {
    std::map<std::string, PrintedTable, std::less<>> made;
    for (const auto& [name, csv] : printed_csv) made.try_emplace(std::string(name), csv);
    return made;
  }();
  const auto at = tables.find(number);
  if (at == tables.end()) throw std::out_of_range("no printed table " + std::string(number));
  return at->second;
}

}  // namespace hitpipe::thesis
