// The built-in scenes of an industrial plant: one mesh, three views, and a slice of it.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Steel frame, gratings, pipes, tanks, chimneys and a boiler full of tubes, in metres. Most triangles are
/// long, thin and parallel to an axis; others are fine detail such as bolts and handwheels.
[[nodiscard]] SceneDescription plant_front(std::size_t triangles);
/// A low view from the north through the floors; three lights.
[[nodiscard]] SceneDescription plant_north(std::size_t triangles);
/// A view inside the boiler.
[[nodiscard]] SceneDescription plant_boiler(std::size_t triangles);
/// The part of the plant of 400,000 triangles that lies within 1.4 m of its middle plane, z = 20. Eye and
/// light lie within it too.
[[nodiscard]] SceneDescription plant_slice(std::size_t triangles);

}  // namespace hitpipe::ref
