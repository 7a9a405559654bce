// The parts of the plant, in metres, y up. Each function adds its part; `detail` is as in shapes.hpp.
#pragma once

#include <cstdint>

#include "sw_ref/scene/shapes.hpp"

namespace hitpipe::ref::plant {

enum Colour : std::uint8_t {
  yard,
  concrete,
  steel,
  grating,
  yellow,
  pipe_grey,
  pipe_green,
  pipe_blue,
  pipe_red,
  lagging,
  tank_white,
  dark,
  tube
};

// The frame: bays of 7.5 m, from x = 0 and z = 0, five floors 6 m apart.
constexpr double bay = 7.5;
constexpr double storey = 6.0;
constexpr int bays_x = 8;
constexpr int bays_z = 5;
constexpr int storeys = 5;

/// The boiler fills these bays, from the ground to above the roof.
constexpr int boiler_x = 3, boiler_bays_x = 2;
constexpr int boiler_z = 1, boiler_bays_z = 2;
[[nodiscard]] constexpr bool is_boiler(int x, int z) {
  return x >= boiler_x && x < boiler_x + boiler_bays_x && z >= boiler_z && z < boiler_z + boiler_bays_z;
}

/// Whether a box with these corners, seen from above, reaches into the boiler.
[[nodiscard]] constexpr bool enters_boiler(double low_x, double high_x, double low_z, double high_z) {
  constexpr double wall = 0.3;  // the tubes are this far inside the edges of the bays
  return high_x > boiler_x * bay + wall && low_x < (boiler_x + boiler_bays_x) * bay - wall &&
         high_z > boiler_z * bay + wall && low_z < (boiler_z + boiler_bays_z) * bay - wall;
}

/// Columns, girders, bracing, gratings, handrails, stairs, ladders.
void add_steelwork(Shapes& shapes, double detail);
/// Pipes that run along the axes with elbows, flanges and valves; racks of straight pipes.
void add_pipework(Shapes& shapes, double detail);
/// Tanks, vessels, pumps on the floors, and chimneys and storage tanks next to the frame.
void add_vessels(Shapes& shapes, double detail);
/// Walls of tubes, burners, hanging platens of bent tubes, economiser.
void add_boiler(Shapes& shapes, double detail);

/// A tube along a path of axis-parallel legs, with bends of radius `bend` at the corners.
void add_bent_tube(Shapes& shapes, std::span<const glm::dvec3> corners, double radius, double bend, int sides,
                   int bend_steps);

}  // namespace hitpipe::ref::plant
