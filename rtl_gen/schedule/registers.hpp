// Where values are latched. At every stage boundary that a value crosses, exactly the bits that are read
// later are latched. In a unit that takes a test every N cycles a register can hold a value while the test
// passes N stages, so only every N-th boundary latches the value. A wire is never latched: its reader takes
// it from its source (so a sign bit is not latched beside its word). On a chip some registers lie in
// multiplier blocks, as Yosys puts them there.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/schedule.hpp"
#include "rtl_gen/schedule/sharing.hpp"

namespace hitpipe::rtl {

/// A run of adjacent bits of one value, latched at the end of one stage (boundary 0: the input latches).
struct Register {
  NodeId value;
  int boundary;
  int high;
  int low;
  bool in_block = false;  ///< it is one of the registers of a chip's multiplier block
  Word unread = 0;        ///< bits, numbered as the value's, that are there only because the block has them
  bool holds =
      false;  ///< it loads in phase `boundary` mod N alone, because a later stage than the next reads it

  [[nodiscard]] int width() const { return high - low + 1; }
};

enum class Ports {
  latched,  ///< a whole pipeline: it latches its inputs and its outputs
  direct,   ///< a component inside a pipeline: inputs are there in stage 1, outputs leave unlatched
};

struct Placement {
  std::vector<Register> registers;  ///< by boundary, then by value, then from the low bits up
  std::vector<Word> used_bits;      ///< by node: the bits of its value that anything reads
};

/// `interval`: a test begins every so many cycles.
[[nodiscard]] Placement place_registers(const Graph& graph, const Schedule& schedule, Ports ports,
                                        int interval = 1);

/// Marks the registers that only blocks read, and those behind a block. A block has no register for some bits
/// of its product alone, so a register behind it begins at bit 0; nothing reads the bits that are added.
/// A shared block reads its operands through a multiplexer, and its product goes to several registers: those
/// registers lie outside. Without a chip, or without registers in its blocks, nothing changes.
void use_block_registers(Placement& placement, const Graph& graph, const Schedule& schedule,
                         const Library& library, const Binding& binding = {});

}  // namespace hitpipe::rtl
