// A part of hardware in one format: a unit, which is a datapath with a schedule, or a machine, which is state and
// the graph of its step. A core is parts and wires (rtl_gen/core/core.hpp). Verilog, manifest, FuseSoC core,
// price and the software that runs cycle by cycle are made from this value.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

struct Part {
  std::string_view name;  ///< of its design or machine; in a core, of its place
  Format format;
  ModuleInterface interface;
  /// Of a machine.
  const Machine* machine = nullptr;
  std::optional<MachineGraph> graph{};
  /// Of a unit.
  const Design* design = nullptr;
  std::optional<Pipeline> pipeline{};

  /// Of the whole design. A unit that was cut may lack ports or bits of ports.
  [[nodiscard]] std::vector<Port> ports() const { return design->ports(format); }
  /// With the library the shortest clock of a machine; of a unit that of its schedule.
  [[nodiscard]] int clock_ps(const Library& library) const;
};

[[nodiscard]] Part machine_part(const Machine& machine, const Format& format, const std::string& module);
[[nodiscard]] Part unit_part(const Design& design, const Format& format, const std::string& module,
                             Pipeline pipeline, FlowControl flow);

/// Memories of a machine `in_block_rams` are marked for them (machine/module.hpp).
[[nodiscard]] std::string to_verilog(const Part& part, const Library& library,
                                     const std::set<std::string>& in_block_rams = {});

}  // namespace hitpipe::rtl
