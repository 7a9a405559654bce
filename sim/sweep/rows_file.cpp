#include "sim/sweep/rows_file.hpp"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "host/files.hpp"
#include "host/text.hpp"

namespace hitpipe::sim {

namespace {

std::string header(std::span<const SweepColumn> columns) {
  std::vector<std::string> names;
  for (const SweepColumn& column : columns) names.emplace_back(column.name);
  return host::csv_line(names);
}

}  // namespace

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  }
  return text;
}

std::string head_text(const std::string& about, bool intervals) {
  return fmt::format("# {}\n{}", about, header(columns_with(intervals)));
}

std::string to_csv(std::span<const SweepRow> rows) {
  const std::span<const SweepColumn> columns = columns_of(rows);
  std::string text = header(columns);
  for (const SweepRow& row : rows) text += host::csv_line(to_cells(row, columns));
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
  const bool has_header = static_cast<bool>(std::getline(in, line));
  const bool intervals = has_header && line + '\n' == header(columns_with(true));
  const std::span<const SweepColumn> columns = columns_with(intervals);
  if (!has_header || line + '\n' != header(columns))
    throw std::runtime_error(
        fmt::format("{}: line 2 is not the header of a sweep by this version, so its rows must be measured "
                    "again; give another file or remove it",
                    source));
  for (int number = 3; std::getline(in, line); ++number) {
    try {
      rows.rows.push_back(from_cells(host::csv_cells(line), columns));
    } catch (const std::runtime_error& error) {
      reject(fmt::format("line {}: {}", number, error.what()));
    }
  }
  return rows;
}

RowsFile read_rows(const std::filesystem::path& file) {
  return parse_rows(host::read_file(file, "cannot read the rows"), file.string());
}

void write_rows(const std::filesystem::path& file, const RowsFile& rows) {
  host::write_file(file, to_text(rows));
}

}  // namespace hitpipe::sim
