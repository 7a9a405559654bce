// The makers of the built-in scenes, of about as many triangles as are wanted.
#pragma once

#include <cstddef>

#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

// A city, made of boxes along the axes, seen by an orthographic camera, and lit by suns along the axes. So
// whole families of rays are parallel to an axis, and many meet box faces edge on.

/// Its plan: seen from straight above with the sun straight above. All rays are exactly (0, -1, 0) or
/// (0, 1, 0).
[[nodiscard]] BuiltInDescription city(std::size_t triangles);

/// Seen from the south-east at a slant. A second, weak sun stands exactly in the east, so every shadow ray is
/// exactly (0, 1, 0) or (1, 0, 0).
[[nodiscard]] BuiltInDescription city_oblique(std::size_t triangles);

// An industrial plant: one mesh, three views, and a slice of it.

/// Steel frame, gratings, pipes, tanks, chimneys and a boiler full of tubes, in metres. Most triangles are
/// long, thin and parallel to an axis; others are fine detail such as bolts and handwheels.
[[nodiscard]] BuiltInDescription plant_front(std::size_t triangles);
/// A low view from the north through the floors; three lights.
[[nodiscard]] BuiltInDescription plant_north(std::size_t triangles);
/// A view inside the boiler.
[[nodiscard]] BuiltInDescription plant_boiler(std::size_t triangles);
/// The part of the plant of 400,000 triangles that lies within 1.4 m of its middle plane, z = 20. Eye and
/// light lie within it too.
[[nodiscard]] BuiltInDescription plant_slice(std::size_t triangles);

/// 12 spheres of 2,048 triangles on a floor of 2. Some mirror, and some are glass. There are two lights.
[[nodiscard]] BuiltInDescription spheres();

/// A spruce branch with two cones. It has thousands of bent needles, which are tiny compared with the gaps
/// between them.
[[nodiscard]] BuiltInDescription branch(std::size_t triangles);

/// A clump of poppies: thin curved petals, stamens, seed pods, buds, and hair on every stem.
[[nodiscard]] BuiltInDescription poppy(std::size_t triangles);

/// A winged figure that holds up a torch, on a floor that mirrors a little. Its closed surfaces are displaced
/// by folds, feathers and noise. The triangles are tiny and of one size.
[[nodiscard]] BuiltInDescription statue(std::size_t triangles);

/// Two of these figures; the second has 15/43 of the triangles, as in figure 5.4.
[[nodiscard]] BuiltInDescription two_statues(std::size_t triangles);

// A sea on a slope. All its rays are of one direction class.

/// Matt waves on a plane that leans towards eye and light. Both are placed so that all rays go towards +x,
/// +y, -z.
[[nodiscard]] BuiltInDescription waves(std::size_t triangles);

// A library's reading room. Nearly all of it is boxes along the axes, and the sun stands straight above its
// skylights, so every shadow ray is exactly (0, 1, 0) and runs inside or along faces.

/// Shelves of books on two floors, desks with lamps, and a roof with eight skylights, seen from inside.
[[nodiscard]] BuiltInDescription reading_room(std::size_t triangles);

// A landscape as a scanner sees it. Eye and sun stand so low that all rays are nearly flat to the surface.

/// Hills, ridges and a plain, of measured points: a little out of their grid, with noise in their heights.
[[nodiscard]] BuiltInDescription terrain(std::size_t triangles);

}  // namespace hitpipe::ref
