#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/sweep_answers.hpp"
#include "cli/commands/world_sweep.hpp"
#include "cli/options/cost_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/pieces/pieces.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/last_line.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/sweep_rows.hpp"
#include "cli/text/table.hpp"
#include "cli/version.hpp"
#include "host/files.hpp"
#include "host/machine.hpp"
#include "host/text.hpp"
#include "sim/cosim/ray_unit.hpp"
#include "sim/software/software.hpp"
#include "sim/sweep/resume.hpp"

namespace hitpipe::cli {

namespace {

struct SweepCommand {
  std::vector<int> mantissas;  ///< of boxes in the integer world
  SceneChoice scene;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  DesignsChoice units;
  std::vector<int> rays_in_flight{32};
  std::vector<int> intervals;  ///< empty: a test in every cycle
  ref::WhittedOptions light;
  RayListChoice rays;
  CostChoice cost;
  std::vector<std::string> rows;  ///< files with rows that were measured elsewhere
  PiecesChoice pieces;
  std::string out;
  OutputFormat format = OutputFormat::text;
};

std::vector<sim::SweepPoint> plan(const SweepCommand& command, const rtl::Library& library) {
  const std::vector<const rtl::Design*> designs =
      priced_by(library, command.units.designs(sim::why_not_traced), !command.units.names.empty());
  return sim::plan_sweep(command.units.formats(designs, sim::sweep_formats), command.rays_in_flight,
                         command.intervals.empty() ? std::vector{1} : command.intervals);
}

/// Cells as in the file. In JSON, numbers are numbers.
Row record(const sim::SweepRow& row) {
  Row record;
  for (const sim::SweepColumn& column : sim::sweep_columns) {
    const std::string cell = column.cell(row);
    record[std::string(column.name)] = column.is_text() ? Row(cell)
                                       : cell.empty()   ? Row(nullptr)
                                                        : Row::parse(cell);
  }
  return record;
}

std::string percent_text(double percent) {
  const std::string text = fmt::format("{:.{}f}", percent, percent < 100 ? 2 : 0);
  return text == "-0.00" ? "0.00" : text;
}

/// Units are compared by the area for each box that a test answers for.
/// `notes` are what stands beside the rows.
std::string text_of(const std::vector<sim::SweepRow>& rows, const Row& notes) {
  if (rows.empty()) return "";
  std::size_t name = 11;
  std::size_t bits = 5;
  bool several_boxes = false;
  bool intervals = false;
  for (const sim::SweepRow& row : rows) {
    name = std::max(name, row.design.size());
    bits = std::max(bits, row.bits.size());
    several_boxes = several_boxes || row.boxes_per_test > 1;
    intervals = intervals || row.interval > 1;
  }
  std::string text = fmt::format(
      "{:<{}} {:<{}}{}  rays  area extra % extra %     time area*time bytes/\n"
      "{:<{}} {:<{}}{}         {}   boxes  triang ms whole    whole    ray\n",
      "design", name, "bits", bits, intervals ? " II" : "", "", name, "", bits, intervals ? "   " : "",
      rows.front().on_chip() ? "LUT" : "mm2");
  for (const sim::SweepRow& row : rows) {
    const std::string area = row.on_chip() ? fmt::format("{:.0f}", row.area_per_box_lut())
                                           : fmt::format("{:.2f}", row.area_per_box_mm2());
    text += fmt::format("{:<{}} {:<{}}{} {:>5} {:>5} {:>7} {:>7} {:>8.4g} {:>8.4g} {:>6.0f}\n", row.design,
                        name, row.bits, bits, intervals ? fmt::format(" {:>2}", row.interval) : "",
                        row.rays_in_flight, area, percent_text(row.extra_box_tests_pct()),
                        percent_text(row.extra_triangle_tests_pct()), row.whole_run_time_ms(),
                        row.whole_area_run_time(), row.bytes_per_ray());
  }
  if (several_boxes) text += "area: for each box that a test answers for; area*time: of the whole unit\n";
  std::vector<std::string> below = recommendation(rows);
  below.push_back(cost_caveat(rows.front()));
  below.push_back(fmt::format("hierarchy: {}", notes.value("hierarchy", "")));
  if (notes.contains("mesh")) below.push_back(fmt::format("scene: {}", summary_of(notes.at("mesh"))));
  for (const std::string& line : below) text += host::wrapped(line, 2);
  return text;
}

/// Prints the rows and returns the exit code.
int report(const std::vector<sim::SweepRow>& rows, const Row& notes, OutputFormat format) {
  if (format == OutputFormat::csv) {
    fmt::print("{}", sim::to_csv(rows));
  } else if (format == OutputFormat::json) {
    std::vector<Row> records;
    for (const sim::SweepRow& row : rows) {
      records.push_back(record(row));
      if (notes.contains("mesh")) records.back().update(notes.at("mesh"));
    }
    fmt::print("{}", table_text(records, format));
  } else {
    fmt::print("{}", text_of(rows, notes));
  }
  int exit_code = 0;
  for (const sim::SweepRow& row : rows) {
    if (row.verified(rtl::find_design(row.design).conservative)) continue;
    fmt::print(stderr,
               "hitpipe: {} {} on {}: {} RTL mismatches, {} different triangles, {} different pixels, {} "
               "false misses; all must be 0\n",
               row.design, row.bits, row.scene, row.rtl_mismatches, row.different_triangles,
               row.different_pixels, row.false_misses);
    exit_code = 1;
  }
  return exit_code;
}

std::vector<Format> world_formats(const rtl::Design& /*design*/) {
  return usual_world_formats();
}

/// The design, if one triangle unit is asked for.
const rtl::Design* triangle_unit_of(const SweepCommand& command) {
  if (command.units.names.size() != 1) return nullptr;
  const rtl::Design& design = rtl::find_design(command.units.names.front());
  return design.kind == hls::triangle_kind ? &design : nullptr;
}

int sweep_triangles(const SweepCommand& command, const CLI::App& parsed, const rtl::Design& design,
                    const rtl::Library& library) {
  if (command.intervals.size() > 1)
    throw std::runtime_error("--ii: a sweep of a triangle unit takes one interval");
  if (!command.rows.empty()) throw std::runtime_error("--rows: a sweep of a triangle unit takes none");
  if (command.rays.given())
    throw std::runtime_error("--rays: a sweep of a triangle unit compares pictures, and a file makes none");
  const std::vector<Format> formats = command.units.formats({&design}, world_formats).front().formats;
  const auto measured = [&](host::Piece piece) {
    const host::Piece::Range mine = piece.range(formats.size());
    const auto first = formats.begin() + static_cast<std::ptrdiff_t>(mine.first);
    return sweep_world({.design = &design,
                        .formats = {first, first + static_cast<std::ptrdiff_t>(mine.size())},
                        .mantissas = command.mantissas.empty() ? std::vector{9, 11, 13} : command.mantissas,
                        .scene = command.scene,
                        .hierarchy = command.hierarchy,
                        .light = command.light,
                        .library = &library,
                        .interval = command.intervals.empty() ? 1 : command.intervals.front()},
                       notes_of(parsed));
  };
  return do_work(
      {parsed, command.pieces, command.out, formats.size(), "formats"},
      [&](host::Piece piece) { return to_row(measured(piece)); },
      [&] { return report_world(measured({}), command.out, command.format); });
}

/// Of a triangle unit.
int join_triangles(const SweepCommand& command, const CLI::App& parsed) {
  const std::vector<PieceFile> pieces = joined_pieces(parsed, command.pieces);
  WorldFindings all = result_of(pieces.front(), parse_world_findings);
  for (std::size_t i = 1; i < pieces.size(); ++i)
    for (Row& row : result_of(pieces[i], parse_world_findings).rows) all.rows.push_back(std::move(row));
  all.notes["command"] = joined_command(pieces.front().note.command, command.out);
  return report_world(all, command.out, command.format);
}

/// What stands beside the rows. Of a piece it also says which.
Row notes_beside(const SweepCommand& command, const CutWork& work, const ref::Scene& scene) {
  Row notes = notes_of(work.parsed);
  notes["hierarchy"] = command.hierarchy.text();
  notes.update(camera_notes(scene));
  notes["processor"] = host::processor();
  notes["compiler"] = host::compiler();
  notes["date"] = host::today();
  if (command.pieces.piece) notes["piece"] = to_row(piece_note(work));
  return notes;
}

/// Measures those of the points that the file does not hold yet. `notes` gets what stands beside them.
std::vector<sim::SweepRow> measure(const SweepCommand& command, const CutWork& work,
                                   const rtl::Library& library, const std::vector<sim::SweepPoint>& points,
                                   const std::filesystem::path& file, Row& notes) {
  sim::ResumableSweep sweep{.scene = nullptr,
                            .bvh = nullptr,
                            .points = points,
                            .options = {.width = command.scene.width,
                                        .height = command.scene.height,
                                        .threads = command.scene.threads,
                                        .light = command.light,
                                        .program = std::string(program_version()),
                                        .hierarchy = command.hierarchy.name(),
                                        .library = &library,
                                        .tests_only = command.cost.tests_only,
                                        .triangle = command.cost.triangle(library)},
                            .file = file,
                            .more = {command.rows.begin(), command.rows.end()}};
  std::optional<Progress> progress("reading the scene");
  const ref::Scene scene = command.scene.load();
  std::vector<sim::AskedRay> list;
  if (command.rays.given()) list = sim::read_ray_list(command.rays.file, scene.to_cube);
  sweep.options.rays = list;
  const ref::Bvh bvh = ref::make_hierarchy(scene, command.hierarchy).bvh;
  sweep.scene = &scene;
  sweep.bvh = &bvh;
  SweepAnswers answers(command.rays.answers, sweep.options);
  progress.emplace("sweeping");
  sweep.options.progress = [&](double share) { progress->show(share); };
  const std::filesystem::path out = command.out;
  notes = notes_beside(command, work, scene);
  sweep.notes = csv_metadata({csv_table(out, sim::to_csv({}))}, notes);
  sweep.notes_file = metadata_file(out);
  const LastLine line(
      answers.wanted()
          ? fmt::format("{} keeps its rows; a command with --answers begins without it", file.string())
          : fmt::format("the same command goes on with the rows of {}", file.string()));
  std::vector<sim::SweepRow> rows = sim::resume(sweep);
  if (answers.wanted()) {
    progress.emplace("tracing in software");
    answers.write(scene, bvh, sweep.options, notes);
  }
  return rows;
}

/// The rows of a piece are in a file of their own until there are all, so that its file is whole when it is
/// there.
int measure_piece(const SweepCommand& command, const CutWork& work, const rtl::Library& library,
                  const std::vector<sim::SweepPoint>& points) {
  const std::filesystem::path file = command.out;
  const std::filesystem::path growing = command.out + ".part";
  if (std::filesystem::exists(file)) {
    check_same_piece(work, note_beside(file).note);
  } else {
    static_cast<void>(piece_note(work));  // refuses what cannot be done
    const host::Piece::Range range = command.pieces.chosen().range(points.size());
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(range.first);
    const std::vector<sim::SweepPoint> mine(first, first + static_cast<std::ptrdiff_t>(range.size()));
    Row notes;
    std::vector<sim::SweepRow> rows = measure(command, work, library, mine, growing, notes);
    // Rows of another piece may be in the file, from before.
    std::erase_if(rows, [&](const sim::SweepRow& row) {
      const sim::RowKey key = sim::key_of(row.design, row.bits, row.rays_in_flight, row.interval);
      return std::none_of(mine.begin(), mine.end(),
                          [&](const sim::SweepPoint& point) { return sim::key_of(point) == key; });
    });
    sim::write_rows(file, rows);
  }
  std::filesystem::remove(growing);
  print_done(work);
  return 0;
}

int sweep(const SweepCommand& command, const CLI::App& parsed) {
  const rtl::Library library = command.cost.load();
  if (const rtl::Design* const design = triangle_unit_of(command))
    return sweep_triangles(command, parsed, *design, library);
  if (!command.mantissas.empty())
    throw std::runtime_error("--mantissas: only a sweep of a triangle unit has boxes of its own");
  const std::vector<sim::SweepPoint> points = plan(command, library);
  const CutWork work{parsed, command.pieces, command.out, points.size(), "rows"};
  if (command.pieces.pieces > 0) {
    print_pieces(work, "csv");
    return 0;
  }
  if (command.pieces.piece) return measure_piece(command, work, library, points);
  if (!command.rays.answers.empty() && std::filesystem::exists(command.out))
    throw std::runtime_error(
        fmt::format("--answers: rows that {} holds are not measured again; remove it or give another --out",
                    command.out));
  Row notes;
  const std::vector<sim::SweepRow> rows = measure(command, work, library, points, command.out, notes);
  return report(rows, notes, command.format);
}

int join(const SweepCommand& command, const CLI::App& parsed) {
  if (std::filesystem::path(command.pieces.join.front()).extension() == ".json")
    return join_triangles(command, parsed);
  std::vector<PieceFile> pieces;
  for (const std::string& file : command.pieces.join) pieces.push_back(note_beside(file));
  check_pieces(pieces, program_of(parsed), full_name(parsed));
  std::vector<sim::SweepRow> rows;
  for (const PieceFile& piece : pieces) {
    std::vector<sim::SweepRow> its =
        rows.empty() ? sim::read_rows(piece.file) : sim::read_rows_of(piece.file, rows.front());
    if (its.size() != piece.note.parts)
      throw std::runtime_error(fmt::format("{}: has {} rows, and its piece has {}; run its command again",
                                           piece.file.string(), its.size(), piece.note.parts));
    rows.insert(rows.end(), its.begin(), its.end());
  }
  const std::filesystem::path out = command.out;
  rows = sim::join_rows(out, rows);
  Row notes = pieces.front().result;
  notes["command"] = joined_command(pieces.front().note.command, command.out);
  notes.erase("piece");
  host::write_file(metadata_file(out), csv_metadata({csv_table(out, sim::to_csv({}))}, notes));
  return report(rows, notes, command.format);
}

}  // namespace

CLI::App* add_sweep_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("sweep", "Measure error, run time and area in many formats; can be resumed");
  const auto options = std::make_shared<SweepCommand>();
  add_scene_options(*command, options->scene);
  add_hierarchy_options(*command, options->hierarchy);
  add_designs_option(*command, options->units, "all");
  add_bits_option(*command, options->units,
                  "for n/t designs, n from 8 to 32 in steps of 4, each with t of n, n+4 and n+8");
  add_list_option(*command, "--rays-in-flight", options->rays_in_flight,
                  "Rays that share one pipeline; one row for each number (1 to 65536; default: 32)", "K")
      ->transform(number_from(1, sim::Station::most_rays));
  add_intervals_option(*command, options->intervals,
                       "a test may begin every N cycles; one row for each number");
  add_list_option(
      *command, "--mantissas", options->mantissas,
      "Of a triangle unit: bits p of the boxes' mantissas; one row for each (4 to 32; default: 9,11,13)", "P")
      ->transform(number_from(hls::MajorBits::min_mantissa, hls::MajorBits::max_mantissa));
  add_light_options(*command, options->light);
  add_ray_list_options(*command, options->rays);
  add_cost_options(*command, options->cost);
  as_input(add_list_option(
      *command, "--rows", options->rows,
      "Also take the rows of these files, which hitpipe sweep wrote for this scene and size", "FILE"));
  add_format_option(*command, options->format);
  add_pieces_options(*command, options->pieces, options->out, Output::file,
                     "File for the rows (.csv); rows that it already holds are not measured again")
      ->required();
  for (const char* const other : {"--pieces", "--piece"})
    exclude(command->get_option("--rows"), command->get_option(other), "a piece measures its own rows");
  exclude(command->get_option("--answers"), command->get_option("--rows"),
          "their rays were traced elsewhere");
  exclude_answers_of_pieces(*command);
  add_examples(*command, {"hitpipe sweep --scene spheres --out rows.csv",
                          "hitpipe sweep int_major --scene terrain --ii 1,4 --out rows.csv"});
  command->callback([options, command, &exit_code] {
    options->hierarchy.build.threads = options->scene.threads;
    exit_code = options->pieces.join.empty() ? sweep(*options, *command) : join(*options, *command);
  });
  return command;
}

}  // namespace hitpipe::cli
