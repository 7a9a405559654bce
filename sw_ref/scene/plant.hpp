// The built-in scenes of an industrial plant: one mesh, three views, and a slice of it.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Steel frame, gratings, pipes, tanks, chimneys and a boiler full of tubes, in metres. Most triangles are
/// long, thin and along the axes, between fine detail as bolts and handwheels.
[[nodiscard]] SceneDescription plant_front(std::size_t triangles);
/// From the north, low, through the floors; three lights.
[[nodiscard]] SceneDescription plant_north(std::size_t triangles);
/// Inside the boiler.
[[nodiscard]] SceneDescription plant_boiler(std::size_t triangles);
/// What of the plant of 400,000 triangles lies within 1.4 m of its middle plane, z = 20; eye and light lie
/// within too.
[[nodiscard]] SceneDescription plant_slice(std::size_t triangles);

}  // namespace hitpipe::ref
