// A component library: area, delay and stages of circuits by width. One data file drives the schedule and the
// prices. The thesis's Table 7.1 is the default. Delays in picoseconds, areas in square micrometres, both
// integers, so that no schedule depends on the order of a sum.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

enum class Component {
  latch,
  mux2,
  int_subtract,
  int_multiply,
  int_compare,
  fp_subtract,
  fp_multiply,
  fp_compare
};
inline constexpr std::size_t component_count = 8;
[[nodiscard]] std::string_view component_name(Component component);
/// Throws std::invalid_argument for any other name.
[[nodiscard]] Component component_called(std::string_view name);

/// One row of the library. `stages` 0: combinational; else `delay_ps` is the slowest stage.
struct Cell {
  int bits = 0;
  int area_um2 = 0;
  int delay_ps = 0;
  int stages = 0;
  bool estimated = false;  ///< the source marks the row as an estimate, or a law made it
};

/// How delay and stages go on above the widest row listed.
enum class Above {
  same,    ///< bit-parallel (latch, mux): the widest row's
  tree,    ///< carry or comparison tree: delay grows with its depth ceil(log2 bits)
  stages,  ///< array: one stage for every started share of bits/stages of the widest row, its delay kept
};

/// How area goes on between the rows listed and, in proportion to the end row, beyond them.
enum class AreaLaw {
  linear,     ///< with the bits: latch, mux, carry tree
  quadratic,  ///< with their square: multiplier array
};

class Library {
 public:
  /// Throws std::runtime_error naming `origin`, the component and the offending entry. Widths must ascend.
  /// The float components may be left out.
  [[nodiscard]] static Library from_json(std::string_view text, std::string_view origin);
  [[nodiscard]] static Library load(const std::filesystem::path& file);
  /// Table 7.1 of the thesis.
  [[nodiscard]] static const Library& thesis();

  /// Delay and stages at a width: a width that is not listed takes the next larger row, above the widest the
  /// law.
  [[nodiscard]] Cell timing(Component component, int bits) const;
  /// The timing, and the area at just this width: the row's where it is listed, else by the area law and
  /// rounded to the nearest square micrometre. Both throw std::runtime_error for a component left out.
  [[nodiscard]] Cell cell(Component component, int bits) const;
  [[nodiscard]] bool has(Component component) const { return !family(component).cells.empty(); }
  [[nodiscard]] int latch_delay_ps() const { return timing(Component::latch, 1).delay_ps; }
  [[nodiscard]] int gate_delay_ps() const { return gate_delay_ps_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  struct Family {
    Above above = Above::same;
    AreaLaw area = AreaLaw::linear;
    std::vector<Cell> cells;
  };
  [[nodiscard]] const Family& family(Component component) const {
    return families_[static_cast<std::size_t>(component)];
  }
  /// Throws when it was left out.
  [[nodiscard]] const Family& found(Component component) const;

  std::string name_;
  int gate_delay_ps_ = 0;
  std::array<Family, component_count> families_;
};

/// What a node costs: the component and the width it is looked up at. Nodes without one are wires, gates,
/// inputs.
struct ComponentUse {
  Component component;
  int bits;
};
[[nodiscard]] bool is_component(Op op);
[[nodiscard]] ComponentUse component_of(const Graph& graph, NodeId node);
/// Delay and stages of any node that takes time: a component, or a gate of the library.
[[nodiscard]] Cell timing_of(const Graph& graph, NodeId node, const Library& library);

}  // namespace hitpipe::rtl
