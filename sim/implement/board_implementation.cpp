#include "sim/implement/board_implementation.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "host/process.hpp"
#include "rtl_gen/board/core_top.hpp"
#include "rtl_gen/board/top.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::sim {

namespace {

/// icepack has no option that prints a version, and its help ends with exit code 1.
Tool find_packer(const TargetProgram& program) {
  Tool packer{host::program_of(program.variable().c_str(), program.name), ""};
  if (packer.run({"-h"}).not_found()) throw cannot_be_run(packer, program.package, program.variable());
  return packer;
}

/// A board needs its target's placer. Throws cannot_be_run() where that is missing.
const Tool& placer_in(const ChipTools& tools, const TargetProgram& program) {
  if (!tools.placer) throw cannot_be_run({{program.name}, ""}, program.package, program.variable());
  return *tools.placer;
}

/// The chip of a board, and what makes it.
struct BoardBench {
  BoardBench(const rtl::Board& of_board, const ImplementOptions& given)
      : board(of_board),
        options(given),
        target(target_called(of_board.target)),
        library(given.library_for(target)),
        tools(find_chip_tools(target)),
        placer(placer_in(tools, target.placer->program)),
        packer(find_packer(target.placer->board->packer)),
        bench(given.folder / target.name) {}

  const rtl::Board& board;
  const ImplementOptions& options;
  Target target;
  rtl::Library library;
  ChipTools tools;
  Tool placer;
  Tool packer;
  Workbench bench;

  /// Synthesises, places and packs. The files of the sources are written already.
  [[nodiscard]] BoardImplementation run(const ChipSources& sources) const;
};

BoardImplementation BoardBench::run(const ChipSources& sources) const {
  BoardImplementation result{.chip = map_module(target, sources, tools, bench, options.progress),
                             .bitstream = {}};
  Implementation& chip = result.chip;
  chip.library = library.name();
  if (!chip.excess().empty()) return result;
  chip.placed = place_and_route(
      target,
      {.top = sources.top,
       .netlist = chip.synthesis.json(),
       .clock = module_clock,
       .board = &board,
       .seeds = options.seeds,
       .progress =
           [&](int seed) { options.progress(fmt::format("placing, seed {} of {}", seed, options.seeds)); }},
      placer, bench);
  if (chip.placed->seeds.empty()) return result;
  chip.critical_path_ns = 1000 / chip.placed->median().fmax_mhz;
  const PlacedSeed best = chip.placed->best();
  if (best.fmax_mhz * 1e6 < board.clock_hz) return result;
  const BoardFlow& flow = *target.placer->board;
  const std::string bitstream = flow.bitstream_file(sources.top);
  bench.run(packer, {flow.placed_file(sources.top, best.seed), bitstream},
            fmt::format("{}_{}.log", sources.top, flow.packer.name));
  bench.keep(bitstream);
  result.bitstream = bench.kept() / bitstream;
  return result;
}

/// What is refused before tools are looked for. Returns the clock cycles of a bit.
int checked_clocks(const rtl::Board& board, int baud, const ImplementOptions& options) {
  if (!options.module.empty()) rtl::check_module_name(options.module);
  const Target target = target_called(board.target);
  if (!target.placer || !target.placer->board)
    throw std::runtime_error(
        fmt::format("board {}: nothing makes a bitstream for its target {}", board.name, target.name));
  return board.clocks_per_bit(baud);
}

}  // namespace

BoardImplementation implement_board(const rtl::Design& design, const Format& format, const rtl::Board& board,
                                    int baud, const ImplementOptions& options) {
  const int clocks_per_bit = checked_clocks(board, baud, options);
  const BoardBench made(board, options);

  options.progress("writing the unit");
  const rtl::Unit unit = rtl::make_unit(design, format, made.library,
                                        {.module = options.module,
                                         .interval = options.interval,
                                         .clock_ps = options.clock_ps.value_or(board.unit_clock_ps())});
  const rtl::VectorSet vectors = design_vectors(design, format, usual_vectors, options.seed);
  const rtl::EmittedDesign emitted = rtl::emit(unit, {.vectors = &vectors});
  const std::string top = rtl::board_module(emitted.module);
  const host::File top_file{
      top + ".v",
      rtl::board_top(rtl::board_unit(design, format, emitted.module, *unit.pipeline), clocks_per_bit)};
  const bool drawn = rtl::write_unit(made.bench.kept(), emitted).drawn;
  host::write_files(made.bench.kept(), {rtl::with_licence(top_file)});
  BoardImplementation result = made.run({top, {emitted.verilog, top_file}});
  result.chip.latency = unit.pipeline->latency();
  result.chip.drawn = drawn;
  return result;
}

BoardImplementation implement_core_board(const rtl::CoreOptions& core_options, const rtl::Board& board,
                                         int baud, const ImplementOptions& options) {
  const int clocks_per_bit = checked_clocks(board, baud, options);
  const BoardBench made(board, options);

  options.progress("writing the core");
  const rtl::Core core = rtl::make_core(core_options, made.library, options.module);
  const std::string top = rtl::board_module(core.module);
  const host::File core_file{core.module + ".v", rtl::to_verilog(core, made.library)};
  const host::File top_file{top + ".v", rtl::core_board_top(core, clocks_per_bit)};
  host::write_files(made.bench.kept(), {rtl::with_licence(core_file), rtl::with_licence(top_file)});
  return made.run({top, {core_file, top_file}});
}

}  // namespace hitpipe::sim
