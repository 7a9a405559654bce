#include "rays/tree/bvh_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/scene/triangle_numbers.hpp"

namespace hitpipe::ref {

namespace {

/// Reads a text file word by word, in pieces, so that neither long files nor long lines take memory. Words
/// are parted by blanks; # starts a comment that ends with its line.
class WordReader {
 public:
  static constexpr std::size_t longest_word = 256;

  /// Throws std::runtime_error, the reason without the file's name, when the file cannot be read. So do the
  /// functions below, and also for a longer word.
  explicit WordReader(const std::filesystem::path& file);

  /// Goes to the next line that has a word. False at the end of the file.
  bool next_line();
  /// The next word of the line; empty at its end. It is valid until the next call of a function.
  std::string_view word();
  /// Of the current line, from 1. At the end of the file, of the last line with a word.
  [[nodiscard]] std::uint64_t line() const { return line_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  static constexpr int end_of_file = -1;

  /// The byte at at_, or end_of_file.
  int peek();
  void refill();

  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  std::uint64_t line_ = 1;
  std::uint64_t last_with_words_ = 1;
  bool started_ = false;
};

bool is_blank(int c) {
  return c == ' ' || c == '\t' || c == '\r';
}

[[noreturn]] void reject_errno(int error) {
  reject(fmt::format("cannot be read: {}", std::generic_category().message(error)));
}

WordReader::WordReader(const std::filesystem::path& file) : buffer_(std::size_t{1} << 16U) {
  file_.reset(std::fopen(file.c_str(), "rbe"));
  if (!file_) reject_errno(errno);
}

bool WordReader::next_line() {
  while (started_ && !word().empty()) {
  }
  started_ = true;
  while (true) {
    // At a comment, the end of a line, the end of the file, or the first word.
    int c = peek();
    if (c == '#') {
      while (c != '\n' && c != end_of_file) {
        ++at_;
        c = peek();
      }
    }
    if (c == end_of_file) {
      line_ = last_with_words_;
      return false;
    }
    if (c != '\n' && !is_blank(c)) {
      last_with_words_ = line_;
      return true;
    }
    line_ += c == '\n' ? 1 : 0;
    ++at_;
  }
}

std::string_view WordReader::word() {
  while (is_blank(peek())) ++at_;
  // A word that is cut by the end of the buffer is moved to its front.
  if (end_ - at_ <= longest_word) refill();
  const std::size_t first = at_;
  while (at_ < end_ && !is_blank(buffer_[at_]) && buffer_[at_] != '\n' && buffer_[at_] != '#') {
    if (++at_ - first > longest_word)
      reject(fmt::format("line {}: a word of more than {} characters", line_, longest_word));
  }
  return {buffer_.data() + first, at_ - first};
}

int WordReader::peek() {
  if (at_ == end_) refill();
  return at_ == end_ ? end_of_file : static_cast<unsigned char>(buffer_[at_]);
}

void WordReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(at_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= at_;
  at_ = 0;
  end_ += std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (std::ferror(file_.get()) != 0) reject_errno(errno);
}

/// A word of a file for a message: at most 40 characters, all of them printable.
std::string quoted(std::string_view word) {
  std::string text = host::shortened(word);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return '"' + text + '"';
}

/// Nodes and triangles of a hierarchy have 31 bits.
constexpr std::uint32_t most_number = std::numeric_limits<std::int32_t>::max();

/// A number in decimal or, as C's %a prints it, in hexadecimal; rounded to the nearest binary32.
bool read_float(std::string_view word, float& value) {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  if (word.starts_with('-')) return false;
  const bool hexadecimal = word.starts_with("0x") || word.starts_with("0X");
  if (hexadecimal) word.remove_prefix(2);
  const char* const end = word.data() + word.size();
  const auto format = hexadecimal ? std::chars_format::hex : std::chars_format::general;
  auto [stop, error] = std::from_chars(word.data(), end, value, format);
  if (error == std::errc::result_out_of_range) {
    // Also for numbers so small that they round to 0.
    double wide = 0.0;
    error = std::from_chars(word.data(), end, wide, format).ec;
    value = static_cast<float>(wide);
  }
  if (negative) value = -value;
  return error == std::errc{} && stop == end;
}

class BvhFileReader {
 public:
  explicit BvhFileReader(const std::filesystem::path& path) : words_(path) { file_.path = path; }

  BvhFile read() {
    read_head();
    const std::uint32_t nodes = read_count_line("nodes");
    if (nodes == 0) fail("nodes 0; at least 1 is needed");
    for (std::uint32_t i = 0; i < nodes; ++i) {
      if (!words_.next_line()) fail(fmt::format("the file ends after {} of {} nodes", i, nodes));
      read_node(nodes);
    }
    read_triangles();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    reject(fmt::format("line {}: {}", words_.line(), reason));
  }

  void read_head() {
    constexpr const char* head = "the first line must be \"hitpipe-bvh 1\"";
    if (!words_.next_line() || words_.word() != "hitpipe-bvh") fail(head);
    if (words_.word() != "1") fail(fmt::format("{}; no other version is known", head));
    expect_end();
    constexpr const char* space = "expected \"space scene\" or \"space cube\"";
    if (!words_.next_line() || words_.word() != "space") fail(space);
    const std::string_view word = words_.word();
    if (word != "scene" && word != "cube") fail(space);
    file_.space = word == "cube" ? FileSpace::cube : FileSpace::scene;
    expect_end();
  }

  std::uint32_t read_count_line(const char* what) {
    if (!words_.next_line() || words_.word() != what)
      fail(fmt::format("expected \"{}\" and their number", what));
    const std::uint32_t count = whole_number(most_number, what);
    expect_end();
    return count;
  }

  void read_node(std::uint32_t nodes) {
    const std::string_view kind = words_.word();
    if (kind != "branch" && kind != "leaf")
      fail(fmt::format("node {}: {} is neither branch nor leaf", file_.nodes.size(), quoted(kind)));
    FileNode node{};
    node.is_leaf = kind == "leaf";
    node.line = static_cast<std::uint32_t>(words_.line());
    node.split = FileNode::no_split;
    for (int axis = 0; axis < 3; ++axis) node.box.min[axis] = coordinate();
    for (int axis = 0; axis < 3; ++axis) node.box.max[axis] = coordinate();
    if (node.is_leaf) {
      node.first = whole_number(most_number, "first triangle");
      node.count = whole_number(most_number, "number of triangles");
      expect_end();
    } else {
      read_children(node, nodes);
    }
    if (!node.is_leaf || node.count > 0) check_box(node.box);
    file_.nodes.push_back(node);
  }

  void read_children(FileNode& node, std::uint32_t nodes) {
    node.first = static_cast<std::uint32_t>(file_.children.size());
    std::string_view word = words_.word();
    for (; !word.empty() && word != "split"; word = words_.word()) {
      const std::uint32_t child = whole_number(word, most_number, "child");
      if (child >= nodes)
        fail(fmt::format("node {}: there is no node {}; the nodes are 0 to {}", file_.nodes.size(), child,
                         nodes - 1));
      if (file_.children.size() == most_number) fail(fmt::format("more than {} children", most_number));
      file_.children.push_back(child);
    }
    node.count = static_cast<std::uint32_t>(file_.children.size()) - node.first;
    if (node.count == 0) fail(fmt::format("node {}: a branch needs a child", file_.nodes.size()));
    if (word.empty()) return;
    if (node.count != 2)
      fail(fmt::format("node {}: split is for a branch of two children; this one has {}", file_.nodes.size(),
                       node.count));
    const std::string_view axis = words_.word();
    if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z')
      fail(fmt::format("node {}: split {} is none of x, y, z", file_.nodes.size(), quoted(axis)));
    node.split = static_cast<std::int8_t>(axis[0] - 'x');
    expect_end();
  }

  void check_box(const Aabb& box) const {
    for (int axis = 0; axis < 3; ++axis) {
      const float low = box.min[axis];
      const float high = box.max[axis];
      if (!std::isfinite(low) || !std::isfinite(high))
        fail(fmt::format("node {}: {} to {} along {}; coordinates must be finite", file_.nodes.size(), low,
                         high, "xyz"[axis]));
      if (low > high)
        fail(fmt::format("node {}: the box is inverted: min.{} {} is above max.{} {}", file_.nodes.size(),
                         "xyz"[axis], low, "xyz"[axis], high));
    }
  }

  void read_triangles() {
    const std::uint32_t count = read_count_line("triangles");
    bool more = words_.next_line();
    while (more) {
      const std::string_view word = words_.word();
      if (word.empty()) {
        more = words_.next_line();
        continue;
      }
      if (file_.triangles.size() == count)
        fail(fmt::format("more than the {} triangles that were announced", count));
      file_.triangles.push_back(whole_number(word, most_number, "triangle"));
    }
    if (file_.triangles.size() < count)
      fail(fmt::format("the file ends after {} of {} triangles", file_.triangles.size(), count));
  }

  float coordinate() {
    const std::string_view word = words_.word();
    float value = 0.0F;
    if (!read_float(word, value))
      fail(fmt::format("node {}: expected a coordinate, found {}", file_.nodes.size(), found(word)));
    return value;
  }

  std::uint32_t whole_number(std::uint32_t largest, const char* what) {
    return whole_number(words_.word(), largest, what);
  }
  [[nodiscard]] std::uint32_t whole_number(std::string_view word, std::uint32_t largest,
                                           const char* what) const {
    std::uint32_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc{} || stop != end || value > largest)
      fail(fmt::format("{}: expected a whole number from 0 to {}, found {}", what, largest, found(word)));
    return value;
  }

  void expect_end() {
    const std::string_view word = words_.word();
    if (!word.empty()) fail(fmt::format("expected the end of the line, found {}", quoted(word)));
  }
  static std::string found(std::string_view word) {
    return word.empty() ? "the end of the line" : quoted(word);
  }

  BvhFile file_;
  WordReader words_;
};

}  // namespace

std::string of_bvh_file(const std::filesystem::path& file, const std::string& reason) {
  return fmt::format("BVH file \"{}\": {}", file.string(), reason);
}

void BvhFile::reject(const FileNode& node, const std::string& reason) const {
  throw std::runtime_error(
      of_bvh_file(path, fmt::format("line {}: node {} {}", node.line, number(node), reason)));
}

BvhFile read_bvh_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) reject(of_bvh_file(file, "no such file"));
  BvhFile read = [&] {
    try {
      return BvhFileReader(file).read();
    } catch (const std::runtime_error& error) {
      reject(of_bvh_file(file, error.what()));
    }
  }();
  for (const FileNode& node : read.nodes) {
    const std::uint64_t end = std::uint64_t{node.first} + node.count;
    if (node.is_leaf && node.count > 0 && end > read.triangles.size())
      read.reject(node, fmt::format("takes the entries {} to {} of the list of triangles, which has {}",
                                    node.first, end - 1, read.triangles.size()));
  }
  return read;
}

std::string bvh_text(const Bvh& bvh, const Mesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "hitpipe-bvh 1\nspace cube\nnodes {}\n", bvh.nodes.size());
  for (const BvhNode& node : bvh.nodes) {
    const Aabb& box = node.box;
    fmt::format_to(out, "{} {} {} {} {} {} {} {} ", node.is_leaf() ? "leaf" : "branch", box.min.x, box.min.y,
                   box.min.z, box.max.x, box.max.y, box.max.z, node.first);
    if (node.is_leaf()) {
      fmt::format_to(out, "{}\n", node.count);
    } else {
      fmt::format_to(out, "{} split {}\n", node.first + 1, "xyz"[node.split_axis()]);
    }
  }
  fmt::format_to(out, "triangles {}\n", bvh.order.size());
  const TriangleNumbers numbers(mesh);
  constexpr std::size_t a_line = 10;
  for (std::size_t i = 0; i < bvh.order.size(); ++i) {
    const bool last = (i + 1) % a_line == 0 || i + 1 == bvh.order.size();
    fmt::format_to(out, "{}{}", numbers.of_source(bvh.order[i]), last ? '\n' : ' ');
  }
  return text;
}

}  // namespace hitpipe::ref
