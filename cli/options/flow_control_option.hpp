// --flow-control, of commands that make a unit or price one.
#pragma once

#include <string>

#include "cli/options/values.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::cli {

inline CLI::Option* add_flow_control_option(CLI::App& command, rtl::FlowControl& value,
                                            const std::string& more = "") {
  Choices<rtl::FlowControl> choices;
  for (const auto flow : {rtl::FlowControl::stall, rtl::FlowControl::none})
    choices.emplace_back(rtl::flow_control_name(flow), flow);
  return add_choice_option(
      command, "--flow-control", value, choices,
      "stall: valid and ready on both sides, and the pipeline stands still while a result "
      "waits; none: a result comes a fixed number of cycles after its operands, and "
      "nothing waits" +
          more);
}

}  // namespace hitpipe::cli
