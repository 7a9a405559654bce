// The same with Verilator: at least 10^6 vectors for each design, with gaps and stalls, of the fitted unit's
// Verilog against the unfitted C++: prune_rtl_vectors [VECTORS PER DESIGN]. The demand set is "all of these",
// and integer units have 20/24 bits.
#include <cstdlib>
#include <exception>

#include <fmt/format.h>

#include "rtl_gen/prune/prune.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "sim/fit/vector_check.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"

namespace {

using namespace hitpipe;

bool run(const char* name, std::uint64_t vectors) {
  const rtl::Design& design = rtl::find_design(name);
  const rtl::Format format = design.default_format;
  const rtl::Library& library = rtl::Library::thesis();
  const rtl::Graph traced = design.trace(format);
  const rtl::Demands demands = rtl::demand_sets(design, format).back().demands;
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(rtl::prune(traced, demands, {.shares = false}).graph, library);
  const sim::VerilatedDesign verilated(
      design, format, pipeline,
      rtl::to_verilog(pipeline, library, {.module_name = name, .bits = to_string(format)}), name);
  const std::vector<rtl::Port> ports = rtl::input_ports(traced);
  const sim::VectorResult result = sim::check_vectors({.verilated = &verilated,
                                                       .evaluate = design.evaluate(format),
                                                       .ports = &ports,
                                                       .demands = &demands,
                                                       .vectors = vectors,
                                                       .seed = 2011});
  fmt::print("{} {}: {} vectors through the Verilog, {} hits, {} mismatches {}\n", name, to_string(format),
             result.vectors, result.hits, result.mismatches, result.first_mismatch);
  return result.mismatches == 0 && result.vectors >= vectors;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::uint64_t vectors = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
    bool all = true;
    for (const char* const name : {"int_slabs", "int_plucker", "fp_slabs", "fp_plucker"})
      all = run(name, vectors) && all;
    return all ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 1;
  }
}
