#include "sw_ref/scene/built_in.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "sw_ref/scene/built_in_scenes.hpp"

namespace hitpipe::ref {
namespace {

BuiltInDescription only_spheres(std::size_t /*triangles*/) {
  return spheres();
}

// Default sizes are the thesis's. Scenes that would take a minute default to a million triangles.
constexpr std::array<BuiltInScene, 15> scenes{{
    {"spheres", "Spheres", 24'578, 24'578, 24'578, 2, "balls, some mirrors, some of glass", only_spheres},
    {"branch", "Branch", 312'706, 80'000, 10'000'000, 2, "a spruce branch with cones", branch},
    {"poppy", "Poppy", 395'460, 25'000, 10'000'000, 2, "a clump of poppies", poppy},
    {"plant", "Powerplant-Front", 1'000'000, 300'000, 20'000'000, 1, "an industrial plant, as plant_front",
     plant_front},
    {"plant_front", "Powerplant-Front", 1'000'000, 300'000, 20'000'000, 1, "from before it", plant_front},
    {"plant_north", "Powerplant-North", 1'000'000, 300'000, 20'000'000, 3, "through its floors from below",
     plant_north},
    {"plant_boiler", "Powerplant-Boiler", 1'000'000, 300'000, 20'000'000, 1, "inside its boiler",
     plant_boiler},
    {"statue", "Lucy", 1'000'000, 10'000, 50'000'000, 2, "a winged figure with a torch", statue},
    {"two_statues", "2Lucy", 1'500'000, 20'000, 50'000'000, 2, "two of them", two_statues},
    {"plant_slice", "", 27'962, 27'962, 27'962, 1, "a slice of the plant, 2.8 m thick", plant_slice},
    {"waves", "", 30'000, 1'000, 10'000'000, 1, "a sea seen and lit along one class", waves},
    {"city", "", 250'000, 100'000, 10'000'000, 1, "a city of boxes, its plan from above", city},
    {"city_oblique", "", 250'000, 100'000, 10'000'000, 2, "seen at a slant", city_oblique},
    {"reading_room", "", 250'000, 60'000, 10'000'000, 1, "a library, the sun straight above", reading_room},
    {"terrain", "", 2'000'000, 10'000, 50'000'000, 1, "a scanned landscape, seen along it", terrain},
}};

template <class Wanted>
std::string names(Wanted wanted) {
  std::string all;
  for (const BuiltInScene& scene : scenes) {
    if (wanted(scene)) all += (all.empty() ? "" : ", ") + std::string(scene.name);
  }
  return all;
}

}  // namespace

std::span<const BuiltInScene> built_in_scenes() {
  return scenes;
}

const BuiltInScene* find_built_in(std::string_view name) {
  const auto* const found = std::find_if(scenes.begin(), scenes.end(),
                                         [&](const BuiltInScene& scene) { return scene.name == name; });
  return found == scenes.end() ? nullptr : found;
}

SceneDescription make_built_in(std::string_view name, std::optional<std::size_t> triangles) {
  const BuiltInScene* const scene = find_built_in(name);
  if (!scene) throw std::logic_error(fmt::format("make_built_in: there is no scene {}", name));
  if (triangles && !scene->scales())
    throw std::runtime_error(fmt::format("scene \"{}\": has {} triangles; their number can be chosen for: {}",
                                         name, scene->triangles, scaling_names()));
  const std::size_t wanted = triangles.value_or(scene->triangles);
  if (wanted < scene->least || wanted > scene->most)
    throw std::runtime_error(fmt::format("scene \"{}\": {} triangles; allowed are {} to {}", name, wanted,
                                         scene->least, scene->most));
  BuiltInDescription made = scene->make(wanted);
  made.name = scene->name;
  made.stand_in_for = scene->stands_for;
  return as_source(std::move(made));
}

std::string built_in_names() {
  return names([](const BuiltInScene&) { return true; });
}

std::string scaling_names() {
  return names([](const BuiltInScene& scene) { return scene.scales(); });
}

}  // namespace hitpipe::ref
