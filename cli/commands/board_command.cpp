#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/board_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/board/top.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "sim/board/board_link.hpp"
#include "sim/board/board_tests.hpp"
#include "sim/board/simulated_board.hpp"
#include "sim/implement/target.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::cli {

namespace {

constexpr std::uint64_t most_drawn = 1'000'000;

struct BoardCommand {
  DesignChoice choice;
  BoardChoice board{"icebreaker", {}};
  std::string port;
  bool simulate = false;
  SceneChoice scene;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  ref::WhittedOptions light;
  std::uint64_t tests = 10'000;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> only;
  OutputFormat format = OutputFormat::text;
};

/// The scene and its hierarchy, which their tests need for as long as they are drawn.
struct LoadedScene {
  LoadedScene(const SceneChoice& choice, const ref::HierarchyOptions& hierarchy)
      : scene(choice.load()), bvh(ref::make_hierarchy(scene, hierarchy).bvh) {}
  ref::Scene scene;
  ref::Bvh bvh;
};

std::string hex_of(const std::vector<rtl::Port>& ports, const std::vector<std::int64_t>& values) {
  std::string text;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const auto bits = static_cast<std::uint64_t>(values[i]) & (~std::uint64_t{0} >> (64 - ports[i].width));
    text += fmt::format("{}{}=0x{:0{}x}", i == 0 ? "" : " ", ports[i].name, bits, (ports[i].width + 3) / 4);
  }
  return text;
}

void print_wrong(const rtl::Design& design, const Format& format, const sim::WrongAnswer& wrong) {
  const std::vector<rtl::Port> results = rtl::result_ports(design.results(format));
  fmt::print(stderr, "hitpipe: test {}: the board says {}, the C++ {}, for {}; `--only {}` sends it alone\n",
             wrong.number, hex_of(results, wrong.results), hex_of(results, wrong.test.results),
             hex_of(design.ports(format), wrong.test.operands), wrong.number);
}

int stream(const BoardCommand& command) {
  const DesignChoice unit = command.board.unit(command.choice);
  const rtl::Design& design = unit.design();
  const Format format = unit.format();
  const bool of_scene = !command.scene.name.empty();
  if (of_scene) {
    if (const std::string why = sim::why_not_traced(design); !why.empty()) throw std::runtime_error(why);
  } else if (command.tests > most_drawn) {
    throw std::runtime_error(
        fmt::format("--tests {}: without --scene allowed is 1 to {}", command.tests, most_drawn));
  }
  if (command.only && *command.only >= command.tests)
    throw std::runtime_error(
        fmt::format("--only {}: allowed is 0 to {}, below --tests", *command.only, command.tests - 1));
  const int baud = command.board.baud.value_or(command.board.board().baud);
  host::SerialPort port = host::SerialPort::open(command.port, baud);
  sim::BoardLink link(port, design, format);
  link.require_same_unit();

  std::optional<Progress> progress(of_scene ? "reading the scene" : "drawing tests");
  std::optional<LoadedScene> scene;
  std::unique_ptr<sim::BoardTests> tests;
  if (of_scene) {
    scene.emplace(command.scene, command.hierarchy);
    tests = sim::scene_tests(design, format, scene->scene, scene->bvh,
                             {.width = command.scene.width,
                              .height = command.scene.height,
                              .seed = command.seed,
                              .light = command.light});
  } else {
    tests = sim::drawn_tests(design, format, command.tests, command.seed);
  }
  progress.emplace("testing");
  std::uint64_t drawn = 0;
  const auto next = [&]() -> std::optional<sim::NumberedTest> {
    while (drawn < command.tests) {
      std::optional<rtl::Vector> test = tests->next();
      if (!test) break;
      const std::uint64_t number = drawn++;
      progress->show(static_cast<double>(drawn) / static_cast<double>(command.tests));
      if (!command.only || *command.only == number) return sim::NumberedTest{number, *std::move(test)};
    }
    return std::nullopt;
  };
  const sim::BoardCounts counts = link.run(next);
  progress.reset();

  Row row{{"design", design.name},
          {"bits", to_string(format)},
          {"port", command.port},
          {"baud", baud},
          {"tests_from", of_scene ? command.scene.name : "vectors"}};
  if (of_scene) row.update(scene_row(scene->scene));
  row.update({{"seed", command.seed},
              {"tests", counts.tests},
              {"hits", counts.hits},
              {"mismatches", counts.mismatches},
              {"sent_again", counts.resent},
              {"bytes_sent", counts.bytes_sent},
              {"bytes_received", counts.bytes_received},
              {"seconds", counts.seconds},
              {"tests_per_s", static_cast<double>(counts.tests) / counts.seconds}});
  fmt::print("{}", record_text(row, command.format));
  if (counts.mismatches == 0) return 0;
  print_wrong(design, format, *counts.first_wrong);
  return 1;
}

int be_the_board(const BoardCommand& command) {
  const DesignChoice unit = command.board.unit(command.choice);
  const rtl::Design& design = unit.design();
  const Format format = unit.format();
  // As `hitpipe implement` puts it on the board.
  const rtl::Library library = rtl::library_called(sim::target_called(command.board.board().target).library);
  const std::string module = design.module_at(format);
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(design.trace(format), library, command.board.board().unit_clock_ps());
  const std::string top =
      rtl::board_top(rtl::board_unit(design, format, module, pipeline), sim::simulated_clocks_per_bit);
  std::optional<Progress> progress("compiling the Verilog");
  sim::SimulatedBoard board(
      {.module = rtl::board_module(module),
       .verilog =
           rtl::to_verilog(pipeline, library, {.module_name = module, .bits = to_string(format)}) + top});
  progress.reset();
  fmt::print("{}", record_text({{"design", design.name},
                                {"bits", to_string(format)},
                                {"port", board.port()},
                                {"test_with", fmt::format("hitpipe board {}{} --port {}", design.name,
                                                          design.bits_option(format), board.port())}},
                               command.format));
  std::fflush(stdout);
  board.run([] { return false; });
  return 0;
}

}  // namespace

CLI::App* add_board_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("board", "Test a unit on a board over its serial port, or simulate the board");
  const auto options = std::make_shared<BoardCommand>();
  add_design_options(*command, options->choice);
  command->get_option("design")->required(false)->description(
      "A name that `hitpipe list designs` shows. Default: the unit that `hitpipe implement` puts on the "
      "board");
  CLI::Option* const port = add_port_option(*command, options->port);
  add_board_option(*command, options->board, "The board, which tells the usual rate")->capture_default_str();
  add_baud_option(*command, options->board);
  CLI::Option* const simulate = add_simulate_option(*command, options->simulate);
  needs_one_of(*command, {port, simulate});
  add_large_count_option(*command, "--tests", options->tests, 1, 10'000'000'000,
                         "Number of tests (1 to 10^10; without --scene to 10^6)");
  add_seed_option(*command, options->seed);
  command->add_option("--only", options->only, "Send only the test of this number, counted from 0")
      ->transform(number_from<std::uint64_t>(0, 10'000'000'000))
      ->type_name("N");
  add_scene_options(*command, options->scene);
  command->get_option("--scene")->required(false);
  add_hierarchy_options(*command, options->hierarchy);
  add_light_options(*command, options->light);
  exclude_all_but(*command, simulate, {"design", "--bits", "--board", "--format"},
                  "the other side sends the tests");
  add_format_option(*command, options->format);
  add_examples(*command,
               {"hitpipe board --port /dev/ttyUSB1 --tests 100000", "hitpipe board int_slabs --simulate"});
  command->callback([options, &exit_code] {
    options->hierarchy.build.threads = options->scene.threads;
    exit_code = options->simulate ? be_the_board(*options) : stream(*options);
  });
  return command;
}

}  // namespace hitpipe::cli
