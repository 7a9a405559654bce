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

bool is_blank(int c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool ends_word(int c) {
  return is_blank(c) || c == '\n' || c == '#';
}

/// Reads a text file word by word, in pieces, so that neither long files nor long lines take memory. Words are
/// parted by blanks; # starts a comment that ends with its line. Throws std::runtime_error, the reason without the
/// file's name, when the file cannot be read, and for a word that is too long.
class WordReader {
 public:
  explicit WordReader(const std::filesystem::path& file)
      : file_(std::fopen(file.c_str(), "rbe")), buffer_(std::size_t{1} << 16U) {
    if (!file_) reject_errno();
  }

  /// Behind the last word of a line: goes to the next line that has a word. False at the end of the file.
  bool next_line() {
    bool in_comment = false;
    for (; peek() != EOF && (in_comment || ends_word(peek())); ++at_) {
      if (peek() == '\n') ++line_;
      in_comment = peek() != '\n' && (in_comment || peek() == '#');
    }
    if (peek() == EOF)
      line_ = last_with_words_;
    else
      last_with_words_ = line_;
    return peek() != EOF;
  }
  /// The next word of the line; empty at its end. It is valid until the next call.
  std::string_view word() {
    while (is_blank(peek())) ++at_;
    // A word that is cut by the end of the buffer is moved to its front.
    if (end_ - at_ <= longest_word) refill();
    const std::size_t first = at_;
    while (at_ < end_ && !ends_word(static_cast<unsigned char>(buffer_[at_]))) {
      if (++at_ - first > longest_word)
        reject(fmt::format("line {}: a word of more than {} characters", line_, longest_word));
    }
    return {buffer_.data() + first, at_ - first};
  }
  /// Of the current line, from 1. At the end of the file, of the last line with a word.
  [[nodiscard]] std::uint64_t line() const { return line_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  static constexpr std::size_t longest_word = 256;

  /// The byte at at_, or EOF.
  int peek() {
    if (at_ == end_) refill();
    return at_ == end_ ? EOF : static_cast<unsigned char>(buffer_[at_]);
  }
  void refill() {
    char* const data = buffer_.data();
    std::copy(data + at_, data + end_, data);
    end_ -= at_;
    at_ = 0;
    end_ += std::fread(data + end_, 1, buffer_.size() - end_, file_.get());
    if (std::ferror(file_.get()) != 0) reject_errno();
  }
  [[noreturn]] static void reject_errno() {
    reject(fmt::format("cannot be read: {}", std::generic_category().message(errno)));
  }

  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  std::uint64_t line_ = 1;
  std::uint64_t last_with_words_ = 1;
};

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
  explicit BvhFileReader(BvhFile& file) : file_(file), words_(file.path) {}

  void read() {
    read_head();
    const std::uint32_t nodes = read_count_line("nodes");
    if (nodes == 0) fail("nodes 0; at least 1 is needed");
    for (std::uint32_t i = 0; i < nodes; ++i) {
      if (!words_.next_line()) fail("the file ends after {} of {} nodes", i, nodes);
      read_node(nodes);
    }
    read_triangles();
  }

 private:
  template <class... Parts>
  [[noreturn]] void fail(fmt::format_string<Parts...> reason, Parts&&... parts) const {
    reject(fmt::format("line {}: {}", words_.line(), fmt::format(reason, std::forward<Parts>(parts)...)));
  }
  template <class... Parts>
  [[noreturn]] void fail_node(fmt::format_string<Parts...> reason, Parts&&... parts) const {
    fail("node {}: {}", file_.nodes.size(), fmt::format(reason, std::forward<Parts>(parts)...));
  }

  void read_head() {
    constexpr const char* head = "the first line must be \"hitpipe-bvh 1\"";
    if (!words_.next_line() || words_.word() != "hitpipe-bvh") fail(head);
    if (words_.word() != "1") fail("{}; no other version is known", head);
    expect_end();
    constexpr const char* space = "expected \"space scene\" or \"space cube\"";
    if (!words_.next_line() || words_.word() != "space") fail(space);
    const std::string_view word = words_.word();
    if (word != "scene" && word != "cube") fail(space);
    file_.space = word == "cube" ? FileSpace::cube : FileSpace::scene;
    expect_end();
  }

  std::uint32_t read_count_line(const char* what) {
    if (!words_.next_line() || words_.word() != what) fail("expected \"{}\" and their number", what);
    const std::uint32_t count = whole_number(words_.word(), what);
    expect_end();
    return count;
  }

  void read_node(std::uint32_t nodes) {
    const std::string_view kind = words_.word();
    if (kind != "branch" && kind != "leaf") fail_node("{} is neither branch nor leaf", quoted(kind));
    FileNode node{};
    node.is_leaf = kind == "leaf";
    node.line = static_cast<std::uint32_t>(words_.line());
    node.split = FileNode::no_split;
    for (int axis = 0; axis < 3; ++axis) node.box.min[axis] = coordinate();
    for (int axis = 0; axis < 3; ++axis) node.box.max[axis] = coordinate();
    if (node.is_leaf) {
      node.first = whole_number(words_.word(), "first triangle");
      node.count = whole_number(words_.word(), "number of triangles");
      expect_end();
    } else {
      read_children(node, nodes);
    }
    if (node.count > 0)
      check_box(node.box);
    else
      node.first = 0;
    file_.nodes.push_back(node);
  }

  void read_children(FileNode& node, std::uint32_t nodes) {
    node.first = static_cast<std::uint32_t>(file_.children.size());
    std::string_view word = words_.word();
    for (; !word.empty() && word != "split"; word = words_.word()) {
      const std::uint32_t child = whole_number(word, "child");
      if (child >= nodes) fail_node("there is no node {}; the nodes are 0 to {}", child, nodes - 1);
      if (file_.children.size() == most_number) fail("more than {} children", most_number);
      file_.children.push_back(child);
    }
    node.count = static_cast<std::uint32_t>(file_.children.size()) - node.first;
    if (node.count == 0) fail_node("a branch needs a child");
    if (word.empty()) return;
    if (node.count != 2) fail_node("split is for a branch of two children; this one has {}", node.count);
    const std::string_view axis = words_.word();
    if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z')
      fail_node("split {} is none of x, y, z", quoted(axis));
    node.split = static_cast<std::int8_t>(axis[0] - 'x');
    expect_end();
  }

  void check_box(const Aabb& box) const {
    for (int axis = 0; axis < 3; ++axis) {
      const float low = box.min[axis];
      const float high = box.max[axis];
      if (!std::isfinite(low) || !std::isfinite(high))
        fail_node("{} to {} along {}; coordinates must be finite", low, high, "xyz"[axis]);
      if (low > high)
        fail_node("the box is inverted: min.{} {} is above max.{} {}", "xyz"[axis], low, "xyz"[axis], high);
    }
  }

  void read_triangles() {
    const std::uint32_t count = read_count_line("triangles");
    while (words_.next_line()) {
      for (std::string_view word = words_.word(); !word.empty(); word = words_.word()) {
        if (file_.triangles.size() == count) fail("more than the {} triangles that were announced", count);
        file_.triangles.push_back(whole_number(word, "triangle"));
      }
    }
    if (file_.triangles.size() < count)
      fail("the file ends after {} of {} triangles", file_.triangles.size(), count);
  }

  float coordinate() {
    const std::string_view word = words_.word();
    float value = 0.0F;
    if (!read_float(word, value)) fail_node("expected a coordinate, found {}", found(word));
    return value;
  }

  [[nodiscard]] std::uint32_t whole_number(std::string_view word, const char* what) const {
    std::uint32_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc{} || stop != end || value > most_number)
      fail("{}: expected a whole number from 0 to {}, found {}", what, most_number, found(word));
    return value;
  }

  void expect_end() {
    const std::string_view word = words_.word();
    if (!word.empty()) fail("expected the end of the line, found {}", quoted(word));
  }
  static std::string found(std::string_view word) {
    return word.empty() ? "the end of the line" : quoted(word);
  }

  BvhFile& file_;
  WordReader words_;
};

constexpr std::uint32_t no_parent = ~0U;

std::vector<std::uint32_t> parents(BvhFile& file) {
  std::vector<std::uint32_t> parent(file.nodes.size(), no_parent);
  for (const FileNode& node : file.nodes) {
    if (node.is_leaf) continue;
    for (const std::uint32_t child : file.entries(node)) {
      if (child == 0) file.reject(node, "has the root, node 0, as a child; that is a cycle");
      if (parent[child] != no_parent)
        file.reject(file.nodes[child],
                    "is a child of node {} and of node {}; it must be the child of one node", parent[child],
                    file.number(node));
      parent[child] = file.number(node);
    }
  }
  return parent;
}

/// A node that is not below the root has no parent, or the nodes above it are a cycle.
[[noreturn]] void reject_lost(const BvhFile& file, const std::vector<std::uint32_t>& parent,
                              const std::vector<bool>& found) {
  const auto without = std::find(parent.begin() + 1, parent.end(), no_parent);
  if (without != parent.end())
    file.reject(file.nodes[static_cast<std::size_t>(without - parent.begin())],
                "is the child of no node; only the root, node 0, may be");
  const auto lost = static_cast<std::uint32_t>(std::find(found.begin(), found.end(), false) - found.begin());
  std::vector<bool> seen(parent.size());
  std::uint32_t node = lost;
  for (; !seen[node]; node = parent[node]) seen[node] = true;
  file.reject(file.nodes[node], "is below itself; that is a cycle");
}

/// All nodes, each before its children. Every node but the first must be the child of exactly one node, and
/// below the first.
std::vector<std::uint32_t> nodes_from_root(BvhFile& file) {
  const std::vector<std::uint32_t> parent = parents(file);
  std::vector<bool> found(file.nodes.size());
  std::vector<std::uint32_t> nodes{0};
  nodes.reserve(file.nodes.size());
  found[0] = true;
  // Every node has one parent, so none is met twice.
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const FileNode& node = file.nodes[nodes[i]];
    if (node.is_leaf) continue;
    for (const std::uint32_t child : file.entries(node)) {
      found[child] = true;
      nodes.push_back(child);
    }
  }
  if (nodes.size() < file.nodes.size()) reject_lost(file, parent, found);
  return nodes;
}

/// Every entry of the list of triangles must be in exactly one leaf.
void check_leaf_ranges(const BvhFile& file) {
  std::vector<bool> taken(file.triangles.size());
  for (const FileNode& node : file.nodes) {
    if (!node.is_leaf) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (taken[i])
        file.reject(
            node,
            "takes entry {} of the list of triangles, which another leaf takes; list a triangle twice if two "
            "leaves have it",
            i);
      taken[i] = true;
    }
  }
  if (const auto left = std::find(taken.begin(), taken.end(), false); left != taken.end())
    file.reject(fmt::format("no leaf takes entry {} of the list of triangles", left - taken.begin()));
}

}  // namespace

void BvhFile::reject(const std::string& reason) const {
  throw std::runtime_error(fmt::format("BVH file \"{}\": {}", path.string(), reason));
}

BvhFile read_bvh_file(const std::filesystem::path& path) {
  BvhFile file{.path = path, .nodes = {}, .children = {}, .triangles = {}, .from_root = {}};
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) file.reject("no such file");
  try {
    BvhFileReader(file).read();
  } catch (const std::runtime_error& error) {
    file.reject(error.what());
  }
  for (const FileNode& node : file.nodes) {
    const std::uint64_t end = std::uint64_t{node.first} + node.count;
    if (node.is_leaf && end > file.triangles.size())
      file.reject(node, "takes the entries {} to {} of the list of triangles, which has {}", node.first,
                  end - 1, file.triangles.size());
  }
  file.from_root = nodes_from_root(file);
  check_leaf_ranges(file);
  return file;
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
