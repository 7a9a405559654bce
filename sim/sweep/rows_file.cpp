#include "sim/sweep/rows_file.hpp"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "host/files.hpp"
#include "host/text.hpp"

namespace hitpipe::sim {

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  }
  return text;
}

std::string rows_header() {
  std::vector<std::string> names;
  for (const SweepColumn& column : sweep_columns) names.emplace_back(column.name);
  return host::csv_line(names);
}

std::string to_csv(std::span<const SweepRow> rows) {
  std::string text = rows_header();
  for (const SweepRow& row : rows) text += host::csv_line(to_cells(row));
  return text;
}

std::vector<SweepRow> parse_rows(const std::string& text, const std::string& source) {
  const auto reject = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("{}: {}; give a file that hitpipe sweep wrote", source, why));
  };
  if (!text.ends_with('\n')) reject("the last line is cut short");
  std::vector<SweepRow> rows;
  std::istringstream in(text);
  std::string line;
  if (!std::getline(in, line) || line + '\n' != rows_header())
    throw std::runtime_error(
        fmt::format("{}: line 1 is not the header of a sweep by this version, so its rows must be measured "
                    "again; give another file or remove it",
                    source));
  for (int number = 2; std::getline(in, line); ++number) {
    try {
      rows.push_back(from_cells(host::csv_cells(line)));
    } catch (const std::runtime_error& error) {
      reject(fmt::format("line {}: {}", number, error.what()));
    }
    const SweepSubject& first = rows.front();
    if (first != rows.back())
      reject(fmt::format("line {} has a row of \"{}\", line 2 of \"{}\"", number, rows.back().text(),
                         first.text()));
  }
  return rows;
}

std::vector<SweepRow> read_rows(const std::filesystem::path& file) {
  return parse_rows(host::read_file(file, "cannot read the rows"), file.string());
}

void write_rows(const std::filesystem::path& file, std::span<const SweepRow> rows) {
  host::write_file(file, to_csv(rows));
}

}  // namespace hitpipe::sim
