// The parts of the city, in metres, y up, x to the east. All coordinates are multiples of 1/8 m. Binary32
// holds them exactly, so faces that should lie in one plane do.
#pragma once

#include <cmath>
#include <cstdint>

#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/shapes.hpp"

namespace hitpipe::ref::city_parts {

/// Roofs have two ramps of tones, from low to high, so that the plan shows heights.
constexpr int roof_tones = 7;
enum Colour : std::uint8_t {
  water,
  asphalt,
  pavement,
  grass,
  path,
  trunk,
  leaf,
  young_leaf,
  marking,
  concrete,
  brick,
  stone,
  plaster,
  dark_glass,
  metal,
  car_red,
  car_blue,
  car_white,
  warm_roof,
  cool_roof = warm_roof + roof_tones,
  colours = cool_roof + roof_tones
};

/// A rectangle on the ground.
struct Plot {
  double low_x, high_x;
  double low_z, high_z;

  [[nodiscard]] double width() const { return high_x - low_x; }
  [[nodiscard]] double depth() const { return high_z - low_z; }
  [[nodiscard]] Plot grown(double by) const { return {low_x - by, high_x + by, low_z - by, high_z + by}; }
};

/// The nearest multiple of 1/8 m.
[[nodiscard]] inline double on_grid(double metres) {
  return std::floor(metres * 8.0 + 0.5) / 8.0;
}

inline void add_box(Shapes& shapes, const Plot& plot, double low_y, double high_y) {
  shapes.box({plot.low_x, low_y, plot.low_z}, {plot.high_x, high_y, plot.high_z});
}

// The plan: blocks between streets, and a canal in place of one street.
constexpr int blocks_x = 10;
constexpr int blocks_z = 13;
constexpr double block_width = 76.0;
constexpr double block_depth = 58.0;
constexpr double street_x = 16.0;  // between blocks along x
constexpr double street_z = 14.0;
constexpr double canal_width = 44.0;  // with its quays
constexpr int canal_after = 2;        // the block to the west of the canal
constexpr double half_x = 0.5 * (blocks_x * (block_width + street_x) - street_x + canal_width - street_x);
constexpr double half_z = 0.5 * (blocks_z * (block_depth + street_z) - street_z);
constexpr double margin = 12.0;  // of land around the outer blocks
constexpr double kerb = 0.25;    // height of the pavements above the streets

[[nodiscard]] constexpr Plot block(int i, int k) {
  const double x = -half_x + i * (block_width + street_x) + (i > canal_after ? canal_width - street_x : 0.0);
  const double z = -half_z + k * (block_depth + street_z);
  return {x, x + block_width, z, z + block_depth};
}
constexpr Plot canal{block(canal_after, 0).high_x + 8.0, block(canal_after + 1, 0).low_x - 8.0,
                     -half_z - margin, half_z + margin};

/// A house or tower on `plot`, from the pavement up; `storeys` >= 1. `number` decides its style.
void add_building(Shapes& shapes, const Plot& plot, int storeys, std::uint64_t number, double detail);
/// A trunk under a crown that is wider.
void add_tree(Shapes& shapes, double x, double z, double ground, Dice& dice);
/// Ground, canal, bridges, markings, cars and the elevated railway.
void add_streets(Shapes& shapes, double detail);

}  // namespace hitpipe::ref::city_parts
