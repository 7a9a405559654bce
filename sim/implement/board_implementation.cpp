#include "sim/implement/board_implementation.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "host/process.hpp"
#include "rtl_gen/board/top.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::sim {

namespace {

/// It has no option that prints a version, and its help ends with exit code 1.
Tool find_icepack() {
  Tool icepack{host::program_of("ICEPACK", "icepack"), ""};
  if (icepack.run({"-h"}).not_found())
    throw std::runtime_error(
        fmt::format("{}: cannot be run; install the package fpga-icestorm or set ICEPACK to the program",
                    icepack.name()));
  return icepack;
}

}  // namespace

BoardImplementation implement_board(const rtl::Design& design, const rtl::Format& format,
                                    const rtl::Board& board, int baud, const ImplementOptions& options) {
  if (!options.module.empty()) rtl::check_module_name(options.module);
  const Target target = target_called(board.target);
  if (!target.placement)
    throw std::runtime_error(
        fmt::format("board {}: its target {} is not placed: {}", board.name, target.name, target.not_placed));
  const int clocks_per_bit = board.clocks_per_bit(baud);
  const rtl::Library library =
      rtl::library_called(options.library.empty() ? target.library : options.library);
  const ChipTools tools = find_chip_tools(target);
  const Tool icepack = find_icepack();
  const Workbench bench(options.folder / target.name);

  options.progress("writing the unit");
  const rtl::Pipeline pipeline = rtl::make_pipeline(
      design.trace(format), library, options.clock_ps.value_or(board.unit_clock_ps()), options.interval);
  const rtl::VectorSet vectors = design_vectors(design, format, usual_vectors, options.seed);
  const rtl::EmittedDesign emitted =
      rtl::emit(design, format, library, pipeline, {.module = options.module, .vectors = &vectors});
  const std::string top = rtl::board_module(emitted.module);
  const host::File top_file{
      top + ".v", rtl::board_top(rtl::board_unit(design, format, emitted.module, pipeline), clocks_per_bit)};
  const bool drawn = rtl::write_unit(bench.kept(), emitted).drawn;
  host::write_files(bench.kept(), {top_file});

  BoardImplementation result{
      .chip = map_module(target, {top, {emitted.verilog, top_file}}, tools, bench, options.progress),
      .bitstream = {}};
  Implementation& chip = result.chip;
  chip.library = library.name();
  chip.latency = pipeline.latency();
  chip.drawn = drawn;
  if (!chip.excess().empty()) return result;
  chip.placed = place_and_route(
      target,
      {.top = top,
       .netlist = chip.synthesis.json(),
       .clock = module_clock,
       .pcf = board.pin_constraints(),
       .seeds = options.seeds,
       .bitstream = true,
       .progress =
           [&](int seed) { options.progress(fmt::format("placing, seed {} of {}", seed, options.seeds)); }},
      *tools.nextpnr, bench);
  if (chip.placed->seeds.empty()) return result;
  chip.critical_path_ns = 1000 / chip.placed->median().fmax_mhz;
  const PlacedSeed best = chip.placed->best();
  if (best.fmax_mhz * 1e6 < board.clock_hz) return result;
  const std::string bitstream = top + ".bin";
  bench.run(icepack, {fmt::format("{}_{}.asc", top, best.seed), bitstream}, top + "_icepack.log");
  bench.keep(bitstream);
  result.bitstream = bench.kept() / bitstream;
  return result;
}

}  // namespace hitpipe::sim
