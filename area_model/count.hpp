// Counts the parts of a scheduled design in each stage, in one of two accounts.
//   built    all that is emitted: every register, valid and tag bit, and every component at its real width;
//            on a chip also every gate
//   printed  as Table 7.2 counts, with its own ways (area_model/thesis_accounting.hpp)
// In both accounts `<` and `>` of the same two operands in one stage are one magnitude comparator.
#pragma once

#include <vector>

#include "area_model/part.hpp"
#include "area_model/thesis_accounting.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::area {

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

/// By stage, then by part. Every register is a `latch`, as register_of() says.
[[nodiscard]] std::vector<Count> count_built(const rtl::Pipeline& pipeline,
                                             rtl::Component latch = rtl::Component::latch,
                                             Gates gates = Gates::left_out);
/// The same without valid and tag bits, of any scheduled graph.
[[nodiscard]] std::vector<Count> count_logic(const rtl::Graph& graph, const rtl::Schedule& schedule,
                                             const rtl::Placement& placement, Gates gates);
[[nodiscard]] std::vector<Count> count_printed(const rtl::Pipeline& pipeline, const rtl::Format& format,
                                               const rtl::Printed& printed);

}  // namespace hitpipe::area
