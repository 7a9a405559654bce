// The parts of a design, under the names of Table 7.1, and how many of them each stage of a scheduled design
// has, in one of two accounts.
//   built    all that is emitted: every register, valid and tag bit, and every component at its real width;
//            on a chip also every gate
//   printed  as Table 7.2 counts: docs/reproduction.md says where it departs from the schematics that it
//            prices, and each design states its own departures (rtl::ThesisAccounting). Two rules hold in every row:
//            only latches, muxes, subtractors, multipliers and comparators have area (no valid bits, no tag),
//            and each row is rounded before the total is taken
// In both accounts `<` and `>` of the same two operands in one stage are one magnitude comparator.
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::area {

/// What a part is for. Valid and tag bits, which the thesis does not draw, are latches with rows of their
/// own.
enum class Purpose {
  datapath,
  valid,  ///< one bit at each boundary: there is a ray-box pair
  tag,    ///< the tag at each boundary
  phase,  ///< the counter of a unit that takes a test every N cycles
  block,  ///< a latch that is one of the registers of a chip's multiplier block, so it costs nothing more
};

struct Part {
  rtl::Component component;
  int bits;
  Purpose purpose = Purpose::datapath;
  int by = 0;  ///< the width of a multiplier's narrower operand; 0: both operands have `bits`

  friend bool operator==(const Part&, const Part&) = default;
  /// In the order of Table 7.1, then by width; valid and tag bits last.
  friend std::strong_ordering operator<=>(const Part& a, const Part& b);
};

/// "latch_24"; "valid_1" and "tag_16" for valid and tag bits; "phase_2"; "block_latch_24";
/// "int_multiply_24x18" for operands of two widths.
[[nodiscard]] std::string part_name(const Part& part);

/// Width of the tag, unless a user of the Verilog sets TAG_BITS.
inline constexpr int tag_bits = 16;

struct Count {
  Part part;
  int stage;  ///< 0: the input latches; a latch belongs to the stage that ends with it
  int n;

  friend bool operator==(const Count&, const Count&) = default;
};

enum class Gates { left_out, counted };

/// What a register of an emitted unit is in that library: with stalls one that has an enable, where the
/// library tells it from a latch.
[[nodiscard]] rtl::Component register_of(rtl::FlowControl flow, const rtl::Library& library);

/// By stage, then by part. Every register is a `latch`, as register_of() says. A component that several
/// operations share counts once, in the stage in which the first of them starts, with the 2:1 multiplexers
/// and the latches before it.
[[nodiscard]] std::vector<Count> count_built(const rtl::Pipeline& pipeline,
                                             rtl::Component latch = rtl::Component::latch,
                                             Gates gates = Gates::left_out);
/// The same without valid and tag bits, of any scheduled graph.
[[nodiscard]] std::vector<Count> count_logic(const rtl::Graph& graph, const rtl::Schedule& schedule,
                                             const rtl::Placement& placement, Gates gates);
/// The bits of the registers that latch what lookup tables make in the stage before, where nothing else reads
/// it: a chip may have such a table and its register in one cell.
[[nodiscard]] int packed_bits(const rtl::Graph& graph, const rtl::SharedSchedule& shared,
                              const rtl::Placement& placement);
[[nodiscard]] std::vector<Count> count_printed(const rtl::Pipeline& pipeline, const Format& format,
                                               const rtl::ThesisAccounting& printed);

/// The width at which Table 7.2 prices a latch, or a component.
[[nodiscard]] int printed_latch_bits(const rtl::Graph& graph, const rtl::Register& latch,
                                     const Format& format, const rtl::ThesisAccounting& printed);
[[nodiscard]] int printed_component_bits(const rtl::Graph& graph, rtl::NodeId node, const Format& format,
                                         const rtl::ThesisAccounting& printed);

}  // namespace hitpipe::area
