// A unit: the hardware of a design at one format, whole or cut to what it demands of rays and boxes, with its
// Verilog. It is made here or read from a folder (read_unit.hpp).
#pragma once

#include <optional>
#include <string>

#include "rtl_gen/part/part.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

struct Unit : Part {
  Library library;
  std::string verilog;
  Demands demands{};     ///< none of a whole unit
  PruneReport report{};  ///< what the demands left out; nothing of a unit that was read

  /// The top of its Verilog.
  [[nodiscard]] const std::string& module() const { return interface.module; }
  [[nodiscard]] FlowControl flow_control() const { return interface.flow_control(); }
  [[nodiscard]] int interval() const { return interface.interval; }
};

struct UnitOptions {
  std::string module{};  ///< empty: design.module_at(format)
  FlowControl flow_control = FlowControl::stall;
  int interval = 1;
  std::optional<int> clock_ps{};  ///< as make_pipeline() takes it
};

/// The whole design, as read_unit() (read_unit.hpp) would read what `hitpipe rtl` writes of it.
[[nodiscard]] Unit make_unit(const Design& design, const Format& format, const Library& library,
                             const UnitOptions& options = {});
/// The same of a pipeline that is there; it has its interval and its clock.
[[nodiscard]] Unit make_unit(const Design& design, const Format& format, const Library& library,
                             Pipeline pipeline, const UnitOptions& options = {});
/// A pipeline that prune() left of the design.
[[nodiscard]] Unit make_unit(const Design& design, const Format& format, const Library& library,
                             Pipeline pipeline, Demands demands, PruneReport report,
                             const UnitOptions& options = {});

}  // namespace hitpipe::rtl
