// The same with Verilator: at least 10^6 vectors for each design, with gaps and stalls, of the fitted unit's
// Verilog against the unfitted C++: prune_rtl_vectors [VECTORS PER DESIGN]. The demand set is "all of these",
// and integer units have 20/24 bits.
#include <cstdlib>
#include <exception>

#include <fmt/format.h>

#include "rtl_gen/prune/prune.hpp"
#include "sim/unit/drive.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"

namespace {

using namespace hitpipe;

bool run(const char* name, std::uint64_t vectors) {
  const rtl::Design& design = rtl::find_design(name);
  const rtl::Format format = design.default_format;
  const rtl::Library& library = rtl::Library::thesis();
  const rtl::Demands demands = rtl::demand_sets(design, format).back().demands;
  rtl::Pipeline pipeline =
      rtl::make_pipeline(rtl::prune(design.trace(format), demands, {.shares = false}).graph, library);
  const sim::VerilatedDesign verilated(sim::make_unit(design, format, library, std::move(pipeline), demands));
  const sim::VectorResult result =
      sim::check_vectors({.verilated = &verilated, .vectors = vectors, .seed = 2011});
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
