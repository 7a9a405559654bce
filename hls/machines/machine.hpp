// What a machine says of itself. A machine is control: a state, and a step that is one clock cycle. It is
// written over the same value domains as a datapath, so one source is software, Verilog, proof and price.
//   In, Out, State, Memory   lists of ports, registers and memories (record.hpp, memory.hpp)
//   outputs<D>(format, now, memory, out)
//                            gives the outputs of the cycle, from registers and words alone
//   step<D>(format, now, in, memory, next)
//                            gives the next state
// step() reads the old state, `now`, and writes `next`, which it cannot read. So the order of its statements
// means nothing. It writes a register once. One that it does not write keeps its value.
// All that they compute is one combinational graph. The only registers are the state and the words that
// memories give. What a machine gives to another one does not depend on what it is given in the same cycle,
// so the order in which machines step does not matter, and no path leads through two of them.
//
// A memory has one port to write and one to read. A word that is read while it is written is the old one.
//   memory[m].write(enable, place, word)
//   memory[m].read(place)   kind lookup: the word at that place, in the same cycle
//   memory[m].ask(place)    kinds block and rom: which word the next cycle wants
//   memory[m].word()        kinds block and rom: the word that the last cycle asked for
// A memory of kind single has one port for both:
//   memory[m].access(writes, place, word)  writes the word if `writes` is 1, else asks for that at the place
//   memory[m].word()                       the word that the last cycle without a write asked for
#pragma once

#include <cstdint>

namespace hitpipe {
namespace hls {

/// A register of the state, or a port.
struct Field {
  const char* name;
  int width;  ///< bits, 1..128; of a port 1..64
  bool is_signed = false;
  bool has_reset = false;  ///< of a register: a reset gives it the value; else it keeps what it holds
  std::int64_t reset = 0;
  bool has_start =
      false;  ///< of a register that no reset sets: simulators begin with 0, not with an unknown number
};
enum class MemoryKind {
  lookup,  ///< small: lookup tables of a chip, or registers
  block,   ///< large: a chip's block RAM
  rom,     ///< read as a block memory; it is never written
  single,  ///< very large: writes or reads a word in a cycle, as the single-port memory of a chip does
};

struct MemoryShape {
  const char* name;
  int words;  ///< a power of two, at least 2
  int width;  ///< bits of a word, 1..128
  MemoryKind kind;
  const std::uint32_t* contents = nullptr;  ///< of a rom: its words, of at most 32 bits
  bool is_apart =
      false;  ///< of a block memory: no word is read while it is written, so chips need no logic for it

  /// The word comes in the next cycle.
  constexpr bool is_late() const { return kind != MemoryKind::lookup; }
  constexpr bool is_written() const { return kind != MemoryKind::rom; }
  constexpr const char* kind_name() const {
    if (kind == MemoryKind::rom) return "rom";
    if (kind == MemoryKind::single) return "single";
    return kind == MemoryKind::block ? "block" : "lookup";
  }
};

}  // namespace hls
}  // namespace hitpipe
