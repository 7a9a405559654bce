#include "sim/sweep/rows_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/files.hpp"

namespace hitpipe::sim {

namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

/// The cells of a line, without quotes. A quote that is not closed extends to the end of the line.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool in_quotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (in_quotes && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      in_quotes = !in_quotes;
    } else if (line[i] == ',' && !in_quotes) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

std::string header() {
  return fmt::format("{}", fmt::join(sweep_columns, ","));
}

}  // namespace

std::string to_csv(std::span<const SweepRow> rows) {
  std::string text = header() + "\n";
  for (const SweepRow& row : rows) {
    std::vector<std::string> cells = to_cells(row);
    std::transform(cells.begin(), cells.end(), cells.begin(), quoted);
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

std::string to_text(const RowsFile& rows) {
  return fmt::format("# {}\n{}", rows.about, to_csv(rows.rows));
}

RowsFile parse_rows(const std::string& text, const std::string& source) {
  const auto reject = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("{}: {}; give a file that hitpipe sweep wrote", source, why));
  };
  if (!text.ends_with('\n')) reject("the last line is cut short");
  RowsFile rows;
  std::istringstream in(text);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with("# ")) reject("line 1 does not say what was measured");
  rows.about = line.substr(2);
  if (!std::getline(in, line) || line != header())
    throw std::runtime_error(
        fmt::format("{}: line 2 is not the header of a sweep by this version, so its rows must be measured "
                    "again; give another file or remove it",
                    source));
  for (int number = 3; std::getline(in, line); ++number) {
    try {
      rows.rows.push_back(from_cells(cells_of(line)));
    } catch (const std::runtime_error& error) {
      reject(fmt::format("line {}: {}", number, error.what()));
    }
  }
  return rows;
}

RowsFile read_rows(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  if (!in || std::filesystem::is_directory(file))
    throw std::runtime_error(fmt::format("{}: cannot read the rows", file.string()));
  return parse_rows(text, file.string());
}

void write_rows(const std::filesystem::path& file, const RowsFile& rows) {
  host::write_file(file, to_text(rows));
}

}  // namespace hitpipe::sim
