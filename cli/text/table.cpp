#include "cli/text/table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

/// 1234567 becomes "1,234,567".
std::string grouped(std::string digits) {
  for (std::size_t at = digits.size(); at > 3 && digits[at - 4] != '-';) digits.insert(at -= 3, ",");
  return digits;
}

/// Replaces bytes that are not UTF-8, which a file name may hold and JSON may not. One line if there is no
/// indent.
std::string dump(const Row& value, int indent = -1) {
  return value.dump(indent, ' ', false, Row::error_handler_t::replace);
}

std::string readable(const Row& value) {
  if (value.is_null()) return "not judged";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) {
    const double number = value.get<double>();
    return std::abs(number) >= 1e5 ? grouped(fmt::format("{:.0f}", number)) : fmt::format("{:.2f}", number);
  }
  return value.is_number() ? grouped(dump(value)) : dump(value);
}

std::string csv_cell(const Row& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return dump(value);
  std::string words;
  for (const Row& entry : value) words += (words.empty() ? "" : " ") + csv_cell(entry);
  return words;
}

std::string csv_text(const std::vector<Row>& rows) {
  std::string text;
  if (rows.empty()) return text;
  std::vector<std::string> cells;
  for (const auto& [key, value] : rows.front().items()) cells.push_back(key);
  text += host::csv_line(cells);
  for (const Row& row : rows) {
    cells.clear();
    for (const auto& [key, value] : row.items()) cells.push_back(csv_cell(value));
    text += host::csv_line(cells);
  }
  return text;
}

}  // namespace

std::string aligned(const std::vector<std::vector<Cell>>& rows, std::size_t gap) {
  std::vector<std::size_t> widths(rows.empty() ? 0 : rows.front().size());
  for (const std::vector<Cell>& row : rows)
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].text.size());
  std::string text;
  for (const std::vector<Cell>& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < widths.size(); ++i) {
      if (i > 0) line.append(gap, ' ');
      line += row[i].right ? fmt::format("{:>{}}", row[i].text, widths[i])
                           : fmt::format("{:<{}}", row[i].text, widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string table_text(const std::vector<Row>& rows, OutputFormat format) {
  if (format == OutputFormat::json) return dump(rows, 2) + "\n";
  if (format == OutputFormat::csv) return csv_text(rows);
  if (rows.empty()) return "";
  std::vector<std::vector<Cell>> lines(1);
  for (const auto& [key, value] : rows.front().items()) lines[0].push_back({key, value.is_number()});
  for (const Row& row : rows) {
    std::vector<Cell>& line = lines.emplace_back();
    for (const Row& value : row) line.push_back({readable(value), value.is_number()});
  }
  return aligned(lines);
}

std::string columns_text(const std::vector<Row>& rows) {
  std::vector<std::vector<Cell>> lines;
  for (const auto& [key, value] : rows.front().items()) {
    std::vector<Cell> line{{lines.empty() ? "" : key}};
    bool has_value = false;
    for (const Row& row : rows) {
      line.push_back({readable(row.at(key)), true});
      has_value = has_value || !row.at(key).is_null();
    }
    if (has_value) lines.push_back(std::move(line));
  }
  return aligned(lines);
}

std::string record_text(const Row& row, OutputFormat format) {
  if (format == OutputFormat::json) return dump(row, 2) + "\n";
  if (format == OutputFormat::csv) return csv_text({row});
  std::size_t width = 0;
  for (const auto& [key, value] : row.items()) width = std::max(width, key.size());
  std::string text;
  const auto line = [&](const std::string& key, const Row& value) {
    text += fmt::format("{:<{}}  {}\n", key, width, readable(value));
  };
  for (const auto& [key, value] : row.items()) {
    if (!value.is_array()) line(key, value);
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) line(i == 0 ? key : "", value[i]);
  }
  return text;
}

}  // namespace hitpipe::cli
