#include "cli/options/experiment_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "host/outputs.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

/// For example "Bunny=bunny.ply".
void add_scene(const std::string& text, thesis::ExperimentOptions& options) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw CLI::ValidationError(
        "--scene",
        fmt::format("{} is not NAME=SCENE; give for example Bunny=bunny.ply", host::shortened(text)));
  options.scenes[text.substr(0, equals)] = text.substr(equals + 1);
  host::never_replace(text.substr(equals + 1));
}

}  // namespace

void add_experiment_options(CLI::App& command, thesis::ExperimentOptions& options) {
  command
      .add_option_function<std::vector<std::string>>(
          "--scene",
          [&options](const std::vector<std::string>& given) {
            for (const std::string& text : given) add_scene(text, options);
          },
          "A mesh, scene file or built-in scene to use for a scene of the thesis; repeat the option for more")
      ->allow_extra_args(false)
      ->type_name("NAME=SCENE");
  add_list_option(command, "--only", options.only, "Only these scenes of the thesis", "NAME");
  add_count_option(command, "--width", options.width, {1, 16384}, "Pixels across")->capture_default_str();
  add_count_option(command, "--height", options.height, {1, 16384}, "Pixels down")->capture_default_str();
  command
      .add_option("--triangles", options.triangles,
                  "Triangles of each stand-in that scales (default: its own size)")
      ->type_name("N");
  add_count_option(command, "--repeats", options.repeats, {1, 1000},
                   "Timed runs of each kind; the median counts")
      ->capture_default_str();
  add_count_option(command, "--threads", options.threads, {1, 1024},
                   "Number of threads for counting; timing uses one thread")
      ->capture_default_str();
}

}  // namespace hitpipe::cli
