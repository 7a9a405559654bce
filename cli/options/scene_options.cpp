#include "cli/options/scene_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "cli/text/scene_text.hpp"
#include "host/talk.hpp"
#include "host/text.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::cli {

namespace {

/// Numbers with commas between them; nothing if there are not so many.
template <std::size_t Count>
std::optional<std::array<double, Count>> numbers_in(const std::string& text) {
  std::array<double, Count> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < Count; ++i) {
    const auto [stop, error] = std::from_chars(at, end, numbers[i]);
    const bool last = i + 1 == Count;
    if (error != std::errc{} || !(last ? stop == end : stop != end && *stop == ',')) return std::nullopt;
    at = stop + 1;
  }
  return numbers;
}

/// For example "1,0.5,-2".
glm::dvec3 parse_vector(const std::string& option, const std::string& text) {
  const auto xyz = numbers_in<3>(text);
  if (!xyz)
    throw CLI::ValidationError(
        option,
        fmt::format("{} is not X,Y,Z; give three numbers, for example 1,0.5,-2", host::shortened(text)));
  return {(*xyz)[0], (*xyz)[1], (*xyz)[2]};
}

/// For example "1,0.5,-2,10".
ref::CubeChoice parse_cube(const std::string& text) {
  const auto xyzh = numbers_in<4>(text);
  constexpr double smallest = 1e-300;  // its inverse is finite
  constexpr double largest = 1e300;
  const auto fits = [](double x) { return std::abs(x) <= largest; };
  if (!xyzh || !std::all_of(xyzh->begin(), xyzh->end(), fits) || !((*xyzh)[3] >= smallest))
    throw CLI::ValidationError(
        "--cube",
        fmt::format("{} is not X,Y,Z,HALF; give the middle and half a side, more than 0, for example "
                    "1,0.5,-2,10",
                    host::shortened(text)));
  return {{(*xyzh)[0], (*xyzh)[1], (*xyzh)[2]}, (*xyzh)[3]};
}

/// One line on standard error, or, if that is strict, an error.
void say_lost(const std::string& text, bool strict) {
  if (text.empty()) return;
  if (strict) throw std::runtime_error(text);
  host::note(text);
}

}  // namespace

ref::Scene SceneChoice::load() const {
  return placed(ref::describe_scene(name, placing));
}

ref::Scene SceneChoice::placed(ref::SceneDescription description) const {
  ref::Scene scene = ref::place(std::move(description));
  if (scene.to_cube.chosen) check_rays(scene.camera, "--cube");
  say_lost(lost_text(scene), strict);
  if (!faces.empty()) write_faces(faces, scene.mesh);
  return scene;
}

void SceneChoice::check_rays(const ref::Camera& camera, const std::string& option) const {
  if (const auto outside = ref::first_ray_outside(camera, width, height))
    throw std::runtime_error(
        fmt::format("{}: ray {} of the picture begins outside; the orthographic image must begin in the cube",
                    option, *outside));
}

ref::IntScene SceneChoice::in_integers(const ref::Scene& scene, const hls::WorldBits& bits,
                                       const ref::HierarchyOptions& hierarchy) const {
  ref::IntScene made = ref::int_scene(scene, bits, hierarchy);
  say_lost(lost_text(scene, made), strict);
  return made;
}

void add_cube_options(CLI::App& command, SceneChoice& choice) {
  command
      .add_option_function<std::string>(
          "--cube", [&choice](const std::string& text) { choice.placing.cube = parse_cube(text); },
          "The cube in which coordinates are rounded: its middle and half its side, in the scene's own "
          "units. It must hold the mesh and every origin of a ray. Default: the smallest that holds mesh, "
          "eye and lights")
      ->type_name("X,Y,Z,HALF");
  command.add_flag("--strict", choice.strict, "Triangles that lose their area by rounding are an error");
  as_output(command.add_option("--faces", choice.faces,
                               "Write the number of each triangle, and the face of the mesh file that it is "
                               "part of, as CSV"));
}

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
  add_cube_options(command, choice);
  add_count_option(command, "--width", choice.width, {1, 16384}, "Pixels across")->capture_default_str();
  add_count_option(command, "--height", choice.height, {1, 16384}, "Pixels down")->capture_default_str();
  add_count_option(command, "--threads", choice.threads, {1, 1024},
                   "Number of threads; results do not depend on it")
      ->capture_default_str();
}

std::vector<std::string> scene_option_names() {
  CLI::App command;
  command.set_help_flag();
  SceneChoice choice;
  add_scene_options(command, choice);
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options()) names.push_back(option->get_name());
  return names;
}

}  // namespace hitpipe::cli
