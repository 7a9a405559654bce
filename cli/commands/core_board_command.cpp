#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/board_chips.hpp"
#include "cli/options/board_options.hpp"
#include "cli/options/core_options.hpp"
#include "cli/options/core_scene_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/format.hpp"
#include "host/serial_port.hpp"
#include "rtl_gen/board/core_top.hpp"
#include "rtl_gen/board/top.hpp"
#include "rtl_gen/component/library.hpp"
#include "sim/board/core_link.hpp"
#include "sim/board/simulated_board.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/implement/target.hpp"
#include "sw_ref/render/image_file.hpp"

namespace hitpipe::cli {

namespace {

struct CoreBoardCommand {
  std::optional<std::string> bits;  ///< without: those of the board's usual core
  BoardChoice board{"icebreaker", {}};
  std::string port;
  bool simulate = false;
  CoreSceneChoice traced;
  std::string out;  ///< empty: no picture is written
  OutputFormat format = OutputFormat::text;
};

/// As `hitpipe core implement` puts it on the board.
rtl::Library library_of(const rtl::Board& board) {
  return rtl::library_called(sim::target_called(board.target).library);
}

std::string text_of(const rtl::Core& core) {
  return to_string(Format(core.options.bits));
}

/// Writes the scene's image to the board, sends the rays of its picture, and compares each answer with
/// software. Returns the exit code.
int trace_by_board(const CoreBoardCommand& choice) {
  const rtl::Board board = choice.board.board();
  const rtl::CoreOptions options = core_on_board(board, choice.bits);
  const int baud = choice.board.baud.value_or(board.baud);
  host::SerialPort port = host::SerialPort::open(choice.port, baud);
  std::optional<Progress> progress("making the core");
  const rtl::Core core = rtl::make_core(options, library_of(board));
  sim::CoreLink link(port, core);
  link.require_same_core();

  progress.emplace("reading the scene");
  const CoreScene loaded = choice.traced.load(choice.traced.stored(), options.bits.world(), text_of(core));
  const std::filesystem::path picture_file =
      std::filesystem::path(choice.out) /
      (std::filesystem::path(loaded.scene->scene.name).stem().string() + ".png");
  if (!choice.out.empty()) {
    host::make_folder(choice.out);
    ref::check_image_place(picture_file);
  }
  const ref::CoreImage& image = loaded.image;
  sim::check_fits(core, image);
  progress.emplace("walking in software");
  const ref::RenderOptions drawing{.width = choice.traced.scene.width,
                                   .height = choice.traced.scene.height,
                                   .progress = [&](double share) { progress->show(share); }};
  const sim::PictureRays picture = sim::picture_rays(
      loaded.scene, image,
      {.world = options.bits.world(), .boxes = options.bits.boxes(), .places = 1 << options.stack_bits},
      drawing);
  progress.emplace("writing the image");
  const auto show = [&](double share) { progress->show(share); };
  const sim::FrameLink::Counts written = link.write(image, show);
  progress.emplace("tracing");
  std::vector<sim::CoreAnswer> answers(picture.jobs.size());
  const sim::FrameLink::Counts traced = link.run(picture.jobs, answers, show);
  const std::uint64_t wrong = picture.wrong(answers);
  const auto hits = std::count_if(answers.begin(), answers.end(),
                                  [](const sim::CoreAnswer& answer) { return answer.hit.found(); });
  progress.reset();
  Row row{{"core", core.module}, {"bits", text_of(core)}, {"port", choice.port}, {"baud", baud}};
  if (choice.traced.image.empty())
    row["scene"] = choice.traced.scene.name;
  else
    row["image"] = choice.traced.image;
  row.update(loaded.mesh);
  row.update({{"blocks", image.blocks.size()},
              {"image_seconds", written.seconds},
              {"rays", traced.answered},
              {"hits", hits},
              {"wrong", wrong},
              {"sent_again", written.resent + traced.resent},
              {"bytes_sent", written.bytes_sent + traced.bytes_sent},
              {"bytes_received", written.bytes_received + traced.bytes_received},
              {"seconds", traced.seconds},
              {"rays_per_s", static_cast<double>(traced.answered) / traced.seconds}});
  fmt::print("{}", record_text(row, choice.format));
  if (wrong > 0) {
    fmt::print(stderr, "hitpipe: {} of {} answers are not those of software\n", wrong, answers.size());
    return 1;
  }
  if (!choice.out.empty()) {
    progress.emplace("drawing");
    ref::write_image(picture_file, choice.traced.scene.width, choice.traced.scene.height,
                     picture.drawn(answers, drawing));
  }
  return 0;
}

/// Is the board, until interrupted.
int simulate_core(const CoreBoardCommand& choice) {
  const rtl::Board board = choice.board.board();
  std::optional<Progress> progress("compiling the Verilog");
  const rtl::Library library = library_of(board);
  const rtl::Core core = rtl::make_core(core_on_board(board, choice.bits), library);
  sim::SimulatedBoard simulated(
      {.module = rtl::board_module(core.module),
       .verilog = rtl::core_board_top(core, sim::simulated_clocks_per_bit) + rtl::to_verilog(core, library),
       .quiet_clocks = sim::core_quiet_clocks});
  progress.reset();
  const std::string bits = text_of(core);
  fmt::print(
      "{}", record_text({{"core", core.module},
                         {"bits", bits},
                         {"port", simulated.port()},
                         {"trace_with", fmt::format("hitpipe core board{} --port {} --scene SCENE",
                                                    choice.bits ? " --bits " + bits : "", simulated.port())}},
                        choice.format));
  std::fflush(stdout);
  simulated.run([] { return false; });
  return 0;
}

}  // namespace

CLI::App* add_core_board_command(CLI::App& core, int& exit_code) {
  CLI::App* const command =
      core.add_subcommand("board", "Trace a scene by a core on a board, or simulate the board");
  const auto options = std::make_shared<CoreBoardCommand>();
  add_core_bits_option(*command, options->bits, "the board's");
  CLI::Option* const port = add_port_option(*command, options->port);
  add_board_option(*command, options->board, "The board, which tells the usual rate")->capture_default_str();
  add_baud_option(*command, options->board)->needs(port);
  CLI::Option* const simulate = add_simulate_option(*command, options->simulate);
  needs_one_of(*command, {port, simulate});
  const auto [scene, image] = add_core_scene_options(*command, options->traced);
  port->check([scene = scene, image = image](const std::string&) {
    if (scene->count() + image->count() == 0)
      throw CLI::ParseError("--port requires --scene or --image", CLI::ExitCodes::RequiresError);
    return std::string();
  });
  add_folder_option(*command, options->out,
                    "Folder for the picture that the answers make, SCENE.png; written when all are right");
  exclude_all_but(*command, simulate, {"--board", "--bits", "--format"}, "the other side has the scene");
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe core board --port /dev/ttyUSB1 --scene spheres --out out",
                          "hitpipe core board --port /dev/ttyUSB1 --image spheres.bin",
                          "hitpipe core board --simulate"});
  command->callback([options, &exit_code] {
    options->traced.hierarchy.build.threads = options->traced.scene.threads;
    exit_code = options->simulate ? simulate_core(*options) : trace_by_board(*options);
  });
  return command;
}

}  // namespace hitpipe::cli
