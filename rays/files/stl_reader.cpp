#include "rays/files/stl_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/decimal.hpp"
#include "rays/files/finite.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::string_view stl_blanks = " \t\v\f";

bool is_stl_word(std::string_view word, std::string_view lower_case) {
  return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + 32) : a) == b;
  });
}

bool begins_with_stl_word(std::string_view word, std::string_view lower_case) {
  return is_stl_word(word.substr(0, lower_case.size()), lower_case);
}

class StlWords {
 public:
  explicit StlWords(std::string_view text) : text_(text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
  }

  /// The next word, which stays; empty at the end of the file.
  std::string_view peek() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n' || (c == '\r' && text_.substr(at_ + 1, 1) != "\n"))
        ++line_;
      else if (c != ' ' && c != '\t' && c != '\v' && c != '\f' && c != '\r')
        break;
    }
    const std::string_view rest = text_.substr(at_);
    return rest.substr(0, rest.find_first_of(" \t\v\f\r\n"));
  }
  std::string_view next() {
    const std::string_view word = peek();
    at_ += word.size();
    return word;
  }
  /// The name behind "solid". It goes up to the end of the line, or to a facet in it; or to the solid's end, if
  /// nothing of the solid is in the next line.
  std::string_view name_of_solid() {
    bool may_end = true;
    return name([&](const StlWords& here) {
      if (here.is_at_facet()) return true;
      if (!may_end || !here.is_at_end()) return false;
      StlWords behind = here;
      behind.at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
      const std::string_view word = behind.peek();
      return may_end = word.empty() || begins_with_stl_word(word, "solid");
    });
  }
  /// The name behind "endsolid", up to the end of the line or to another whole solid in it.
  void skip_name_of_end() {
    bool may_begin = true;
    name([&](const StlWords& here) {
      StlWords ahead = here;
      if (!may_begin || !is_stl_word(ahead.next(), "solid")) return false;
      ahead.name_of_solid();
      return may_begin = ahead.line_ == line_ && ahead.is_in_line();
    });
  }
  [[nodiscard]] bool is_at_facet() const {
    StlWords ahead = *this;
    return is_stl_word(ahead.next(), "facet") && is_stl_word(ahead.next(), "normal") &&
           decimal<double>(ahead.next());
  }
  [[nodiscard]] bool is_at_end() const {
    StlWords ahead = *this;
    const std::string_view word = ahead.next();
    return begins_with_stl_word(word, "endsolid") ||
           (is_stl_word(word, "end") && begins_with_stl_word(ahead.next(), "solid"));
  }
  [[nodiscard]] std::size_t line() const { return line_; }

  void expect(std::string_view lower_case) {
    const std::string_view word = next();
    if (!is_stl_word(word, lower_case)) refuse(word, lower_case);
  }
  /// A name may follow "solid" without a blank.
  void expect_solid() {
    const std::string_view word = peek();
    if (!begins_with_stl_word(word, "solid")) refuse(word, "solid");
    at_ += std::string_view("solid").size();
  }
  /// At is_at_end().
  void skip_end_of_solid() {
    peek();
    at_ += std::string_view("end").size();
    expect_solid();
    skip_name_of_end();
  }
  /// Such as "endloop" or "end loop".
  void expect_end(std::string_view what) {
    const std::string whole = "end" + std::string(what);
    const std::string_view word = next();
    if (is_stl_word(word, "end"))
      expect(what);
    else if (!is_stl_word(word, whole))
      refuse(word, whole);
  }
  [[noreturn]] void refuse(std::string_view word, std::string_view allowed) const {
    if (word.empty())
      reject(fmt::format("is cut short in line {}; a text STL must end with \"endsolid\"", line_));
    reject(fmt::format("line {}: unexpected word \"{}\"; allowed is \"{}\"", line_, host::shortened(word),
                       allowed));
  }

  double number() {
    const std::string_view word = next();
    if (word.empty()) refuse(word, "");
    const auto number = decimal<double>(word);
    if (!number) reject(fmt::format("line {}: \"{}\" is not a number", line_, host::shortened(word)));
    return *number;
  }
  /// A component of a normal, which is not used. Some programs write nan as "-1.#IND".
  void skip_number() {
    const std::string_view word = peek();
    if (word.starts_with("1.#") || word.starts_with("-1.#"))
      next();
    else
      number();
  }

 private:
  [[nodiscard]] bool is_in_line() const {
    return at_ < text_.size() && text_[at_] != '\r' && text_[at_] != '\n';
  }

  /// Words of this line up to one where `ends` is true.
  template <class Ends>
  std::string_view name(Ends ends) {
    const auto skip_blanks = [&] { at_ = std::min(text_.find_first_not_of(stl_blanks, at_), text_.size()); };
    skip_blanks();
    const std::size_t first = at_;
    std::size_t last = at_;
    while (is_in_line() && !ends(*this)) {
      next();
      last = at_;
      skip_blanks();
    }
    return text_.substr(first, last - first);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// Adds a corner with a position of its own. `unit` and `place` say where it stands, for a message.
void add_stl_corner(FileMesh& mesh, const glm::dvec3& corner, std::string_view unit, std::size_t place) {
  if (!has_finite_coordinates(corner))
    reject(fmt::format("{} {}: a vertex lies at ({}, {}, {}); coordinates must be finite", unit, place,
                       corner.x, corner.y, corner.z));
  const std::size_t number = mesh.positions.size();
  if (number == std::numeric_limits<std::uint32_t>::max())
    reject("the facets have more than 4294967295 corners, which is the most allowed");
  mesh.positions.push_back(corner);
  mesh.corners.push_back(static_cast<std::uint32_t>(number));
}

void read_stl_facet(StlWords& words, FileMesh& mesh) {
  words.expect("facet");
  words.expect("normal");
  for (int k = 0; k < 3; ++k) words.skip_number();
  words.expect("outer");
  words.expect("loop");
  for (int corner = 0; corner < 3; ++corner) {
    words.expect("vertex");
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) p[k] = words.number();
    add_stl_corner(mesh, p, "line", words.line());
  }
  words.expect_end("loop");
  words.expect_end("facet");
}

/// True if the bytes begin as the text form does, as far as they go: "solid", a name, "facet" or an end.
bool begins_as_stl_text(std::string_view bytes) {
  StlWords words(bytes);
  if (!begins_with_stl_word(words.peek(), "solid")) return false;
  if (bytes.find('\0') == std::string_view::npos) return true;
  words.expect_solid();
  words.name_of_solid();
  return words.is_at_end() || is_stl_word(words.next(), "facet");
}

FileMesh read_stl_text(std::string_view text) {
  StlWords words(text);
  FileMesh mesh;
  do {
    words.expect_solid();
    mesh.groups.push_back({std::string(words.name_of_solid()), "", {}, mesh.faces()});
    while (!words.is_at_end()) {
      const std::string_view word = words.peek();
      if (!is_stl_word(word, "facet")) words.refuse(word, "facet\" or \"endsolid");
      read_stl_facet(words, mesh);
    }
    words.skip_end_of_solid();
  } while (!words.peek().empty());
  return mesh;
}

constexpr std::size_t stl_header_bytes = 84;
constexpr std::size_t stl_facet_bytes = 50;

std::uint32_t stl_word(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;  // little-endian
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << 8U * i;
  return word;
}

/// Why a file is no text, which may have been meant as one.
[[noreturn]] void reject_stl(std::string_view bytes, const std::string& binary) {
  reject(fmt::format(
      "is neither a text STL ({}) nor a binary one whose length fits ({})",
      bytes.starts_with("solid") ? "it must have \"facet\" behind its name" : "it must begin with \"solid\"",
      binary));
}

FileMesh read_stl_binary(std::string_view bytes, std::size_t facets) {
  const std::size_t end = stl_header_bytes + stl_facet_bytes * facets;
  if (bytes.size() < end || bytes.size() - end >= stl_facet_bytes)
    reject_stl(bytes,
               fmt::format("it announces {} facets, which need {} bytes and up to 49 more; the file has {}",
                           facets, end, bytes.size()));
  FileMesh mesh;
  mesh.positions.reserve(3 * facets);
  mesh.corners.reserve(3 * facets);
  for (std::size_t facet = 0; facet < facets; ++facet) {
    std::size_t at = stl_header_bytes + stl_facet_bytes * facet + 12;  // behind the normal
    for (int corner = 0; corner < 3; ++corner, at += 12) {
      const auto number = [&](std::size_t k) {
        return static_cast<double>(std::bit_cast<float>(stl_word(bytes, at + 4 * k)));
      };
      add_stl_corner(mesh, {number(0), number(1), number(2)}, "byte", at);
    }
  }
  return mesh;
}

}  // namespace

FileMesh read_stl(std::string_view bytes) {
  const bool has_header = bytes.size() >= stl_header_bytes;
  const std::size_t facets = has_header ? stl_word(bytes, stl_header_bytes - 4) : 0;
  const bool exact = has_header && bytes.size() == stl_header_bytes + stl_facet_bytes * facets;
  if (!exact && begins_as_stl_text(bytes)) return read_stl_text(bytes);
  if (!has_header)
    reject_stl(bytes, fmt::format("it must have 84 bytes or more; the file has {}", bytes.size()));
  return read_stl_binary(bytes, facets);
}

}  // namespace hitpipe::ref
