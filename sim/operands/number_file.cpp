#include "sim/operands/number_file.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::sim {

namespace {

constexpr std::string_view blanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Calls visit(cell) for each cell of a line.
template <class Visit>
void for_each_cell(std::string_view line, Visit&& visit) {
  for (;;) {
    const std::size_t comma = line.find(',');
    visit(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

bool holds_no_numbers(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text.front() == '#';
}

}  // namespace

NumberFile::NumberFile(const std::string& file, std::vector<std::string> needed,
                       std::vector<std::string> optional)
    : reader_(file), names_(std::move(needed)) {
  const std::size_t count = names_.size();
  names_.insert(names_.end(), optional.begin(), optional.end());
  read_header(count);
}

void NumberFile::read_header(std::size_t needed) {
  const auto first = names_.begin() + static_cast<std::ptrdiff_t>(needed);
  const std::string allowed = needed == names_.size()
                                  ? fmt::format("{}", fmt::join(names_, ","))
                                  : fmt::format("{}[,{}]", fmt::join(names_.begin(), first, ","),
                                                fmt::join(first, names_.end(), ","));
  const std::optional<NumberLine> header = next();
  if (!header) throw std::runtime_error(fmt::format("{}: is empty; line 1 must be {}", name(), allowed));
  const auto refuse = [&](std::string_view cell, const char* why) {
    reject(*header,
           fmt::format("column \"{}\" {}; the first line must name the columns {}", cell, why, allowed));
  };
  std::string_view text = header->text;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // spreadsheets mark UTF-8 so
  for_each_cell(text, [&](std::string_view cell) {
    const auto place =
        static_cast<std::size_t>(std::find(names_.begin(), names_.end(), cell) - names_.begin());
    if (place == names_.size()) refuse(cell, "is not known");
    if (std::find(place_of_cell_.begin(), place_of_cell_.end(), place) != place_of_cell_.end())
      refuse(cell, "is there twice");
    place_of_cell_.push_back(place);
  });
  for (std::size_t place = 0; place < needed; ++place)
    if (std::find(place_of_cell_.begin(), place_of_cell_.end(), place) == place_of_cell_.end())
      refuse(names_[place], "is missing");
}

std::optional<NumberLine> NumberFile::next() {
  while (const auto line = reader_.next())
    if (!holds_no_numbers(*line)) return NumberLine{reader_.number(), std::string(*line)};
  return std::nullopt;
}

void NumberFile::words(const NumberLine& line, std::span<std::string_view> out) const {
  std::fill(out.begin(), out.end(), std::string_view());
  std::size_t cells = 0;
  for_each_cell(line.text, [&](std::string_view cell) {
    if (cells < place_of_cell_.size()) out[place_of_cell_[cells]] = cell;
    ++cells;
  });
  if (cells != place_of_cell_.size())
    reject(line, fmt::format("has {} cells; the first line names {} columns", cells, place_of_cell_.size()));
}

void NumberFile::reject(const NumberLine& line, const std::string& why) const {
  throw std::runtime_error(fmt::format("{}: line {}: {}", name(), line.number, why));
}

}  // namespace hitpipe::sim
