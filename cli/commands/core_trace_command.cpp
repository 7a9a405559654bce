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
#include "rtl_gen/core/core.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/memory_port.hpp"
#include "sim/core/native_core.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/machine/verilated_machine.hpp"
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

/// A scene as cores trace it: which rays, and each core's machine.
class Tracing {
 public:
  explicit Tracing(const TraceCommand& command)
      : command_(command),
        library_(rtl::library_called(command.library)),
        traced_(scene_of(command)),
        walking_{.world = bits(),
                 .boxes = usual_box_format(bits()),
                 .places = 1 << command.core.options.stack_bits},
        memory_(memory_of(command)) {
    check_room();
    if (command.rays.given()) list_ = sim::read_ray_list(command.rays.file, traced_.scene->scene.to_cube);
    if (!list_.empty()) check_parts(command, list_.size(), "rays");
    if (command.edges.given()) {
      check_parts(command, command.edges.rays, "rays");
      questions_ = {.count_alone = command.edges.count_alone,
                    .closed = ref::closedness(traced_.scene->mesh).even()};
    }
  }

  void make_cores() {
    std::vector<rtl::CoreOptions> options;
    for (const int rays : command_.rays_in_flight) {
      rtl::CoreOptions& core = options.emplace_back(command_.core.core());
      core.bits = usual_ray_format(bits());
      core.rays = rays;
      sim::make_room(core, traced_.image);
    }
    cores_ = rtl::make_cores(options, library_);
    for (const rtl::Core& core : cores_) {
      if (command_.native)
        machines_.push_back(std::make_unique<sim::NativeCore>(core));
      else
        machines_.push_back(std::make_unique<sim::VerilatedMachine>(core, rtl::to_verilog(core, library_)));
    }
  }

  /// The rays of a part, with what software answers and reads for them.
  [[nodiscard]] sim::PictureRays rays(host::Piece part) const {
    if (!list_.empty()) {
      const host::Piece::Range mine = part.range(list_.size());
      return sim::listed_rays(traced_.scene, traced_.image, walking_,
                              std::span(list_).subspan(mine.first, mine.size()));
    }
    return sim::picture_rays(traced_.scene, traced_.image, walking_, of_picture(part));
  }
  /// Of a part, at edges and corners.
  [[nodiscard]] std::vector<ref::Ray> edge_rays(host::Piece part) const {
    return command_.edges.of_part(*traced_.scene, part);
  }
  /// How the rays of a part are rendered.
  [[nodiscard]] ref::RenderOptions of_picture(host::Piece part) const {
    return {.width = command_.traced.scene.width,
            .height = command_.traced.scene.height,
            .tiles = part,
            .picture = !command_.pieces.piece};
  }

  using Keep = std::function<void(std::span<const sim::CoreAnswer>)>;
  [[nodiscard]] sim::CoreTrace trace(std::size_t core, const sim::PictureRays& rays,
                                     const std::function<void(double)>& progress, const Keep& keep) const {
    return sim::trace_core(cores_[core], *machines_[core], traced_.image, rays, memory_, progress, keep);
  }

  [[nodiscard]] sim::CoreTrace trace(std::size_t core, std::span<const ref::Ray> edge_rays,
                                     const std::function<void(double)>& progress) const {
    sim::QuestionOptions questions = questions_;
    questions.progress = progress;
    return sim::trace_core(cores_[core], *machines_[core], traced_.image, *traced_.scene, edge_rays, memory_,
                           questions);
  }
  [[nodiscard]] bool is_closed() const { return questions_.closed; }
  /// In the core, or as a model.
  [[nodiscard]] bool has_cache() const { return memory_.reads_lines || memory_.cache_kib > 0; }

  /// Writes the T that the core gave, so that a wrong T shows.
  void write(AnswersFile& file, int rays_in_flight, const std::vector<CoreRayAnswer>& answers) const {
    const std::vector<std::string> unit{fmt::format("{}", rays_in_flight)};
    file.add(unit, list_, [&](std::size_t ray) {
      const auto& [hit, failed, exact] = answers[ray];
      sim::Answer answer{.given = !failed,
                         .exact = sim::meeting_of_number(*traced_.scene, list_[ray], exact)};
      if (!failed && hit.found())
        answer.found = sim::meeting_at(*traced_.scene, list_[ray], hit.triangle, hit.t);
      return answer;
    });
  }
  [[nodiscard]] const CoreScene& traced() const { return traced_; }

 private:
  /// Throws std::runtime_error, one line, for what the image has more of than the core.
  void check_room() const {
    const ref::CoreHeader& image = traced_.image.header;
    const rtl::CoreOptions& core = command_.core.options;
    const auto check = [](const char* option, int given, const std::string& has, int needed, int most) {
      if (needed > given)
        throw std::runtime_error(
            fmt::format("{} {}: the scene has {}; allowed is {} to {}", option, given, has, needed, most));
    };
    check("--levels", core.levels, fmt::format("{} records on a path", image.levels), image.levels,
          rtl::CoreOptions::most_levels);
    check("--number-bits", core.number_bits, fmt::format("{} triangles", image.in_source()),
          image.number_bits(), hls::triangle_number_bits);
    check("--leaf-bits", core.leaf_bits, fmt::format("leaves with {} triangles", image.most_in_leaf),
          image.leaf_bits(), hls::child_count_bits);
  }
  [[nodiscard]] const hls::WorldBits& bits() const { return traced_.scene->bits; }

  const TraceCommand& command_;
  rtl::Library library_;
  CoreScene traced_;
  ref::CoreTracerOptions walking_;
  sim::MemoryOptions memory_;
  std::vector<sim::AskedRay> list_;
  sim::QuestionOptions questions_;  ///< of rays at edges
  std::vector<rtl::Core> cores_;
  std::vector<std::unique_ptr<rtl::NativeMachine>> machines_;
};

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

/// Each core traces each part of the rays. The parts are one after the other, each with all cores.
std::uint64_t runs_of(const TraceCommand& command) {
  return command.parts * command.rays_in_flight.size();
}

std::filesystem::path picture_file(const TraceCommand& command, const std::string& scene) {
  return std::filesystem::path(command.out) / (std::filesystem::path(scene).stem().string() + ".png");
}

/// Does the runs of a piece, and writes the answers. `picture` gets what the last core's answers show, `scene` the name,
/// `about` what is said of all.
std::vector<CoreRun> run(const TraceCommand& command, const CLI::App& parsed, host::Piece piece,
                         std::vector<glm::vec3>& picture, std::string& scene, Row& about) {
  std::optional<Progress> progress("reading the scene");
  Tracing tracing(command);
  scene = tracing.traced().scene->scene.name;
  AnswersFile file(command.rays.answers, {"rays_in_flight"});
  about = {{"hierarchy", tracing.traced().hierarchy},
           {"cache", tracing.has_cache()},
           {"cache_is_model", command.model_kib > 0},
           {"mesh", tracing.traced().mesh}};
  if (command.edges.given()) about["closed"] = tracing.is_closed();
  const bool draws = !command.pieces.piece && !command.out.empty();
  if (draws) {
    host::make_folder(command.out);
    ref::check_image_place(picture_file(command, scene));
  }
  progress.emplace("making the cores");
  tracing.make_cores();
  progress.emplace("tracing");
  const host::Piece::Range mine = piece.range(runs_of(command));
  const std::size_t cores = command.rays_in_flight.size();
  std::vector<CoreRun> runs;
  std::vector<std::vector<CoreRayAnswer>> answers(cores);
  std::optional<std::uint64_t> part;
  std::optional<sim::PictureRays> rays;
  std::vector<ref::Ray> edge_rays;
  for (std::uint64_t i = mine.first; i < mine.end; ++i) {
    const auto show = [&](double share) {
      progress->show((static_cast<double>(i - mine.first) + share) / static_cast<double>(mine.size()));
    };
    if (part != i / cores) {
      part = i / cores;
      const host::Piece of_all{*part + 1, command.parts};
      if (command.edges.given())
        edge_rays = tracing.edge_rays(of_all);
      else
        rays = tracing.rays(of_all);
    }
    if (command.edges.given()) {
      runs.push_back({i % cores, tracing.trace(i % cores, edge_rays, show)});
      continue;
    }
    const auto keep = [&](std::span<const sim::CoreAnswer> given) {
      for (std::size_t ray = 0; file.wanted() && ray < given.size(); ++ray)
        answers[i % cores].push_back({given[ray].hit, given[ray].failed, rays->triangles[ray]});
      if (!draws || i % cores + 1 != cores) return;
      const std::vector<glm::vec3> drawn = rays->drawn(given, tracing.of_picture({*part + 1, command.parts}));
      picture.resize(drawn.size());
      for (std::size_t pixel = 0; pixel < picture.size(); ++pixel) picture[pixel] += drawn[pixel];
    };
    runs.push_back({i % cores, tracing.trace(i % cores, *rays, show, keep)});
  }
  if (file.wanted())
    for (std::size_t core = 0; core < cores; ++core)
      tracing.write(file, command.rays_in_flight[core], answers[core]);
  Row notes = notes_of(parsed);
  notes.update(tracing.traced().notes);
  file.finish(notes);
  return runs;
}

int trace_scene(TraceCommand command, const CLI::App& parsed) {
  command.traced.hierarchy.build.threads = command.traced.scene.threads;
  if (!command.rays.given() && !command.edges.given())
    check_parts(command,
                ref::tile_count({.width = command.traced.scene.width, .height = command.traced.scene.height}),
                "tiles");
  std::vector<glm::vec3> picture;
  std::string scene;
  Row about;
  const auto piece = [&](host::Piece mine) {
    const std::vector<CoreRun> runs = run(command, parsed, mine, picture, scene, about);
    return kept_runs(runs, about);
  };
  const auto all = [&] {
    const std::vector<CoreRun> runs = run(command, parsed, {}, picture, scene, about);
    const bool right = report(runs, about, command.format);
    if (right && !command.out.empty())
      ref::write_image(picture_file(command, scene), command.traced.scene.width, command.traced.scene.height,
                       picture);
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
