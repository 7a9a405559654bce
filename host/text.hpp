// Words, CSV cells and numbers in text, and a hash that names bytes.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::host {

/// The words of a text, separated by blanks.
[[nodiscard]] std::vector<std::string> words_of(std::string_view text);

/// The text as a message quotes it: the beginning of a long one, then how many bytes it has.
[[nodiscard]] std::string shortened(std::string_view text);

inline constexpr std::size_t line_width = 80;

/// Breaks text into lines of at most `width`. The first line starts at `column`; later lines are indented. A
/// longer word has a line of its own. Ends the last line.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t indent, std::size_t column = 0,
                                  std::size_t width = line_width);

/// A word as a POSIX shell takes it: in quotes if it has characters that a shell reads.
[[nodiscard]] std::string shell_word(const std::string& word);

/// The cells of a CSV line as csv_line() got them. A quote that is not closed extends to the end of the line.
[[nodiscard]] std::vector<std::string> csv_cells(std::string_view line);

/// A CSV line with its newline. A cell with a comma, a quote or a line end is quoted. Two numbers with a
/// slash between them get an n in front, n12/12, because a spreadsheet takes 12/12 for a date.
[[nodiscard]] std::string csv_line(std::span<const std::string> cells);

/// The number that the whole text is; nothing if it is none or too large for its type.
template <class Number>
[[nodiscard]] std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

inline constexpr std::uint64_t fnv1a_start = 0xcbf29ce484222325U;

/// FNV-1a with 64 bits (Fowler, Noll, Vo), continued from the hash of what comes before. It names contents;
/// it does not protect against forgery.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::span<const std::byte> bytes,
                                            std::uint64_t before = fnv1a_start) {
  std::uint64_t hash = before;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3U;
  return hash;
}

}  // namespace hitpipe::host
