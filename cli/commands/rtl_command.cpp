#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/machines.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/table.hpp"
#include "host/talk.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/result_fifo.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/vectors/design_vectors.hpp"

namespace hitpipe::cli {

namespace {

struct RtlOptions {
  DesignChoice choice;
  std::string out;
  std::string library{rtl::default_library};
  std::optional<int> block_luts;
  std::optional<std::string> name;
  std::optional<int> clock_ps;
  int interval = 1;
  rtl::FlowControl flow_control = rtl::FlowControl::stall;
  bool flow_control_given = false;
  bool axi_stream = false;
  bool fifo = false;
  bool hls = false;
  int vectors = sim::usual_vectors;
  std::uint64_t seed = sim::usual_seed;
  OutputFormat format = OutputFormat::text;
};

/// Without the option a bare unit stalls; in a wrapper it has what costs less.
rtl::FlowControl flow_control_of(const RtlOptions& options, const rtl::Pipeline& pipeline) {
  if (options.flow_control_given) return options.flow_control;
  if (options.fifo) return rtl::FlowControl::none;
  return options.axi_stream ? rtl::wrapped_flow_control(pipeline) : options.flow_control;
}

void emit_rtl(const RtlOptions& options) {
  const rtl::Design& design = options.choice.design();
  const Format format = options.choice.format();
  if (options.name) rtl::check_module_name(*options.name);
  const rtl::Library library = rtl::library_called(options.library, options.block_luts);
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(design.trace(format), library, options.clock_ps, options.interval);
  const rtl::Unit unit = rtl::make_unit(
      design, format, library, pipeline,
      {.module = options.name.value_or(""), .flow_control = flow_control_of(options, pipeline)});
  const rtl::VectorSet vectors =
      sim::design_vectors(design, format, static_cast<std::size_t>(options.vectors), options.seed);
  const rtl::EmittedDesign emitted = rtl::emit(
      unit,
      {.axi_stream = options.axi_stream, .fifo = options.fifo, .hls = options.hls, .vectors = &vectors});
  const rtl::UnitFiles written = rtl::write_unit(options.out, emitted);

  std::vector<std::string> names;
  for (const rtl::File& file : written.files)
    names.push_back((std::filesystem::path(options.out) / file.name).string());
  const Row row{{"design", design.name},
                {"bits", to_string(format)},
                {"module", emitted.module},
                {"stages", pipeline.schedule.stages},
                {"latency", pipeline.latency()},
                {"flow_control", rtl::flow_control_name(unit.flow_control())},
                {"clock_ps", pipeline.schedule.clock_ps},
                {"library", library.name()},
                {"vectors", vectors.size()},
                {"files", names}};
  fmt::print("{}", record_text(row, options.format));
  if (!written.drawn) host::note(std::string(rtl::not_drawn));
}

}  // namespace

CLI::App* add_rtl_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command =
      program.add_subcommand("rtl", "Write a unit's or a machine's Verilog, pictures and testbench");
  const auto options = std::make_shared<RtlOptions>();
  add_design_options(*command, options->choice);
  add_folder_option(*command, options->out, "Folder to write to; made if it is not there")->required();
  add_library_option(*command, options->library);
  command
      ->add_option("--name", options->name,
                   "Name of the Verilog module, which also begins the names of all files. Default: the "
                   "design's name, with the format behind it unless that is the design's default")
      ->type_name("MODULE");
  CLI::Option* const cycles =
      add_count_option(*command, "--vectors", options->vectors, {1, 10'000'000},
                       "Vectors of the testbench; of a machine its cycles, by default 2000")
          ->capture_default_str();
  add_seed_option(*command, options->seed);
  add_format_option(*command, options->format);
  add_block_luts_option(*command, options->block_luts);
  add_count_option(*command, "--clock-ps", options->clock_ps, {1, 1'000'000'000},
                   "Clock period in picoseconds; by default what the slowest component needs, on iCE40 up to "
                   "a quarter more");
  add_interval_option(*command, options->interval);
  CLI::Option* const flow =
      add_flow_control_option(*command, options->flow_control,
                              ". Default with --fifo: none; with --axi-stream: what needs less area");
  command->add_flag("--axi-stream", options->axi_stream,
                    "Also write an AXI4-Stream wrapper of the design, <module>_axis.v");
  command->add_flag(
      "--fifo", options->fifo,
      "Also write <module>_fifo.v: valid and ready around a design without flow control, by a FIFO "
      "for its results and a count of the places in it");
  command->add_flag("--hls", options->hls,
                    "Also write hls/: the design as a C++ top function for high-level synthesis, with "
                    "scripts for Vitis HLS, Catapult and Bambu");
  of_units(*command,
           {"--block-luts", "--clock-ps", "--ii", "--flow-control", "--axi-stream", "--fifo", "--hls"});
  add_examples(*command, {"hitpipe rtl int_slabs --out unit",
                          "hitpipe rtl int_major --bits 16+1/11s16 --axi-stream --out unit"});
  command->callback([options, command, flow, cycles] {
    options->flow_control_given = flow->count() > 0;
    const rtl::Machine* const machine = rtl::machine_called(options->choice.name);
    if (machine == nullptr) {
      emit_rtl(*options);
      return;
    }
    refuse_of_units(*command, *machine);
    constexpr int usual_cycles = 2000;
    emit_machine(*machine, options->choice.bits,
                 {.out = options->out,
                  .library = options->library,
                  .module = options->name.value_or(""),
                  .cycles = cycles->count() > 0 ? options->vectors : usual_cycles,
                  .seed = options->seed,
                  .format = options->format});
  });
  return command;
}

}  // namespace hitpipe::cli
