// A unit from a folder that `hitpipe fit` or `hitpipe rtl` wrote: its Verilog, edited or not, and what its
// manifest demands of rays and boxes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"

namespace hitpipe::sim {

struct WrittenUnit {
  rtl::Format format;
  std::string module;            ///< the top of its Verilog
  rtl::Demands demands;          ///< none if the unit is whole
  std::vector<rtl::Port> ports;  ///< of the whole design
  rtl::Pipeline pipeline;        ///< of the unit
  std::string verilog;
  rtl::FlowControl flow_control = rtl::FlowControl::stall;

  /// The axes whose low bits are 0 by the demands.
  [[nodiscard]] ref::CoarseAxes coarse() const;
  /// The unit knows where rays end. False when the demands say that no ray has an end.
  [[nodiscard]] bool ends() const;
};

/// `place` is the unit's manifest, or a folder with one manifest of the design; the Verilog is beside it.
/// Throws std::runtime_error or std::invalid_argument, one line, when a file is missing or damaged, or
/// belongs to another design or library, and when the folder has units of the design under several names.
[[nodiscard]] WrittenUnit read_unit(const std::filesystem::path& place, const rtl::Design& design,
                                    const rtl::Library& library);

}  // namespace hitpipe::sim
