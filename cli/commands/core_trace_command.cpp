#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/core_options.hpp"
#include "cli/options/core_scene_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/edge_ray_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/options/world_options.hpp"
#include "cli/pieces/pieces.hpp"
#include "cli/text/answers_file.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "cli/text/trace_text.hpp"
#include "host/files.hpp"
#include "host/format.hpp"
#include "rays/image/core_image.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core_options.hpp"
#include "rtl_gen/core/feature.hpp"
#include "sim/core/core_set.hpp"
#include "sim/core/memory_port.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/operands/answer.hpp"
#include "sw_ref/render/image_file.hpp"

namespace hitpipe::cli {

namespace {

struct TraceCommand {
  CoreSceneChoice traced;
  std::optional<std::string> bits;
  std::vector<int> rays_in_flight{128};
  RayListChoice rays;
  EdgeRayChoice edges;
  CoreChoice core;
  int model_kib = 0;  ///< of a cache that is a model in front of memory; 0: there is none
  std::string memory{"ideal"};
  std::string library{rtl::default_library};
  bool native = false;
  std::uint64_t parts = 1;  ///< of the rays, each traced by a core that is empty
  PiecesChoice pieces;
  std::string out;  ///< empty: no picture is written
  OutputFormat format = OutputFormat::text;
};

void check_parts(const TraceCommand& command, std::uint64_t most, std::string_view of_what) {
  if (command.parts > most)
    throw std::runtime_error(
        fmt::format("--parts {}: there are {} {}; allowed is 1 to {}", command.parts, most, of_what, most));
}

/// What a core answers a ray of a list, and the triangle that software finds.
struct CoreRayAnswer {
  ref::IntHit hit;
  hls::Failure failed;
  std::uint32_t exact;
};

/// In the format that the user names. Without: n is the image's, or 20; the origins' grid is one bit finer, and S
/// is n.
CoreScene scene_of(const TraceCommand& command) {
  std::optional<ref::CoreImage> stored = command.traced.stored();
  hls::WorldBits usual;
  if (stored) usual.coord = usual.slope = stored->header.coord_bits;
  const std::string bits = command.bits.value_or(to_string(Format(usual)));
  return command.traced.load(std::move(stored), parse_bits<hls::WorldBits>(bits), bits);
}

sim::MemoryOptions memory_of(const TraceCommand& command) {
  sim::MemoryOptions memory = sim::memory_behind(sim::memory_port(command.memory), command.core.core());
  memory.cache_kib = command.model_kib;
  return memory;
}

/// Each core traces each part of the rays. The parts are one after the other, each with all cores.
std::uint64_t runs_of(const TraceCommand& command) {
  return command.parts * command.rays_in_flight.size();
}

std::filesystem::path picture_file(const TraceCommand& command, const std::string& scene) {
  return std::filesystem::path(command.out) / (std::filesystem::path(scene).stem().string() + ".png");
}

/// What cores did in the runs of a piece, or in all.
struct Found {
  std::vector<CoreRun> runs;
  Row about{};                       ///< what is said of all
  std::string scene{};               ///< its name
  std::vector<glm::vec3> picture{};  ///< of the last core's answers, if it is drawn
};

class Tracing {
 public:
  explicit Tracing(const TraceCommand& command)
      : command_(command),
        library_(rtl::library_called(command.library)),
        traced_(scene_of(command)),
        cores_(traced_.scene, traced_.image,
               {.core = command.core.core(),
                .bits = usual_ray_format(traced_.scene->bits),
                .rays_in_flight = command.rays_in_flight,
                .memory = memory_of(command),
                .native = command.native}),
        draws_(!command.pieces.piece && !command.out.empty()),
        list_(command.rays.given() ? sim::read_ray_list(command.rays.file, traced_.scene->scene.to_cube)
                                   : std::vector<sim::AskedRay>()),
        file_(command.rays.answers, {"rays_in_flight"}),
        answers_(cores_.size()) {
    if (!list_.empty()) check_parts(command, list_.size(), "rays");
    if (command.edges.given()) {
      check_parts(command, command.edges.rays, "rays");
      questions_ = {.count_alone = command.edges.count_alone,
                    .closed = ref::closedness(traced_.scene->mesh).even()};
    }
    found_ = {.runs = {},
              .about = {{"hierarchy", traced_.hierarchy},
                        {"cache", cores_.has_cache()},
                        {"cache_is_model", command.model_kib > 0},
                        {"mesh", traced_.mesh}},
              .scene = traced_.scene->scene.name};
    if (command.edges.given()) found_.about["closed"] = questions_.closed;
    if (!draws_) return;
    host::make_folder(command.out);
    ref::check_image_place(picture_file(command, found_.scene));
  }

  void make_cores() { cores_.make(library_); }

  /// A run is of one core and one part of the rays.
  void run(std::uint64_t number, const std::function<void(double)>& progress) {
    const std::size_t core = number % cores_.size();
    begin(number / cores_.size());
    if (command_.edges.given()) {
      sim::QuestionOptions questions = questions_;
      questions.progress = progress;
      found_.runs.push_back({core, cores_.trace(core, edge_rays_, questions)});
      return;
    }
    const auto keep = [&](std::span<const sim::CoreAnswer> given) {
      for (std::size_t ray = 0; file_.wanted() && ray < given.size(); ++ray)
        answers_[core].push_back({given[ray].hit, given[ray].failed, rays_->triangles[ray]});
      if (draws_ && core + 1 == cores_.size()) draw(given);
    };
    found_.runs.push_back({core, cores_.trace(core, *rays_, progress, keep)});
  }

  /// Writes the answers, too.
  [[nodiscard]] Found finish(const CLI::App& parsed) {
    for (std::size_t core = 0; file_.wanted() && core < cores_.size(); ++core)
      write(command_.rays_in_flight[core], answers_[core]);
    Row notes = notes_of(parsed);
    notes.update(traced_.notes);
    file_.finish(notes);
    return std::move(found_);
  }

 private:
  /// The rays of a part are made once for all cores.
  void begin(std::uint64_t part) {
    if (part_ == part) return;
    part_ = part;
    const host::Piece piece = piece_of_all();
    if (command_.edges.given()) {
      edge_rays_ = command_.edges.of_part(*traced_.scene, piece);
    } else if (!list_.empty()) {
      const host::Piece::Range mine = piece.range(list_.size());
      rays_ = cores_.listed(std::span(list_).subspan(mine.first, mine.size()));
    } else {
      rays_ = cores_.picture(of_picture());
    }
  }
  [[nodiscard]] host::Piece piece_of_all() const { return {*part_ + 1, command_.parts}; }
  /// How the rays of the part are rendered.
  [[nodiscard]] ref::RenderOptions of_picture() const {
    return {.width = command_.traced.scene.width,
            .height = command_.traced.scene.height,
            .tiles = piece_of_all(),
            .picture = !command_.pieces.piece};
  }
  void draw(std::span<const sim::CoreAnswer> given) {
    const std::vector<glm::vec3> drawn = rays_->drawn(given, of_picture());
    found_.picture.resize(drawn.size());
    for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel) found_.picture[pixel] += drawn[pixel];
  }
  /// Writes the T that the core gave, so that a wrong T shows.
  void write(int rays_in_flight, const std::vector<CoreRayAnswer>& answers) {
    const std::vector<std::string> unit{fmt::format("{}", rays_in_flight)};
    file_.add(unit, list_, [&](std::size_t ray) {
      const auto& [hit, failed, exact] = answers[ray];
      sim::Answer answer{.given = !failed,
                         .exact = sim::meeting_of_number(*traced_.scene, list_[ray], exact)};
      if (!failed && hit.found())
        answer.found = sim::meeting_at(*traced_.scene, list_[ray], hit.triangle, hit.t);
      return answer;
    });
  }

  const TraceCommand& command_;
  rtl::Library library_;
  CoreScene traced_;
  sim::CoreSet cores_;
  bool draws_;
  std::vector<sim::AskedRay> list_;
  AnswersFile file_;
  std::vector<std::vector<CoreRayAnswer>> answers_;  ///< by core
  sim::QuestionOptions questions_;                   ///< of rays at edges
  std::optional<std::uint64_t> part_;
  std::optional<sim::PictureRays> rays_;  ///< of the part
  std::vector<ref::Ray> edge_rays_;
  Found found_;
};

/// Does the runs of a piece.
Found run(const TraceCommand& command, const CLI::App& parsed, host::Piece piece) {
  std::optional<Progress> progress("reading the scene");
  Tracing tracing(command);
  progress.emplace("making the cores");
  tracing.make_cores();
  progress.emplace("tracing");
  const host::Piece::Range mine = piece.range(runs_of(command));
  for (std::uint64_t i = mine.first; i < mine.end; ++i)
    tracing.run(i, [&](double share) {
      progress->show((static_cast<double>(i - mine.first) + share) / static_cast<double>(mine.size()));
    });
  return tracing.finish(parsed);
}

/// Prints what the cores did in all their runs, and returns whether it was right.
bool report(const std::vector<CoreRun>& runs, const Row& about, OutputFormat format) {
  const bool cache = about.value("cache", false), edges = about.contains("closed");
  std::vector<sim::CoreTrace> cores;
  for (const CoreRun& run : runs) {
    if (run.core == cores.size())
      cores.push_back(run.trace);
    else
      cores.at(run.core) += run.trace;
  }
  std::vector<Row> rows;
  bool right = true;
  for (const sim::CoreTrace& trace : cores) {
    rows.push_back(format == OutputFormat::text ? Row::object() : about.at("mesh"));
    rows.back().update(edges ? edge_row(trace, about.at("closed"), format) : trace_row(trace, cache));
    right = right && trace.right();
  }
  fmt::print("{}", table_text(format == OutputFormat::text ? turned(rows) : rows, format));
  if (format == OutputFormat::text) {
    if (about.value("cache_is_model", false))
      fmt::print("cache: a model in front of the core, which has at most {} KiB itself\n",
                 rtl::core_option("--cache").most);
    fmt::print("hierarchy: {}\nscene: {}\n", about.value("hierarchy", ""), summary_of(about.at("mesh")));
  }
  return right;
}

int trace_scene(TraceCommand command, const CLI::App& parsed) {
  command.traced.hierarchy.build.threads = command.traced.scene.threads;
  if (!command.rays.given() && !command.edges.given())
    check_parts(command,
                ref::tile_count({.width = command.traced.scene.width, .height = command.traced.scene.height}),
                "tiles");
  const auto piece = [&](host::Piece mine) {
    const Found found = run(command, parsed, mine);
    return kept_runs(found.runs, found.about);
  };
  const auto all = [&] {
    const Found found = run(command, parsed, {});
    const bool right = report(found.runs, found.about, command.format);
    if (right && !command.out.empty())
      ref::write_image(picture_file(command, found.scene), command.traced.scene.width,
                       command.traced.scene.height, found.picture);
    return right ? 0 : 1;
  };
  return do_work({parsed, command.pieces, command.out, runs_of(command), "runs of cores"}, piece, all);
}

int join(const TraceCommand& command, const CLI::App& parsed) {
  if (!command.out.empty()) throw std::runtime_error("--out: pieces make no picture");
  const std::vector<PieceFile> pieces = joined_pieces(parsed, command.pieces);
  std::vector<CoreRun> runs;
  for (const PieceFile& piece : pieces)
    result_of(piece, [&](const Row& row) {
      for (const CoreRun& each : parse_runs(row)) runs.push_back(each);
    });
  return report(runs, pieces.front().result, command.format) ? 0 : 1;
}

}  // namespace

CLI::App* add_core_trace_command(CLI::App& core, int& exit_code) {
  CLI::App* const command = core.add_subcommand("trace", "Trace a scene by a core, cycle by cycle");
  const auto options = std::make_shared<TraceCommand>();
  const auto [scene, image] = add_core_scene_options(*command, options->traced);
  command
      ->add_option("--bits", options->bits,
                   "Format of the integer world, n+gsS. With --image n is the image's, and the default n+1sn")
      ->default_str(to_string(Format(hls::WorldBits{})))
      ->type_name("FORMAT");
  command
      ->add_option("--rays-in-flight", options->rays_in_flight,
                   "Rays that the core has room for, a row for each number (1 to 256)")
      ->delimiter(',')
      ->capture_default_str()
      ->transform(number_from(1, 256))
      ->type_name("N");
  using Group = rtl::CoreOption::Group;
  add_core_options(*command, options->core, {Group::core, Group::limits});
  add_memory_option(*command, options->memory);
  constexpr int most_model_kib = sim::MemoryOptions::most_cache_kib;
  add_core_options(
      *command, options->core, {Group::bus, Group::cache},
      Beyond{"--cache", most_model_kib, options->model_kib,
             fmt::format(". A larger one, up to {}, is a model in front of memory, with 8 ways and "
                         "lines of 64 bytes",
                         most_model_kib)});
  add_library_option(*command, options->library);
  command->add_flag("--native", options->native,
                    "The core as C++, which is the same in every cycle; else as Verilog");
  add_ray_list_options(*command, options->rays);
  add_large_count_option(
      *command, "--parts", options->parts, 1, host::Piece::most,
      "Cut the rays into so many parts, at most one for each 32 x 32 pixels. A core begins each of them "
      "empty, so pieces of the work can have some of them (1 to 10^6)");
  add_format_option(*command, options->format);
  add_pieces_options(*command, options->pieces, options->out, Output::folder,
                     "Folder for the picture that the answers make, SCENE.png; written when all are right");
  exclude_answers_of_pieces(*command);
  add_edge_ray_options(*command, options->edges);
  needs_one_of(*command, {scene, image, command->get_option("--join")});
  add_examples(*command, {"hitpipe core trace --scene spheres --out out",
                          "hitpipe core trace --scene terrain --rays-in-flight 32,128 --native",
                          "hitpipe core trace --image spheres.bin --rays rays.csv --answers answers.csv"});
  command->callback([options, command, &exit_code] {
    const bool other_rays = options->rays.given() || options->edges.given();
    if (other_rays && !options->out.empty() && !options->pieces.any())
      throw CLI::ParseError(options->rays.given()
                                ? "--rays excludes --out: the rays of a file make no picture"
                                : "--edge-rays excludes --out: rays at edges make no picture",
                            CLI::ExitCodes::ExcludesError);
    for (const char* const of_core : {"--cache-line", "--cache-ways"})
      if (options->model_kib > 0 && command->get_option(of_core)->count() > 0)
        throw CLI::ParseError(
            fmt::format("{}: --cache {} is a model in front of memory; allowed is up to {} with these",
                        of_core, options->model_kib, rtl::core_option("--cache").most),
            CLI::ExitCodes::ExcludesError);
    options->edges.check(*command, options->core.options.questions);
    exit_code = options->pieces.join.empty() ? trace_scene(*options, *command) : join(*options, *command);
  });
  return command;
}

}  // namespace hitpipe::cli
