// A datapath as a flat list of nodes in topological order. An edge is the index of the node that it comes
// from. Values are bit vectors of 1..128 bits without a sign; a node says when it reads its operands as two's
// complement. Equal nodes are recorded once. Two graphs are the same when their texts (to_text) are.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "rtl_gen/graph/word.hpp"

namespace hitpipe::rtl {

using NodeId = std::uint32_t;
inline constexpr NodeId no_node = ~NodeId{0};

enum class Op : std::uint8_t {
  input,
  constant,
  // wires: no area, no delay
  slice,   ///< bits low+width-1 .. low of a
  concat,  ///< {a, b}
  extend,  ///< a widened by its sign (is_signed) or by zeros
  invert,
  // gates: delay but no area (section 7.3)
  bit_and,
  bit_or,
  bit_xor,
  // components of the library
  add,   ///< operands and result have one width; wraps
  sub,   ///< likewise
  mul,   ///< width(a) + width(b), both signed or both unsigned
  less,  ///< 1 bit, a < b, operands of one width
  equal,
  mux,   ///< a ? b : c
  call,  ///< a submodule: a component with logic of its own and up to three operands
};

[[nodiscard]] std::string_view op_name(Op op);
[[nodiscard]] constexpr bool is_wire(Op op) {
  return op == Op::slice || op == Op::concat || op == Op::extend || op == Op::invert;
}
/// A value that can be latched: no constant, and no wire, which is taken from its source.
[[nodiscard]] constexpr bool is_root(Op op) {
  return !is_wire(op) && op != Op::constant;
}

/// The line of the C++ that names a value: "hls/pipelines/int_slabs.hpp", 33. Line 0: unknown.
struct SourceLine {
  std::string file;
  unsigned line = 0;
};

/// Some bits of a value, or these bits extended, as the C++ names them.
struct NamedPart {
  int high = 0;
  int low = 0;
  std::string name;
  SourceLine source;
};

struct Node {
  Op op = Op::input;
  int width = 1;
  bool is_signed = false;  ///< extend, mul, less: operands are two's complement; input: the port is
  int low = 0;             ///< slice: lowest bit taken
  int submodule = -1;      ///< call: index into the graph's submodules
  Word value = 0;          ///< constant
  std::array<NodeId, 3> args{no_node, no_node, no_node};
  std::string name{};  ///< from the C++, may be empty
  SourceLine source{};
  std::vector<NamedPart> parts{};  ///< of a value without a name: what the C++ names of it
  int min_stage = 0;  ///< earliest pipeline stage; set only in components that state their partition

  [[nodiscard]] int arity() const {
    return args[0] == no_node ? 0 : args[1] == no_node ? 1 : args[2] == no_node ? 2 : 3;
  }
  [[nodiscard]] std::span<const NodeId> operands() const {
    return {args.data(), static_cast<std::size_t>(arity())};
  }
};

struct Output {
  std::string name;
  NodeId node;
};

struct Submodule;

class Graph {
 public:
  explicit Graph(std::string name) : name_(std::move(name)) {}

  NodeId input(std::string_view name, int width, bool is_signed);
  NodeId constant(int width, Word value);
  NodeId slice(NodeId a, int high, int low);
  NodeId concat(NodeId high, NodeId low);
  NodeId extend(NodeId a, int width, bool is_signed);
  /// `a` in `width` bits: its low bits when that is narrower, else extended.
  NodeId resize(NodeId a, int width, bool is_signed);
  NodeId invert(NodeId a);
  NodeId binary(Op op, NodeId a, NodeId b, bool is_signed = false);
  NodeId mux(NodeId select, NodeId if_one, NodeId if_zero);
  /// The submodule's only output. Those with the same body name must be equal and become one; throws
  /// std::invalid_argument when they differ.
  NodeId call(const std::shared_ptr<const Submodule>& unit, std::span<const NodeId> operands);
  void output(std::string_view name, NodeId node);

  /// Names a value unless it has a name already (inputs keep their port's). The name of a slice is also that
  /// of a part of the value from which it is taken.
  void annotate(NodeId node, std::string_view name, const SourceLine& source);
  /// The same with all names of a node in another graph, for a node that does the same to fewer high bits.
  void annotate_as(NodeId node, const Node& other);
  /// Nodes recorded from here on start no earlier than this stage.
  void begin_stage(int stage) { min_stage_ = stage; }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Node& operator[](NodeId id) const { return nodes_[id]; }
  /// The width of the widest value.
  [[nodiscard]] int widest() const { return widest_; }
  [[nodiscard]] NodeId size() const { return static_cast<NodeId>(nodes_.size()); }
  [[nodiscard]] const std::vector<NodeId>& inputs() const { return inputs_; }
  [[nodiscard]] const std::vector<Output>& outputs() const { return outputs_; }
  [[nodiscard]] const std::vector<std::shared_ptr<const Submodule>>& submodules() const {
    return submodules_;
  }
  /// What a call node calls.
  [[nodiscard]] const std::shared_ptr<const Submodule>& submodule_of(NodeId id) const {
    return submodules_[static_cast<std::size_t>(nodes_[id].submodule)];
  }

 private:
  using Key = std::tuple<Op, int, bool, int, int, Word, std::array<NodeId, 3>, int>;
  NodeId record(Node node);
  void add_part(NodeId node, const NamedPart& part);

  std::string name_;
  std::vector<Node> nodes_;
  std::vector<NodeId> inputs_;
  std::vector<Output> outputs_;
  std::vector<std::shared_ptr<const Submodule>> submodules_;
  std::map<Key, NodeId> known_;
  int min_stage_ = 0;
  int widest_ = 0;
};

/// A component that is itself a graph, such as a float operator. It is emitted as a module of its own.
struct Submodule {
  std::string component;  ///< the library's name for it, e.g. "fp_subtract"
  int bits;               ///< the width at which the library is asked
  Graph body;             ///< canonical, one output; its name, e.g. "fp_subtract_8_23", identifies the unit
};

/// One line for each node: "%7 = sub:24 %1 %4  dx0 @ hls/pipelines/int_slabs.hpp:33".
[[nodiscard]] std::string to_text(const Graph& graph);

/// The value of every output for the given inputs (in port order). It defines what a graph means, and checks
/// that passes do not change it. Throws std::invalid_argument for a port that is wider than 64 bits.
[[nodiscard]] std::vector<std::uint64_t> evaluate(const Graph& graph, std::span<const std::uint64_t> inputs);

/// The same, of every node.
[[nodiscard]] std::vector<Word> evaluate_nodes(const Graph& graph, std::span<const std::uint64_t> inputs);

}  // namespace hitpipe::rtl
