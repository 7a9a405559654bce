// Where values are latched. At every stage boundary that a value crosses, exactly the bits that are read
// later are latched. In a unit that takes a test every N cycles a register can hold a value while the test
// passes N stages, so only every N-th boundary latches the value. A wire is never latched: its reader takes
// it from its source (so a sign bit is not latched beside its word). Results of one shared component, which
// are there in different cycles, have one register behind it where each is read for the last time before the
// next one comes. On a chip some registers lie in multiplier blocks, as Yosys puts them there.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/schedule.hpp"
#include "rtl_gen/schedule/sharing.hpp"

namespace hitpipe::rtl {

/// A result that another register of its component holds for a time.
struct Passing {
  NodeId value;
  int boundary;
  int last;  ///< the last stage that reads it there
};

/// A run of adjacent bits of one value, latched at the end of one stage (boundary 0: the input latches).
struct Register {
  NodeId value;
  int boundary;
  int high;
  int low;
  bool in_block = false;  ///< it is one of the registers of a chip's multiplier block
  Word unread = 0;        ///< bits, numbered as the value's, that are there only because the block has them
  int last = 0;           ///< the last stage that reads it, or a register that takes its bits
  /// The other results of the same shared component that are in this register, in other cycles. The bits are
  /// those of all of them.
  std::vector<Passing> others{};

  /// It holds a value, but loads it again from registers that hold theirs for as long. So it needs no enable.
  bool loads_again = false;

  /// In a unit that takes a test every N cycles: it loads in the phases of its values, their boundaries mod
  /// N, alone, because a later stage than the next reads one.
  [[nodiscard]] bool holds() const;
  /// Several results of one component pass through it.
  [[nodiscard]] bool is_shared() const { return !others.empty(); }
  /// All that it has.
  [[nodiscard]] std::vector<Passing> values() const;
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

/// A test begins every `binding.interval` cycles.
[[nodiscard]] Placement place_registers(const Graph& graph, const Schedule& schedule, Ports ports,
                                        const Binding& binding = {});

/// Whether two values that pass through one register would be in it in the same cycle.
[[nodiscard]] bool in_one_cycle(const Passing& x, const Passing& y, int interval);

/// Marks the registers that load again, and lets those before them hold their values for as long.
void drop_needless_enables(Placement& placement, const Graph& graph, const Schedule& schedule,
                           const Binding& binding);

/// Finds registers by what they hold.
class RegisterTable {
 public:
  /// The placement must outlive the table.
  RegisterTable(const Placement& placement, int interval);
  /// The place among the placement's registers of the one from which a stage reads these bits of a root;
  /// nothing: they come out of logic in this stage.
  [[nodiscard]] std::optional<std::size_t> find(NodeId value, int high, int low, int stage) const;

 private:
  struct Held {
    NodeId value;
    int boundary;
    std::size_t at;
  };
  const Placement& placement_;
  int interval_;
  std::vector<Held> held_;  ///< by value, then by boundary
};

/// Among how many values the instance's multiplexer selects this operand: operations that read the same bits
/// from the same registers, or from the same component, need one input.
[[nodiscard]] int selected_values(const Graph& graph, const SharedSchedule& shared,
                                  const RegisterTable& registers, const std::vector<NodeId>& operations,
                                  std::size_t place);

/// Marks the registers that only blocks read, and those behind a block. A block has no register for some bits
/// of its product alone, so a register behind it begins at bit 0; nothing reads the bits that are added.
/// A shared block reads its operands through a multiplexer, and a register behind it keeps a product for some
/// cycles: those registers lie outside. Without a chip, or without registers in its blocks, nothing changes.
void use_block_registers(Placement& placement, const Graph& graph, const Schedule& schedule,
                         const Library& library, const Binding& binding = {});

}  // namespace hitpipe::rtl
