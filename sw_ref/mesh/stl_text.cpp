#include "sw_ref/mesh/stl_text.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "host/text.hpp"
#include "sw_ref/mesh/decimal.hpp"
#include "sw_ref/mesh/finite.hpp"
#include "sw_ref/reject.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::string_view stl_line_ends = "\r\n";

bool is_stl_word(std::string_view word, std::string_view lower_case) {
  return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + 32) : a) == b;
  });
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
  /// The rest of the line without blanks around it.
  std::string_view rest_of_line() {
    std::string_view rest = text_.substr(at_);
    rest = rest.substr(0, rest.find_first_of(stl_line_ends));
    at_ += rest.size();
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    return rest.substr(0, rest.find_last_not_of(" \t") + 1);
  }
  [[nodiscard]] std::size_t line() const { return line_; }

  void expect(std::string_view lower_case) {
    const std::string_view word = next();
    if (!is_stl_word(word, lower_case)) refuse(word, lower_case);
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
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

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

}  // namespace

bool begins_as_stl_text(std::string_view bytes) {
  StlWords words(bytes);
  if (!is_stl_word(words.next(), "solid")) return false;
  if (bytes.find('\0') == std::string_view::npos) return true;
  words.rest_of_line();
  const std::string_view second = words.next();
  return is_stl_word(second, "facet") || is_stl_word(second, "endsolid") || is_stl_word(second, "end");
}

FileMesh read_stl_text(std::string_view text) {
  StlWords words(text);
  FileMesh mesh;
  do {
    words.expect("solid");
    mesh.groups.push_back({std::string(words.rest_of_line()), "", {}, mesh.faces()});
    for (;;) {
      const std::string_view word = words.peek();
      if (is_stl_word(word, "endsolid") || is_stl_word(word, "end")) break;
      if (!is_stl_word(word, "facet")) words.refuse(word, "facet\" or \"endsolid");
      read_stl_facet(words, mesh);
    }
    words.expect_end("solid");
    words.rest_of_line();
  } while (!words.peek().empty());
  return mesh;
}

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

}  // namespace hitpipe::ref
