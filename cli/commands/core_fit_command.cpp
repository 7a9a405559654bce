#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/core_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/implement_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/core_fit_text.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/implementation_text.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "rtl_gen/core/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/core_vectors.hpp"
#include "sim/fit/core_fit.hpp"
#include "sim/implement/core_implementation.hpp"
#include "sim/machine/verilated_machine.hpp"
#include "sim/vectors/design_vectors.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/world/int_error.hpp"

namespace hitpipe::cli {

namespace {

struct CoreFitCommand {
  SceneChoice placing;  ///< of all scenes
  std::vector<std::string> scenes;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  std::optional<std::string> bits;  ///< of the integer world, or of a core
  CoreChoice core;
  sim::CoreFitOptions fit;
  std::string memory{"dram"};
  std::string library{rtl::default_library};
  std::string target;  ///< empty: it is not mapped
  std::string out, module;
  OutputFormat format = OutputFormat::text;
};

/// A scene's rays through the fitted core in Verilog.
struct FittedTrace {
  std::string scene;
  sim::CoreTrace trace;
  std::uint64_t different_pixels = 0;
  ref::Share different;  ///< rays that find another triangle than in floats
};

class Fitting {
 public:
  Fitting(const CoreFitCommand& command, const CLI::App& parsed)
      : command_(command),
        parsed_(parsed),
        target_(command.target.empty() ? std::nullopt : std::optional(sim::target_called(command.target))),
        library_(rtl::library_called(target_ ? target_->library : command.library)) {}

  int run() {
    if (!command_.module.empty()) rtl::check_module_name(command_.module);
    if (target_) (void)sim::find_chip_tools(*target_);
    host::make_folder(command_.out);
    read_scenes();
    search();
    emit();
    trace();
    if (target_) implement();
    progress_.reset();
    return report();
  }

 private:
  void show(const std::string& step) {
    if (step == step_) return;
    step_ = step;
    progress_.emplace(step);
  }

  void read_scenes() {
    for (const std::string& name : command_.scenes) {
      show("reading " + name);
      SceneChoice choice = command_.placing;
      choice.name = name;
      scenes_.push_back(choice.load());
    }
  }

  void search() {
    sim::CoreFitOptions options = command_.fit;
    options.hierarchy = command_.hierarchy;
    options.core = command_.core.core();
    options.memory = sim::memory_port(command_.memory);
    options.width = command_.placing.width;
    options.height = command_.placing.height;
    if (command_.memory != "ideal") options.caches = {0, 4, 16, 64};
    if (command_.bits) {
      const bool whole = command_.bits->find('/') != std::string::npos;
      options.fixed.world = true;
      options.fixed.boxes = whole;
      if (whole) {
        options.core.bits = parse_bits<hls::RayBits>(*command_.bits);
      } else {
        const auto world = parse_bits<hls::WorldBits>(*command_.bits);
        options.core.bits = {world.coord, world.finer, options.core.bits.mantissa,
                             0,           world.slope, world.fraction};
      }
    }
    if (target_) {
      for (const sim::Resource& resource : target_->resources) {
        if (resource.name == "luts") options.most_luts = resource.available;
        if (resource.name == "rams" && library_.name().starts_with("ice40"))
          options.core.block_rams = resource.available.value_or(0);
      }
    }
    options.progress = [this](const std::string& step) { show(step); };
    fit_ = sim::fit_core(scenes_, options, library_);
    options_ = options;
  }

  void emit() {
    show("writing the core");
    core_ = rtl::make_core(fit_->core, library_, command_.module);
    std::vector<host::File> files =
        rtl::core_files(*core_, library_, sim::core_test(*core_, sim::usual_core_cycles, sim::usual_seed));
    rtl::add_drawings(files);
    for (const sim::CoreFitScene& scene : fit_->scenes)
      files.push_back({stem(scene.scene->scene.name) + ".bin", ref::core_image_bytes(scene.image.blocks)});
    host::write_files(command_.out, files);
  }

  void trace() {
    show("compiling the Verilog");
    sim::VerilatedMachine machine(*core_, rtl::to_verilog(*core_, library_));
    const sim::MemoryOptions memory = sim::memory_behind(options_->memory, core_->options);
    for (const sim::CoreFitScene& scene : fit_->scenes) {
      const std::string& name = scene.scene->scene.name;
      show("tracing " + name + " in Verilog");
      const ref::RenderOptions picture{.width = options_->width, .height = options_->height};
      const sim::PictureRays rays = sim::picture_rays(scene.scene, scene.image,
                                                      {.world = core_->options.bits.world(),
                                                       .boxes = core_->options.bits.boxes(),
                                                       .places = 1 << core_->options.stack_bits},
                                                      picture);
      std::vector<glm::vec3> drawn;
      FittedTrace& made = traces_.emplace_back();
      made.scene = name;
      made.trace = sim::trace_core(
          *core_, machine, scene.image, rays, memory, {},
          [&](std::span<const sim::CoreAnswer> answers) { drawn = rays.drawn(answers, picture); });
      const auto of_scene = static_cast<std::size_t>(&scene - fit_->scenes.data());
      const ref::IntError error = ref::int_error(scenes_[of_scene], {.world = core_->options.bits.world(),
                                                                     .width = picture.width,
                                                                     .height = picture.height,
                                                                     .hierarchy = command_.hierarchy});
      made.different_pixels = error.different_pixels;
      const sim::TriedWorld* const taken = fit_->taken();
      made.different = taken == nullptr ? error.different() : taken->different[of_scene];
      draw(stem(name) + ".png", drawn);
      draw(stem(name) + "_different.png", marked(drawn, error.different_at));
    }
  }
  /// The picture in grey, with the pixels that differ in red.
  static std::vector<glm::vec3> marked(std::vector<glm::vec3> picture,
                                       const std::vector<std::uint32_t>& different) {
    for (glm::vec3& pixel : picture) pixel = glm::vec3((pixel.x + pixel.y + pixel.z) / 6);
    for (const std::uint32_t at : different) picture.at(at) = {1, 0, 0};
    return picture;
  }
  void draw(const std::string& file, const std::vector<glm::vec3>& picture) const {
    ref::write_image(std::filesystem::path(command_.out) / file, options_->width, options_->height, picture);
  }
  static std::string stem(const std::string& scene) { return std::filesystem::path(scene).stem().string(); }

  void implement() {
    sim::ImplementOptions options;
    options.folder = command_.out;
    options.seeds = 0;
    options.progress = [this](const std::string& step) { show(step); };
    implemented_ = sim::implement_core(fit_->core, *target_, options);
  }

  [[nodiscard]] Row trace_row(const FittedTrace& traced) const {
    Row row{{"scene", traced.scene},
            {"rays", traced.trace.counts.rays},
            {"wrong", traced.trace.wrong},
            {"failed", traced.trace.counts.failed},
            {"cycles_a_ray", traced.trace.a_ray(traced.trace.counts.cycles)},
            {"different_pixels", traced.different_pixels}};
    add_other_triangles(row, traced.different);
    return row;
  }

  int report() {
    Row core{{"core", "fitted"}}, usual{{"core", "default"}};
    core.update(core_row(fit_->core, fit_->price.all, fit_->rate, library_));
    usual.update(core_row(fit_->before, fit_->price_before.all, fit_->rate_before, library_));
    std::vector<Row> tried, cuts, traced;
    for (const sim::TriedWorld& each : fit_->tried) {
      Row& row = tried.emplace_back(Row{{"bits", to_string(Format(each.bits))}});
      add_other_triangles(row, each.worst());
      row["taken"] = each.taken ? "yes" : "";
    }
    for (const sim::CoreCut& cut : fit_->cuts) cuts.push_back(cut_row(cut, fit_->price.all, library_));
    for (const FittedTrace& each : traces_) traced.push_back(trace_row(each));
    Row all = notes_of(parsed_);
    all.update({{"module", core_->module},
                {"library", library_.name()},
                {"memory", command_.memory},
                {"cores_tried", fit_->cores_tried},
                {"formats_tried", tried},
                {"fitted", core},
                {"default", usual},
                {"left_out", cuts},
                {"scenes", traced}});
    std::string faults;
    if (implemented_) {
      Row mapped{{"target", target_->name}};
      mapped.update(taken_row(implemented_->core.chip));
      all["mapped"] = mapped;
      if (const std::string fault = fault_of(*target_, implemented_->core.chip); !fault.empty())
        faults += fmt::format("hitpipe: {} {}\n", core_->module, fault);
    }
    for (const FittedTrace& each : traces_)
      if (!each.trace.right())
        faults += fmt::format("hitpipe: {}: {} of {} answers are wrong\n", each.scene, each.trace.wrong,
                              each.trace.counts.rays);
    host::write_file(std::filesystem::path(command_.out) / "fit.json", record_text(all, OutputFormat::json));
    print(all, {usual, core}, tried, cuts, traced);
    fmt::print(stderr, "{}", faults);
    return faults.empty() ? 0 : 1;
  }
  void print(const Row& all, const std::vector<Row>& cores, const std::vector<Row>& tried,
             const std::vector<Row>& cuts, const std::vector<Row>& traced) const {
    if (command_.format == OutputFormat::json) {
      fmt::print("{}", record_text(all, OutputFormat::json));
      return;
    }
    if (command_.format == OutputFormat::csv) {
      fmt::print("{}", table_text(cuts, OutputFormat::csv));
      return;
    }
    if (!tried.empty()) fmt::print("{}\n", shares_table(tried));
    fmt::print("{}\n", columns_text(cores));
    if (!cuts.empty()) fmt::print("{}\n", table_text(cuts, OutputFormat::text));
    fmt::print("{}", shares_table(traced));
    if (all.contains("mapped"))
      fmt::print("\n{}", record_text(without_nothing(all.at("mapped")), OutputFormat::text));
    fmt::print(
        "\nA share is how much smaller the core is than without that cut alone; shares do\n"
        "not add up.\n"
        "others: compared rays that find another triangle than in floats; Wilson's 95 %\n"
        "pixels: those that differ from the picture in floats\n{}memory: {}; files: {}\n",
        not_known(), command_.memory, command_.out);
  }

  /// What no picture can tell of the error that was asked for.
  [[nodiscard]] std::string not_known() const {
    const sim::TriedWorld* const taken = fit_->taken();
    if (taken == nullptr) return "";
    const double high = taken->worst().percent_interval().high;
    if (high <= options_->error_pct) return "";
    return fmt::format(
        "No picture tells whether --error {:g} holds: no compared ray differs, so {:.2g} % at most may.\n",
        options_->error_pct, high);
  }

  const CoreFitCommand& command_;
  const CLI::App& parsed_;
  std::optional<sim::Target> target_;
  rtl::Library library_;
  std::vector<ref::Scene> scenes_;
  std::optional<sim::CoreFitOptions> options_;
  std::optional<sim::CoreFit> fit_;
  std::optional<rtl::Core> core_;
  std::vector<FittedTrace> traces_;
  std::optional<sim::CoreImplementation> implemented_;
  std::string step_;
  std::optional<Progress> progress_;
};

}  // namespace

CLI::App* add_core_fit_command(CLI::App& core, int& exit_code) {
  CLI::App* const command =
      core.add_subcommand("fit", "Leave out of a core what scenes do not need, and check it");
  const auto options = std::make_shared<CoreFitCommand>();
  options->placing.width = options->placing.height = 64;
  add_scene_options(*command, options->placing);
  command->remove_option(command->get_option("--scene"));
  command->remove_option(
      command->get_option("--target"));  // here it is a chip; a scene file says where a camera looks
  add_list_option(
      *command, "--scene", options->scenes,
      "Scenes that the core is for, with commas between them: built-in ones (hitpipe list), scene files "
      "or meshes",
      "NAME|FILE")
      ->required();
  add_hierarchy_options(*command, options->hierarchy, Boxes::integers);
  command
      ->add_option(
          "--bits", options->bits,
          "Bits of coordinates, n+gsS, or of boxes too, n+g/psS. By default those that --error allows")
      ->type_name("FORMAT");
  command
      ->add_option(
          "--error", options->fit.error_pct,
          "Percent of the rays that may find another triangle than in the float world. As many rays are "
          "compared as tell it; Wilson's 95 % interval has to end below it")
      ->transform(number_from(0.0, 100.0))
      ->capture_default_str()
      ->type_name("P");
  const Choices<sim::CoreGoal> goals{{"area", sim::CoreGoal::area}, {"rate", sim::CoreGoal::rate}};
  add_choice_option(
      *command, "--for", options->fit.goal, goals,
      "The least area, or the most rays a second: of what fits the target, or without one for its size");
  command
      ->add_option(
          "--rate-rays", options->fit.rays_per_second,
          "With --for area: rays a second that the core traces in each scene (0 to 10^12); 0 is any rate")
      ->transform(number_from(0.0, 1e12))
      ->type_name("R");
  command
      ->add_option("--overhead", options->fit.overhead_pct,
                   "With --for area: so many percent more blocks may be read, because of coarse boxes and a "
                   "short stack")
      ->transform(number_from(0.0, 1000.0))
      ->capture_default_str()
      ->type_name("P");
  add_memory_option(*command, options->memory);
  add_library_option(*command, options->library);
  CLI::Option* const target = add_target_option(*command, options->target);
  exclude(target, command->get_option("--library"), "a target has its library");
  using Group = rtl::CoreOption::Group;
  add_core_options(*command, options->core,
                   {Group::rays, Group::core, Group::cache, Group::ports, Group::limits});
  for (const auto& [option, fixed] : sim::fitted_options)
    command->get_option(std::string(option))->default_str("by the fit");
  add_count_option(*command, "--clock-ps", options->core.options.clock_ps, {1, 1'000'000'000},
                   "Clock period in picoseconds of the units; by default that of the slowest machine");
  add_core_options(*command, options->core, {Group::bus});
  command
      ->add_option("--name", options->module,
                   "Name of the Verilog module, which also begins the names of all files")
      ->type_name("MODULE");
  add_folder_option(*command, options->out,
                    "Folder for the core, the scenes' images and pictures, and fit.json")
      ->required();
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe core fit --scene spheres --out core",
                          "hitpipe core fit --scene spheres --bits 12+0s12 --target ice40_up5k --out core"});
  command->callback([options, command, &exit_code] {
    options->hierarchy.build.threads = options->placing.threads;
    for (const auto& [option, fixed] : sim::fitted_options)
      options->fit.fixed.*fixed = command->get_option(std::string(option))->count() > 0;
    const auto unused = [&](const char* option, const char* why) {
      if (command->get_option(option)->count() > 0)
        throw CLI::ParseError(fmt::format("{}: {}", option, why), CLI::ExitCodes::ExcludesError);
    };
    if (options->bits) unused("--error", "excludes --bits, which fixes what the error would choose");
    if (options->fit.goal == sim::CoreGoal::rate) {
      unused("--rate-rays", "needs --for area; --for rate takes the most");
      unused("--overhead", "needs --for area; --for rate weighs blocks against size");
    }
    exit_code = Fitting(*options, *command).run();
  });
  return command;
}

}  // namespace hitpipe::cli
