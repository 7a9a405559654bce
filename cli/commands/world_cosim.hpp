// `cosim` of a triangle unit: boxes and triangles are answered by Verilog.
#pragma once

#include "cli/options/design_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/world_options.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sw_ref/hierarchy/load_bvh.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::cli {

struct WorldCosim {
  DesignChoice choice;
  std::string library;
  SceneChoice scene;
  ref::HierarchyOptions hierarchy;
  BoxFormatChoice boxes;
  std::string box_unit;  ///< the design that answers them
  rtl::FlowControl flow_control;
  int interval;
  int rays_in_flight;
  ref::WhittedOptions light;
  RayListChoice rays;
  std::string out;
  OutputFormat format;
};

/// Prints the record and returns the exit code.
[[nodiscard]] int cosimulate_world(const WorldCosim& command, const CLI::App& parsed);

}  // namespace hitpipe::cli
