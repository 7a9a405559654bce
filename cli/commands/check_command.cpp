#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/box_check.hpp"
#include "cli/commands/stiff_check.hpp"
#include "cli/commands/triangle_check.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/values.hpp"
#include "cli/pieces/pieces.hpp"
#include "cli/report/python.hpp"
#include "cli/text/check_report.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/table.hpp"
#include "hls/num/bits.hpp"
#include "host/text.hpp"
#include "sim/check/shares.hpp"
#include "sim/software/box_software.hpp"
#include "sim/unit/drive.hpp"
#include "sw_ref/judge/adversary/case.hpp"

namespace hitpipe::cli {

namespace {

using ref::adversary::Case;

constexpr std::uint64_t most_stiff = 1'000'000'000;

struct CheckCommand {
  DesignChoice choice;
  std::vector<std::string> categories;
  std::uint64_t tests = 1'000'000;
  std::uint64_t seed = 1;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool rtl = false;
  int interval = 1;
  bool safe = false;
  bool stiff = false;
  std::optional<std::string> replay;
  PiecesChoice pieces;
  std::string out;  ///< of pieces, or of stiff rays
  std::optional<double> plot_width_mm;
  OutputFormat format = OutputFormat::text;
};

/// `comparison`: also judges the design's comparison, if it has one.
BoxCheck box_check(const CheckCommand& command, host::Piece piece, bool comparison) {
  return {command.categories, command.tests,    command.seed, command.threads,
          command.rtl,        command.interval, piece,        comparison};
}

int judge(const CheckCommand& command, const CLI::App& parsed) {
  const rtl::Design& design = command.choice.design();
  const bool triangles = design.kind == hls::triangle_kind;
  const std::size_t categories = triangles ? triangle_categories(command.choice, command.categories).size()
                                           : box_categories(design, command.categories).size();
  const CutWork work{parsed, command.pieces, command.out, sim::Shares(command.tests, categories).batches(),
                     "batches of tests"};
  const auto find_triangles = [&](host::Piece piece) {
    return check_triangle_unit({command.choice, command.categories, command.tests, command.seed,
                                command.threads, command.rtl, command.interval, piece});
  };
  const auto find = [&](host::Piece piece) {
    return check_box_unit(design, command.choice.format(), box_check(command, piece, true));
  };
  if (triangles)
    return do_work(work, find_triangles, [&] { return report_findings(find_triangles({}), command.format); });
  return do_work(work, find, [&] { return report_findings(find({}), command.format); });
}

/// Several designs and formats in one table.
int judge_units(const CheckCommand& command, const DesignsChoice& choice, const CLI::App& parsed) {
  const std::vector<sim::DesignFormats> units = compared_units(choice);
  const auto find = [&](host::Piece piece) {
    return check_box_units(units, box_check(command, piece, false));
  };
  return do_work({parsed, command.pieces, command.out, batches_of_each(units, box_check(command, {}, false)),
                  "batches of tests"},
                 find, [&] { return report_findings(find({}), command.format); });
}

/// What draws into the folder, if there is one to draw into. Throws if it is not installed.
std::vector<std::string> drawer_of(const CheckCommand& command) {
  if (command.out.empty() || (command.pieces.any() && command.pieces.join.empty())) return {};
  return python_program("check", "stiff_plot.py");
}

int judge_stiff(const CheckCommand& command, const StiffCheck& stiff, const CLI::App& parsed) {
  const std::vector<MeasuredDesign> designs = stiff_designs(stiff);
  const std::vector<std::string> drawer = drawer_of(command);
  const auto find = [&](host::Piece piece) { return check_stiff_rays(stiff, designs, piece); };
  return do_work({parsed, command.pieces, command.out, stiff_formats(designs), "formats"}, find, [&] {
    return report_findings(find({}),
                           {command.out, command.plot_width_mm, drawer, command.format, notes_of(parsed)});
  });
}

/// Of all pieces, in order.
template <class Findings>
Findings sum_of(const std::vector<PieceFile>& pieces) {
  const auto parse = [](const Row& row) { return row.get<Findings>(); };
  Findings sum = result_of(pieces.front(), parse);
  for (std::size_t i = 1; i < pieces.size(); ++i) sum += result_of(pieces[i], parse);
  return sum;
}

int join(const CheckCommand& command, const CLI::App& parsed) {
  const std::vector<PieceFile> pieces = joined_pieces(parsed, command.pieces);
  if (pieces.front().result.contains("formats")) {
    Row notes = notes_of(parsed);
    notes["command"] = joined_command(pieces.front().note.command, command.out);
    return report_findings(sum_of<StiffFindings>(pieces),
                           {command.out, command.plot_width_mm, drawer_of(command), command.format, notes});
  }
  if (!command.out.empty()) throw std::runtime_error("--out: only stiff rays have files");
  if (pieces.front().result.contains("units"))
    return report_findings(sum_of<UnitsFindings>(pieces), command.format);
  const auto name = [](const Row& row) { return row.at("design").get<std::string>(); };
  const rtl::Design& design = rtl::find_design(result_of(pieces.front(), name));
  return design.kind == hls::triangle_kind ? report_findings(sum_of<TriangleFindings>(pieces), command.format)
                                           : report_findings(sum_of<CheckFindings>(pieces), command.format);
}

int replay(const CheckCommand& command) {
  const rtl::Design& design = command.choice.design();
  const Format format = command.choice.format();
  const Case c = ref::adversary::parse_case(*command.replay);
  const auto test = sim::make_box_test(design, format);
  test->start(c.ray);
  const bool hit = test->hit(c.box);
  const bool meets = test->meets(c.ray, c.box);
  const auto word = [](bool is_hit) { return is_hit ? "HIT" : "MISS"; };
  Row row{{"design", design.name}, {"bits", to_string(format)}, {"exact", word(meets)}, {"unit", word(hit)}};
  bool rtl_differs = false;
  if (command.rtl) {
    const sim::VerilatedDesign verilated(
        rtl::make_unit(design, format, rtl::Library::thesis(), {.interval = command.interval}));
    sim::Model model(verilated);
    sim::TestBatch one;
    one.add(test->operands(), test->results());
    const sim::DriveReport report = sim::drive(model, one);
    row["rtl"] = report.received > 0 ? word(report.hits > 0) : "no answer";
    rtl_differs = report.faults() > 0;
  }
  const std::vector<rtl::Port> ports = design.ports(format);
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const auto bits = static_cast<std::uint64_t>(test->operands()[i]) & hls::low_mask(ports[i].width);
    row[ports[i].name] = fmt::format("0x{:0{}x}", bits, (ports[i].width + 3) / 4);
  }
  fmt::print("{}", record_text(row, command.format));
  return check_verdict(design, meets && !hit ? 1 : 0, rtl_differs ? 1 : 0);
}

}  // namespace

CLI::App* add_check_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("check", "Judge a design exactly, on rays and boxes made to break it");
  const auto options = std::make_shared<CheckCommand>();
  const auto stiff = std::make_shared<StiffCheck>();
  CLI::Option* const names = add_designs_option(
      *command, stiff->units, "with --stiff or --safe those that never miss; otherwise name some");
  add_bits_option(
      *command, stiff->units,
      "the design's own; with --stiff 24/24, 20/24, 16/16 and 12/12 for n/t designs, and at most 8");
  add_list_option(*command, "--category", options->categories,
                  "Draw only from these categories; an unknown name lists all", "NAME");
  const CLI::Option* const tests = add_large_count_option(
      *command, "--tests", options->tests, 1, 10'000'000'000'000,
      "Number of tests, divided among the categories (1 to 10^13); with --stiff of boxes "
      "for each ratio (1 to 10^9, default 60000)");
  add_seed_option(*command, options->seed);
  add_count_option(*command, "--threads", options->threads, {1, 1024},
                   "Number of threads; results do not depend on it")
      ->capture_default_str();
  CLI::Option* const with_rtl =
      command->add_flag("--rtl", options->rtl, "The Verilog answers every test too");
  add_interval_option(*command, options->interval)->needs(with_rtl);
  command->add_option("--replay", options->replay, "Judge the one case that a failed check printed")
      ->type_name("CASE");
  CLI::Option* const is_safe =
      command->add_flag("--safe", options->safe, "Judge all designs that never miss, in one table");
  CLI::Option* const is_stiff = command->add_flag(
      "--stiff", options->stiff,
      "Count false hits as the components of a ray's direction grow apart, of several designs and formats");
  as_input(command->add_option(
               "--scene", stiff->scene.name,
               "With --stiff: also count the box tests of stiff rays through a built-in scene or a "
               "mesh file"))
      ->needs(is_stiff)
      ->type_name("NAME|FILE");
  add_cube_options(*command, stiff->scene);
  for (const char* const name : {"--cube", "--strict", "--faces"})
    command->get_option(name)->needs(command->get_option("--scene"));
  add_hierarchy_options(*command, stiff->hierarchy);
  for (const std::string_view name : hierarchy_option_names())
    command->get_option(std::string(name))->needs(is_stiff);
  add_large_count_option(*command, "--rays", stiff->rays, 1, 1'000'000'000,
                         "With --stiff: rays through the scene for each ratio (1 to 10^9)")
      ->needs(is_stiff);
  add_plot_width_option(*command, options->plot_width_mm, "With --stiff: ")->needs(is_stiff);
  for (const char* const other : {"--category", "--rtl", "--replay"})
    exclude(is_stiff, command->get_option(other), "stiff rays have cases of their own, and the C++ answers");
  exclude(is_safe, is_stiff, "--stiff without a design takes the same designs");
  exclude(is_safe, names, "it takes the designs that never miss");
  add_format_option(*command, options->format);
  CLI::Option* const out =
      add_pieces_options(*command, options->pieces, options->out, Output::folder,
                         "With --stiff: folder for the rows as CSV and for the plots as SVG, PDF and PNG");
  command->get_option("--plot-width")->needs(out);
  for (const char* const other : {"--pieces", "--piece", "--join", "--safe"})
    exclude(command->get_option("--replay"), command->get_option(other), "it judges one case");
  add_examples(*command, {"hitpipe check --safe", "hitpipe check --stiff --scene spheres --out stiff"});
  command->callback([options, stiff, tests, command, &exit_code] {
    if (!options->pieces.join.empty()) {
      exit_code = join(*options, *command);
      return;
    }
    if (options->stiff) {
      if (tests->count() > 0) stiff->tests = options->tests;
      if (stiff->tests > most_stiff)
        throw std::runtime_error(fmt::format("--tests: with --stiff allowed is 1 to {}", most_stiff));
      stiff->seed = options->seed;
      stiff->threads = options->threads;
      stiff->hierarchy.build.threads = options->threads;
      exit_code = judge_stiff(*options, *stiff, *command);
      return;
    }
    if (!options->out.empty() && !options->pieces.any())
      throw std::runtime_error("--out: needs --stiff, --pieces or --piece");
    const DesignsChoice& units = stiff->units;
    if (units.names.empty() && !options->safe)
      throw std::runtime_error(
          fmt::format("check: name designs, or give --safe; there are: {}", rtl::design_names()));
    if (!options->replay && (units.names.size() != 1 || units.bits.size() > 1)) {
      exit_code = judge_units(*options, units, *command);
      return;
    }
    options->choice = units.only("check");
    const rtl::Design& design = options->choice.design();
    if (options->replay && design.kind == hls::triangle_kind)
      throw std::runtime_error(
          fmt::format("--replay: design {} tests triangles; only cases of boxes are replayed", design.name));
    exit_code = options->replay ? replay(*options) : judge(*options, *command);
  });
  return command;
}

}  // namespace hitpipe::cli
