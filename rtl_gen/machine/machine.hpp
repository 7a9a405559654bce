// A machine (hls/machines/machine.hpp) in one format, as a graph and as software. Verilog, timing and price
// are made from the graph; docs/machines.md tells how to add a machine.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hls/machines/machine.hpp"
#include "host/format.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The step of a machine as one combinational graph.
struct MachineGraph {
  std::string name;
  std::vector<hls::Field> state, inputs, outputs;
  std::vector<hls::MemoryShape> memories;
  /// Inputs: the state, the inputs, and MEMORY_word of each memory. Outputs: next_REGISTER, the outputs, and
  /// of each memory MEMORY_asked or MEMORY_read (the place that is read), MEMORY_writes, MEMORY_place and
  /// MEMORY_written. A memory of kind single reads at MEMORY_place.
  Graph graph;
};

/// The name of a memory's input or output of the graph.
[[nodiscard]] std::string memory_port(const hls::MemoryShape& memory, std::string_view what);

/// One line for each rule that is broken; none of a machine that can be emitted. The rules: fields, ports and
/// memories have distinct names that Verilog and C++ allow, and their widths and sizes; each input of the
/// graph is one of the names above, and each output is there once with its width; no output of the machine
/// depends on an input, and no place of a lookup memory depends on a word that one gives.
[[nodiscard]] std::vector<std::string> verify(const MachineGraph& machine);

/// Of each node, the inputs of the graph that it depends on.
[[nodiscard]] std::vector<std::set<std::string>> dependences(const Graph& graph);

/// What a block memory gives when the word is written in the cycle in which it is asked for.
enum class Collision {
  old_word,  ///< as machine.hpp says
  any_word,  ///< as some block RAMs do: a machine that never uses such a word cannot tell
};

/// A machine as software, one instance. Numbers are the low bits of words, in the order of the graph's names.
class NativeMachine {
 public:
  virtual ~NativeMachine() = default;
  /// What it gives to others in this cycle.
  virtual void outputs(Word* outputs) = 0;
  /// The clock edge at the cycle's end, which may reset.
  virtual void step(const Word* inputs, bool reset) = 0;
  /// The registers now.
  virtual void state(Word* registers) const = 0;
};

/// One that is joined to others (sim/core/native_core.hpp). Ports have 64 bits, and an input is read where
/// another machine gave it, so that no cycle copies it.
class JoinedMachine : public NativeMachine {
 public:
  /// outputs() and step().
  virtual void give(std::uint64_t* outputs) = 0;
  virtual void take(const std::uint64_t* const* inputs, bool reset) = 0;
};

/// A machine as the program lists it.
struct Machine {
  std::string_view name;
  std::string_view summary;
  Format default_format;
  MachineGraph (*graph_at)(const Format&);
  std::unique_ptr<JoinedMachine> (*native_at)(const Format&, Collision);

  /// As a user writes it. Throws std::runtime_error, one line, that says what is allowed.
  [[nodiscard]] Format parse_format(std::string_view text) const;
  /// Throw std::runtime_error, one line, when there is no such format.
  [[nodiscard]] MachineGraph graph(const Format& format) const;
  [[nodiscard]] std::unique_ptr<JoinedMachine> native(const Format& format,
                                                      Collision collision = Collision::old_word) const;
  /// The name of its Verilog module.
  [[nodiscard]] std::string module_at(const Format& format) const;
};

/// The machines of designs.cmake. The build writes this function.
[[nodiscard]] const std::deque<Machine>& machines();
/// Null if no machine has that name.
[[nodiscard]] const Machine* machine_called(std::string_view name);

}  // namespace hitpipe::rtl
