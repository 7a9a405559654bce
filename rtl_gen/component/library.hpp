// A component library: area, delay and stages of circuits by width. One data file
// (component/libraries/*.json) drives the schedule and the prices; the default is the thesis's Table 7.1.
// Delays are in picoseconds and areas in square micrometres. Both are integers, so that no result depends on
// the order of a sum.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
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
  fp_compare,
  fp_subtract_rz,  ///< rounds toward zero
  fp_multiply_rz,  ///< rounds toward zero; asked at the width of the significands, M + 1
  gate,            ///< AND, OR, XOR; only a chip counts them
  latch_enable     ///< a latch that keeps its bits while its enable is low
};
inline constexpr std::size_t component_count = 12;
[[nodiscard]] std::string_view component_name(Component component);
/// Throws std::invalid_argument for any other name.
[[nodiscard]] Component component_called(std::string_view name);

/// A multiplier in silicon.
struct Block {
  std::string name;  ///< the maker's, for example "DSP48E1"
  int width_a = 0;   ///< of signed operands; not less than width_b
  int width_b = 0;
  bool reads_unsigned =
      false;  ///< also multiplies unsigned operands of these widths; else they are one bit narrower
  bool operand_registers = false;  ///< the registers before it may lie in the block
  bool product_registers = false;  ///< and those behind it
  int stages = 1;
  int delay_ps = 0;  ///< of the slowest stage
  int luts = 0;      ///< an odd piece of a product takes a block only if logic would take more than these

  /// Whether one block multiplies operands of these widths. If one operand is signed, the other is read as
  /// signed with a zero above it.
  [[nodiscard]] bool multiplies(int a, bool a_signed, int b, bool b_signed) const;
  friend bool operator==(const Block&, const Block&) = default;
};

/// What a programmable chip has: lookup tables, carry chains, registers and multiplier blocks, each with its
/// delay and with the lookup tables that a bit takes. Delays include the wires of a usual net.
struct Chip {
  std::string device;
  bool estimated = false;  ///< the delays
  int lut_inputs = 0;
  bool packs_registers = false;  ///< a register has the lookup table before it in its own cell, and no other
  /// A table takes all gates of a stage that its inputs suffice for. Then the tables for 100 bits below only
  /// guide how products are cut and what operations share.
  bool maps_tables = false;
  bool carry_takes_logic = false;   ///< the table of an adder's bit takes the gates before it
  int shortest_shift_register = 0;  ///< so many registers in a row are a table; 0: none are
  int register_delay_ps = 0;        ///< clock to output, the first net, and setup
  int gate_delay_ps = 0;
  int mux_delay_ps = 0;
  int carry_delay_ps = 0;          ///< of an adder or subtractor without bits
  int compare_delay_ps = 0;        ///< of a comparator without bits: its carry leaves the chain
  int carry_delay_ps_per_bit = 0;  ///< and what each bit adds
  int subtrahend_delay_ps = 0;     ///< the tables that invert a subtrahend, or the second of two compared
  int gate_luts_pct = 0;  ///< lookup tables for 100 bits; less than 100 where tables take several gates
  int mux_luts_pct = 0;
  int carry_luts_pct = 0;
  std::optional<Block> block;

  /// An adder or subtractor.
  [[nodiscard]] int carry_delay(int bits) const { return carry_delay_ps + carry_delay_ps_per_bit * bits; }
  [[nodiscard]] int compare_delay(int bits) const { return compare_delay_ps + carry_delay_ps_per_bit * bits; }
  [[nodiscard]] int gate_luts(int bits) const { return rounded_up(bits * gate_luts_pct); }
  [[nodiscard]] int mux_luts(int bits) const { return rounded_up(bits * mux_luts_pct); }
  [[nodiscard]] int carry_luts(int bits) const { return rounded_up(bits * carry_luts_pct); }
  friend bool operator==(const Chip&, const Chip&) = default;

 private:
  [[nodiscard]] static int rounded_up(int percent) { return (percent + 99) / 100; }
};

/// What a component takes of a chip; of an ASIC process, nothing.
struct ChipCells {
  std::int64_t luts = 0;
  std::int64_t registers = 0;
  std::int64_t blocks = 0;  ///< multipliers

  ChipCells& operator+=(const ChipCells& more) {
    luts += more.luts;
    registers += more.registers;
    blocks += more.blocks;
    return *this;
  }
  friend ChipCells operator*(std::int64_t n, const ChipCells& one) {
    return {n * one.luts, n * one.registers, n * one.blocks};
  }
  friend bool operator==(const ChipCells&, const ChipCells&) = default;
};

/// One row of the library. With `stages` 0 it is combinational; else `delay_ps` is the delay of the slowest
/// stage.
struct Cell {
  int bits = 0;
  int area_um2 = 0;
  int delay_ps = 0;
  int stages = 0;
  bool estimated = false;  ///< the data file says so, or the row follows from a law
  int ripple_ps = 0;       ///< of the delay: from the lowest bit to the highest, along a carry chain
  int subtrahend_ps = 0;   ///< what the second operand takes more, unless a table makes it
  ChipCells taken{};
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// A target of FuseSoC that synthesises for the library's chip.
struct SynthesisTarget {
  std::string name;
  std::string description;
  std::string flow;     ///< of Edalize
  std::string options;  ///< of the flow: a JSON object, which is YAML too
  friend bool operator==(const SynthesisTarget&, const SynthesisTarget&) = default;
};

/// Delay and stages above the widest row of the file.
enum class Above {
  same,    ///< bit-parallel (latch, mux): as in the widest row
  tree,    ///< carry or comparison tree: the delay grows with the depth, ceil(log2 bits)
  stages,  ///< array: the widest row's delay and bits per stage; stages are rounded up
};

/// Area between two rows of the file, and beyond the first and the last in proportion to that row.
enum class AreaLaw {
  linear,     ///< in the bits: latch, mux, carry tree
  quadratic,  ///< in the square of the bits: multiplier array
};

class Library {
 public:
  static constexpr std::int64_t most_area_um2 = 100'000'000;  ///< of a component

  /// Widths must ascend. The float components and latch_enable may be left
  /// out. Throws std::runtime_error with `origin`, the
  /// component and the wrong entry.
  [[nodiscard]] static Library from_json(std::string_view text, std::string_view origin);
  [[nodiscard]] static Library load(const std::filesystem::path& file);
  /// Table 7.1 of the thesis.
  [[nodiscard]] static const Library& thesis();

  /// Delay and stages at a width. A width without a row takes the next larger row; above the widest row the
  /// law holds.
  [[nodiscard]] Cell timing(Component component, int bits) const;
  /// The timing, and the area at exactly this width. Without a row the area follows the area law, rounded to
  /// the nearest square micrometre. Both throw std::runtime_error when the library does not have the
  /// component.
  [[nodiscard]] Cell cell(Component component, int bits) const;
  [[nodiscard]] bool has(Component component) const;
  [[nodiscard]] int latch_delay_ps() const { return timing(Component::latch, 1).delay_ps; }
  [[nodiscard]] int gate_delay_ps() const { return gate_delay_ps_; }
  /// From one bit of a carry chain to the next; 0 for a library of cells, whose carries are trees.
  [[nodiscard]] int carry_delay_ps_per_bit() const { return chip_ ? chip_->carry_delay_ps_per_bit : 0; }
  /// The same with a block that is worth so many lookup tables. Its name says so, as it would be typed after
  /// --library. Throws std::runtime_error, one line, if the library has no blocks.
  [[nodiscard]] Library with_block_luts(int luts) const;
  /// The chip; null for a library of cells with areas.
  [[nodiscard]] const Chip* chip() const { return chip_ ? &*chip_ : nullptr; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The process of the cells; empty if the file does not say. A chip has a device instead.
  [[nodiscard]] const std::string& process() const { return process_; }
  /// Targets of the FuseSoC cores that are made with the library; none if the file names none.
  [[nodiscard]] const std::vector<SynthesisTarget>& synthesis_targets() const { return synthesis_targets_; }
  /// Where the figures come from, in the words of the file; may be empty.
  [[nodiscard]] const std::string& source() const { return source_; }
  friend bool operator==(const Library&, const Library&) = default;

 private:
  struct Family {
    Above above = Above::same;
    AreaLaw area = AreaLaw::linear;
    std::vector<Cell> cells;
    friend bool operator==(const Family&, const Family&) = default;
  };
  [[nodiscard]] const Family& family(Component component) const {
    return families_[static_cast<std::size_t>(component)];
  }
  /// Throws std::runtime_error when the library does not have the component.
  [[nodiscard]] const Family& found(Component component) const;

  [[nodiscard]] Cell on_chip(Component component, int bits) const;

  std::string name_;
  std::string process_;
  std::string source_;
  std::vector<SynthesisTarget> synthesis_targets_;
  std::optional<Chip> chip_;
  int gate_delay_ps_ = 0;
  std::array<Family, component_count> families_;
};

/// A library of the program: every file NAME.json in rtl_gen/component/libraries is compiled in under the
/// name NAME; there is no list of them.
struct BuiltInFile {
  std::string_view name;
  std::string_view json;
};
/// In the order of their names.
[[nodiscard]] std::span<const BuiltInFile> built_in_files();
[[nodiscard]] std::vector<std::string> built_in_names();

inline constexpr std::string_view default_library = "thesis_250nm";

/// The library of a built-in name, or of a file whose name ends in .json. Throws std::runtime_error with one
/// line; for an unknown name it says which names there are.
[[nodiscard]] Library library_called(std::string_view name_or_file);
/// The same with_block_luts(), if there are any.
[[nodiscard]] Library library_called(std::string_view name_or_file, std::optional<int> block_luts);

/// What a node costs: the component, and the width at which the library is asked. Wires and inputs cost
/// nothing. Gates cost something on a chip only; is_component() leaves them out.
struct ComponentUse {
  Component component;
  int bits;
};
[[nodiscard]] bool is_component(Op op);
[[nodiscard]] ComponentUse component_of(const Graph& graph, NodeId node);
/// Delay and stages of a node that takes time: a component or a gate.
[[nodiscard]] Cell timing_of(const Graph& graph, NodeId node, const Library& library);

}  // namespace hitpipe::rtl
