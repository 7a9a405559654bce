#include "cli/options/scene_options.hpp"

#include <algorithm>
#include <charconv>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "host/text.hpp"
#include "sw_ref/scene/built_in.hpp"

namespace hitpipe::cli {

namespace {

/// For example "1,0.5,-2".
glm::dvec3 parse_vector(const std::string& option, const std::string& text) {
  glm::dvec3 xyz(0.0);
  const char* at = text.data();
  const char* const end = at + text.size();
  bool good = true;
  for (int axis = 0; axis < 3 && good; ++axis) {
    const auto [stop, error] = std::from_chars(at, end, xyz[axis]);
    const bool last = axis == 2;
    good = error == std::errc{} && (last ? stop == end : stop != end && *stop == ',');
    at = stop + 1;
  }
  if (!good) {
    throw CLI::ValidationError(
        option,
        fmt::format("{} is not X,Y,Z; give three numbers, for example 1,0.5,-2", host::shortened(text)));
  }
  return xyz;
}

}  // namespace

void add_scene_options(CLI::App& command, SceneChoice& choice) {
  choice.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const auto point = [&](const std::string& name, std::optional<glm::dvec3>& value, const char* what) {
    command
        .add_option_function<std::string>(
            name, [name, &value](const std::string& text) { value = parse_vector(name, text); }, what)
        ->type_name("X,Y,Z");
  };
  as_input(command.add_option("--scene", choice.name,
                              fmt::format("A built-in scene ({}), a scene file (.json) or a mesh file "
                                          "(.obj, .ply, .stl, .gltf, .glb)",
                                          ref::built_in_names())))
      ->required()
      ->type_name("NAME|FILE");
  add_count_option(command, "--triangles", choice.placing.triangles, {1, 100'000'000},
                   "Approximate number, for a built-in scene that scales; see hitpipe list scenes");
  point("--eye", choice.placing.eye, "Where the camera is, in the scene's own units");
  point("--target", choice.placing.target, "The point in the middle of the image");
  point("--up", choice.placing.up, "The direction that is up");
  command.add_option("--fov", choice.placing.fov_degrees, "Vertical field of view, between 0 and 180")
      ->type_name("DEGREES");
  const auto project = [&](const char* name, ref::Projection projection, const char* what) {
    return command.add_flag_callback(
        name, [&choice, projection] { choice.placing.projection = projection; }, what);
  };
  CLI::Option* const parallel =
      project("--orthographic", ref::Projection::orthographic,
              "Parallel rays; the image is as high as the field of view is at the target");
  exclude(project("--perspective", ref::Projection::perspective,
                  "Rays from the eye, also if the scene is orthographic"),
          parallel, "an image has one projection");
  const auto lights = [&](const std::string& name, ref::LightKind kind, const char* what) {
    command
        .add_option_function<std::vector<std::string>>(
            name,
            [name, kind, &choice](const std::vector<std::string>& all) {
              for (const std::string& light : all)
                choice.placing.lights.push_back({.position = parse_vector(name, light), .kind = kind});
            },
            what)
        ->allow_extra_args(false)
        ->type_name("X,Y,Z");
  };
  lights("--light", ref::LightKind::point,
         "A point light in place of the scene's own lights; repeat the option for more");
  lights("--sun", ref::LightKind::sun,
         "A light in this direction, so far away that its rays are parallel; otherwise as --light");
  add_count_option(command, "--width", choice.width, {1, 16384}, "Pixels across")->capture_default_str();
  add_count_option(command, "--height", choice.height, {1, 16384}, "Pixels down")->capture_default_str();
  add_count_option(command, "--threads", choice.threads, {1, 1024},
                   "Number of threads; results do not depend on it")
      ->capture_default_str();
}

}  // namespace hitpipe::cli
