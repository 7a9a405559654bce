#include "sim/fit/unit_cosim.hpp"

#include <stdexcept>
#include <utility>

#include "rtl_gen/verilog/module.hpp"

namespace hitpipe::sim {

WrittenUnit whole_unit(const rtl::Design& design, rtl::Format format, const rtl::Library& library,
                       rtl::FlowControl flow) {
  const rtl::Graph traced = design.trace(format);
  rtl::Pipeline pipeline = rtl::make_pipeline(traced, library);
  std::string module = design.module_at(format);
  std::string verilog = rtl::to_verilog(
      pipeline, library, {.module_name = module, .bits = rtl::to_string(format), .flow_control = flow});
  return {format, std::move(module), {}, rtl::input_ports(traced), std::move(pipeline), std::move(verilog),
          flow};
}

VerilatedDesign verilate(const rtl::Design& design, const WrittenUnit& unit, std::optional<int> ray_slots) {
  if (!ray_slots)
    return {design,          unit.format, unit.pipeline,    unit.verilog, unit.module,
            default_cache(), {},          unit.flow_control};
  rtl::check_ray_slots(unit.flow_control);
  const rtl::RaySlots slots =
      rtl::ray_slots(rtl::unit_interface(unit.module, rtl::input_ports(unit.pipeline.graph),
                                         rtl::result_ports(design.results(unit.format)), unit.flow_control),
                     design.ports(unit.format), *ray_slots);
  return {design,
          unit.format,
          unit.pipeline,
          unit.verilog,
          unit.module,
          default_cache(),
          RayMemory{slots, rtl::to_verilog(slots)}};
}

CosimResult cosimulate_unit(const rtl::Design& design, const WrittenUnit& unit,
                            const VerilatedDesign& verilated, const ref::Scene& scene, const ref::Bvh& bvh,
                            const CosimOptions& options) {
  const OperandGuard guard(unit.demands, unit.ports);
  CosimOptions of_unit = options;
  of_unit.coarse = unit.coarse();
  of_unit.ends = unit.ends();
  of_unit.guard = unit.demands.empty() ? nullptr : &guard;
  return cosimulate(design, unit.format, verilated, scene, bvh, of_unit);
}

}  // namespace hitpipe::sim
