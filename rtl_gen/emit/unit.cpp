#include "rtl_gen/emit/unit.hpp"

#include <utility>

#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

Unit make_unit(const Design& design, const Format& format, const Library& library,
               const UnitOptions& options) {
  return make_unit(design, format, library,
                   make_pipeline(design.trace(format), library, options.clock_ps, options.interval), options);
}

Unit make_unit(const Design& design, const Format& format, const Library& library, Pipeline pipeline,
               const UnitOptions& options) {
  return make_unit(design, format, library, std::move(pipeline), {}, {}, options);
}

Unit make_unit(const Design& design, const Format& format, const Library& library, Pipeline pipeline,
               Demands demands, PruneReport report, const UnitOptions& options) {
  const std::string module = options.module.empty() ? design.module_at(format) : options.module;
  check_module_name(module);
  Unit unit{unit_part(design, format, module, std::move(pipeline), options.flow_control),
            library,
            {},
            std::move(demands),
            std::move(report)};
  unit.verilog = to_verilog(unit, library);
  if (!unit.demands.empty())
    unit.verilog = with_check_block(unit.verilog, check_block(unit.interface, unit.demands, unit.ports()));
  return unit;
}

}  // namespace hitpipe::rtl
