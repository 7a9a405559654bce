#include "rtl_gen/part/part.hpp"

#include <utility>

#include "rtl_gen/machine/module.hpp"
#include "rtl_gen/verilog/module.hpp"

namespace hitpipe::rtl {

int Part::clock_ps(const Library& library) const {
  return pipeline ? pipeline->schedule.clock_ps : longest_path(*graph, library).clock_ps;
}

Part machine_part(const Machine& machine, const Format& format, const std::string& module) {
  Part part{.name = machine.name, .format = format, .interface = {}, .machine = &machine};
  part.graph = machine.graph(format);
  part.interface = machine_interface(module, *part.graph);
  return part;
}

Part unit_part(const Design& design, const Format& format, const std::string& module, Pipeline pipeline,
               FlowControl flow) {
  Part part{.name = design.name, .format = format, .interface = {}, .design = &design};
  part.interface = unit_interface(module, input_ports(pipeline.graph), result_ports(design.results(format)),
                                  flow, pipeline.interval());
  part.pipeline = std::move(pipeline);
  return part;
}

std::string to_verilog(const Part& part, const Library& library, const std::set<std::string>& in_block_rams) {
  const std::string bits = to_string(part.format);
  if (part.graph)
    return to_verilog(*part.graph,
                      {.module = part.interface.module, .bits = bits, .in_block_rams = in_block_rams});
  return to_verilog(*part.pipeline, library,
                    {.module_name = part.interface.module,
                     .bits = bits,
                     .flow_control = part.interface.flow_control(),
                     .operands = part.ports(),
                     .results = part.design->results(part.format)});
}

}  // namespace hitpipe::rtl
