// A traversal core (docs/core.md) as parts and wires: machines, which are control, and units, which are
// datapaths. The top module, and the software that runs cycle by cycle, are made from this value.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core_options.hpp"
#include "rtl_gen/core/plan.hpp"
#include "rtl_gen/part/assembly.hpp"
#include "rtl_gen/part/part.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// Places of parts, and of pins in their interfaces.
struct CoreWire {
  std::size_t from, output;
  std::size_t to, input;
};
/// A pin of the core and what it is joined to: an input all inputs, an output one output.
struct CorePort {
  Pin pin;
  struct End {
    std::size_t part, pin;
  };
  std::vector<End> ends;
  std::string meaning{};  ///< of an output: CorePin::meaning
};

struct Core {
  CoreOptions options;
  std::string module;
  int clock_ps;  ///< the slowest part's
  /// Machines and units. A unit's tags are numbers of rays. Those of `ray` are a tag and what the ray wants,
  /// in_tag and in_any, which are one port of the module.
  std::vector<Part> parts;
  std::vector<CoreWire> wires;
  std::vector<CorePort> ports;
  CoreBus bus;

  /// Of the T of an answer. That of a count is a sum of sides, within the number of triangles.
  [[nodiscard]] int answer_bits() const;
  [[nodiscard]] const Part& part(std::string_view name) const;
  /// The port of a field of hls/machines/channels.hpp. The core must have it.
  template <class Field>
  [[nodiscard]] const Pin& pin(Field) const {
    return port_called(Field::name())->pin;
  }
  /// Its place among the inputs, or among the outputs; nothing if the core does not have it.
  template <class Field>
  [[nodiscard]] std::optional<std::size_t> place_of(Field) const {
    return place_called(Field::name());
  }
  /// clk, rst, and the ports.
  [[nodiscard]] ModuleInterface interface() const;

 private:
  [[nodiscard]] const CorePort* port_called(std::string_view name) const;
  [[nodiscard]] std::optional<std::size_t> place_called(std::string_view name) const;
};

/// Units are scheduled for the clock that is given or that of the slowest machine, or for their own slowest
/// component if that is slower. An empty `module` stands for that of the options. Throws std::runtime_error,
/// one line, for options outside their limits, and std::logic_error when a wire is missing or does not fit.
[[nodiscard]] Core make_core(const CoreOptions& options, const Library& library,
                             const std::string& module = "");
/// The same for each of the options, in their order; what they have in common is scheduled once.
[[nodiscard]] std::vector<Core> make_cores(std::span<const CoreOptions> options, const Library& library,
                                           const std::string& module = "");

/// What its Verilog and its picture are made from.
[[nodiscard]] Assembly assembly_of(const Core& core);
/// The top module, then one for each part. The same core gives the same bytes.
[[nodiscard]] std::string to_verilog(const Core& core, const Library& library);

}  // namespace hitpipe::rtl
