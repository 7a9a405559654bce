#include "sim/operands/number_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cfenv>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe::sim {

namespace {

/// A number without its sign, as from_chars() takes it.
struct Digits {
  std::string_view text;
  std::chars_format form = std::chars_format::general;
  bool negative = false;
};

Digits digits_of(std::string_view word) {
  Digits digits{word};
  if (word.starts_with('-') || word.starts_with('+')) {
    digits.negative = word.front() == '-';
    digits.text.remove_prefix(1);
  }
  if (digits.text.starts_with("0x") || digits.text.starts_with("0X")) {
    digits.form = std::chars_format::hex;
    digits.text.remove_prefix(2);
  }
  return digits;
}

/// What from_chars() may also take: inf, nan and a second sign.
bool starts_as_number(const Digits& digits) {
  if (digits.text.empty()) return false;
  const char first = digits.text.front();
  const bool digit = first >= '0' && first <= '9';
  const bool letter = (first >= 'a' && first <= 'f') || (first >= 'A' && first <= 'F');
  return digit || first == '.' || (letter && digits.form == std::chars_format::hex);
}

/// The C library rounds text to the side that is set.
class RoundTo {
 public:
  explicit RoundTo(Rounding side) : before_(std::fegetround()) {
    std::fesetround(side == Rounding::down ? FE_DOWNWARD : FE_UPWARD);
  }
  ~RoundTo() { std::fesetround(before_); }
  RoundTo(const RoundTo&) = delete;
  RoundTo& operator=(const RoundTo&) = delete;

 private:
  int before_;
};

}  // namespace

std::optional<double> read_double(std::string_view word) {
  const Digits digits = digits_of(word);
  if (!starts_as_number(digits)) return std::nullopt;
  double value = 0;
  const char* const end = digits.text.data() + digits.text.size();
  const auto [stop, error] = std::from_chars(digits.text.data(), end, value, digits.form);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  // Too large or too small: from_chars() leaves the value alone.
  if (error != std::errc{}) return std::strtod(std::string(word).c_str(), nullptr);
  return digits.negative ? -value : value;
}

float nearest_binary32(std::string_view word) {
  const Digits digits = digits_of(word);
  float value = 0;
  const char* const end = digits.text.data() + digits.text.size();
  const auto [stop, error] = std::from_chars(digits.text.data(), end, value, digits.form);
  if (error != std::errc{}) return std::strtof(std::string(word).c_str(), nullptr);
  return digits.negative ? -value : value;
}

double read_double(std::string_view word, Rounding side) {
  const std::string text(word);
  const RoundTo rounding(side);
  return std::strtod(text.c_str(), nullptr);
}

float to_binary32(double most, double rest, Rounding side) {
  const auto nearest = static_cast<float>(most);
  const double above = most - nearest;  // exact: a binary32 is the nearest of 53 bits
  // Rounding is monotone, so the rounded sum has the sign of the exact one.
  const double beyond = above + rest;
  if (side == Rounding::down)
    return beyond < 0 ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
  return beyond > 0 ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

namespace {

constexpr std::size_t longest_line = 1 << 16;

[[noreturn]] void cannot_read(const std::string& name, int error) {
  throw std::runtime_error(
      fmt::format("{}: cannot read the file: {}", name, std::generic_category().message(error)));
}

}  // namespace

LineReader::LineReader(const std::string& file)
    : name_(file == "-" ? "standard input" : file),
      file_(file == "-" ? stdin : std::fopen(file.c_str(), "rbe")),
      buffer_(longest_line) {
  if (file_ == nullptr) cannot_read(name_, errno);
  std::error_code ignored;
  if (file != "-" && std::filesystem::is_regular_file(file, ignored))
    size_ = std::filesystem::file_size(file, ignored);
}

LineReader::~LineReader() {
  if (file_ != stdin) static_cast<void>(std::fclose(file_));
}

bool LineReader::fill() {
  std::memmove(buffer_.data(), buffer_.data() + from_, to_ - from_);
  to_ -= from_;
  from_ = 0;
  const std::size_t got = std::fread(buffer_.data() + to_, 1, buffer_.size() - to_, file_);
  if (got == 0 && std::ferror(file_) != 0) cannot_read(name_, errno);
  to_ += got;
  return got > 0;
}

std::optional<std::string_view> LineReader::next() {
  std::size_t seen = 0;  // bytes without a line end
  for (;;) {
    const char* const begin = buffer_.data() + from_;
    const void* const end = std::memchr(begin + seen, '\n', to_ - from_ - seen);
    const bool ended = end != nullptr;
    std::size_t length =
        ended ? static_cast<std::size_t>(static_cast<const char*>(end) - begin) : to_ - from_;
    if (!ended) {
      seen = length;
      if (length == buffer_.size())
        throw std::runtime_error(
            fmt::format("{}: line {} is longer than {} bytes", name_, number_ + 1, longest_line));
      if (fill()) continue;
      if (length == 0) return std::nullopt;
    }
    const std::string_view line(buffer_.data() + from_, length);
    length += ended ? 1 : 0;
    from_ += length;
    given_ += length;
    ++number_;
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }
}

std::optional<double> LineReader::share() const {
  if (size_ == 0) return std::nullopt;
  return std::min(1.0, static_cast<double>(given_) / static_cast<double>(size_));
}

namespace {

constexpr std::string_view blanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The comma behind the first cell. A cell that begins with a quote may have commas in it.
std::size_t end_of_cell(std::string_view line) {
  if (!trimmed(line).starts_with('"')) return line.find(',');
  bool in_quotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') in_quotes = !in_quotes;  // a doubled one changes nothing
    if (line[i] == ',' && !in_quotes) return i;
  }
  return std::string_view::npos;
}

/// RFC 4180. Quotes inside stay doubled: no name and no number has one.
std::string_view without_quotes(std::string_view cell) {
  return cell.size() >= 2 && cell.starts_with('"') && cell.ends_with('"')
             ? trimmed(cell.substr(1, cell.size() - 2))
             : cell;
}

/// Calls visit(cell) for each cell of a line.
template <class Visit>
void for_each_cell(std::string_view line, Visit&& visit) {
  for (;;) {
    const std::size_t comma = end_of_cell(line);
    visit(without_quotes(trimmed(line.substr(0, comma))));
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
    reject(*header, fmt::format("column \"{}\" {}; the first line must name the columns {}",
                                host::shortened(cell), why, allowed));
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
  if (cells != place_of_cell_.size() && std::count(line.text.begin(), line.text.end(), '"') % 2 != 0)
    reject(line, "a quote is not closed; a cell must end in its line");
  if (cells != place_of_cell_.size())
    reject(line, fmt::format("has {} cells; the first line names {} columns", cells, place_of_cell_.size()));
}

void NumberFile::reject(const NumberLine& line, const std::string& why) const {
  throw std::runtime_error(fmt::format("{}: line {}: {}", name(), line.number, why));
}

}  // namespace hitpipe::sim
