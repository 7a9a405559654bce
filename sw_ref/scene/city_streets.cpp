#include <algorithm>
#include <array>

#include "sw_ref/scene/city_parts.hpp"

namespace hitpipe::ref::city_parts {
namespace {

constexpr double bed = -6.0;          // of the canal
constexpr double water_level = -2.5;  // below the streets
constexpr int railway_after = 7;      // the row of blocks to the north of the railway

/// The middle of the street to the south of a row of blocks.
constexpr double street_middle(int k) {
  return block(0, k).high_z + 0.5 * street_z;
}

void add_ground(Shapes& shapes) {
  const Plot all{-half_x - margin, half_x + margin, canal.low_z, canal.high_z};
  shapes.material(asphalt);
  add_box(shapes, {all.low_x, canal.low_x, all.low_z, all.high_z}, bed, 0.0);
  add_box(shapes, {canal.high_x, all.high_x, all.low_z, all.high_z}, bed, 0.0);
  shapes.material(water);
  add_box(shapes, canal, bed, water_level);
  shapes.material(stone);
  for (const double x : {canal.low_x - 0.75, canal.high_x})
    add_box(shapes, {x, x + 0.75, canal.low_z, canal.high_z}, 0.0, 1.0);
}

void add_bridges(Shapes& shapes) {
  for (int k = 0; k + 1 < blocks_z; k += 2) {
    const double z = street_middle(k);
    const Plot deck{canal.low_x - 3.0, canal.high_x + 3.0, z - 5.0, z + 5.0};
    shapes.material(concrete);
    add_box(shapes, deck, -0.75, kerb);
    shapes.material(stone);
    add_box(shapes, {deck.low_x, deck.high_x, deck.low_z, deck.low_z + 0.5}, kerb, 1.375);
    add_box(shapes, {deck.low_x, deck.high_x, deck.high_z - 0.5, deck.high_z}, kerb, 1.375);
    const double middle = 0.5 * (canal.low_x + canal.high_x);
    add_box(shapes, {middle - 1.0, middle + 1.0, z - 4.0, z + 4.0}, bed, -0.75);
  }
}

void add_boats(Shapes& shapes, double detail) {
  Dice dice(0xB0A7);
  const int count = scaled(40.0, detail, 10);
  for (int i = 0; i < count; ++i) {
    const double z = on_grid(canal.low_z + 8.0 + (canal.depth() - 24.0) * (i + 0.5 * dice.next()) / count);
    const double x = on_grid(dice.between(canal.low_x + 1.0, canal.high_x - 4.5));
    shapes.material(dice.chance(0.5) ? car_white : trunk);
    add_box(shapes, {x, x + 3.0, z, z + 9.0}, water_level - 0.5, water_level + 0.75);
    shapes.material(plaster);
    add_box(shapes, {x + 0.5, x + 2.5, z + 1.0, z + 4.0}, water_level + 0.75, water_level + 2.25);
  }
}

/// A car, along x or along z, with its middle at (x, z).
void add_car(Shapes& shapes, double x, double z, bool along_x, Dice& dice) {
  constexpr std::array<Colour, 5> paints{car_red, car_blue, car_white, metal, dark_glass};
  const auto at = [&](double length, double width) {
    return along_x ? Plot{x - length, x + length, z - width, z + width}
                   : Plot{x - width, x + width, z - length, z + length};
  };
  shapes.material(paints.at(static_cast<std::size_t>(dice.below(5))));
  add_box(shapes, at(2.125, 0.875), 0.375, 1.0);
  shapes.material(dark_glass);
  add_box(shapes, at(1.125, 0.75), 1.0, 1.5);
}

/// The dashed line, the cars and the crossings of a street from `low` to `high` along one axis.
void add_traffic(Shapes& shapes, double low, double high, double middle, bool along_x, std::uint64_t number,
                 double detail) {
  const auto at = [&](double from, double to, double side_low, double side_high) {
    return along_x ? Plot{from, to, middle + side_low, middle + side_high}
                   : Plot{middle + side_low, middle + side_high, from, to};
  };
  Dice dice(number + 0x7AFF);
  const double share = dice.between(0.6, 1.4);
  shapes.material(marking);
  const int dashes = scaled(share * (high - low) / 10.0, detail, 0);
  const double step = (high - low) / std::max(dashes, 1);
  for (int i = 0; i < dashes; ++i) {
    const double from = on_grid(low + (i + 0.3) * step);
    add_box(shapes, at(from, from + std::max(0.125, on_grid(0.4 * step)), -0.125, 0.125), 0.0, 0.125);
  }
  if (share - 0.6 < detail) {
    for (int i = -3; i <= 3; ++i)
      add_box(shapes, at(low + 1.0, low + 4.0, 1.5 * i - 0.375, 1.5 * i + 0.375), 0.0, 0.125);
  }
  const int cars = scaled(share * (high - low) / 14.0, detail, 0);
  for (int i = 0; i < cars; ++i) {
    const double along = on_grid(low + 6.0 + (high - low - 9.0) * (i + 0.6 * dice.next()) / cars);
    const double lane = middle + (dice.chance(0.5) ? 2.5 : -2.5);
    add_car(shapes, along_x ? along : lane, along_x ? lane : along, along_x, dice);
  }
}

void add_traffic_everywhere(Shapes& shapes, double detail) {
  std::uint64_t number = 0;
  for (int i = 0; i < blocks_x; ++i) {
    for (int k = 0; k < blocks_z; ++k) {
      const Plot here = block(i, k);
      if (k + 1 < blocks_z)
        add_traffic(shapes, here.low_x, here.high_x, street_middle(k), true, ++number, detail);
      if (i + 1 < blocks_x && i != canal_after)
        add_traffic(shapes, here.low_z, here.high_z, here.high_x + 0.5 * street_x, false, ++number, detail);
    }
  }
}

/// A deck on piers above a street, with rails, trains and a station. Its shadow falls on the street.
void add_railway(Shapes& shapes) {
  const double z = street_middle(railway_after);
  constexpr double top = 8.0;
  const double low = -half_x - margin;
  const double high = half_x + margin;
  shapes.material(concrete);
  add_box(shapes, {low, high, z - 4.0, z + 4.0}, top - 1.0, top);
  for (double x = low + 8.0; x < high; x += 16.0)
    for (const double side : {-3.0, 2.0})
      add_box(shapes, {x, x + 1.0, z + side, z + side + 1.0}, x > canal.low_x && x < canal.high_x ? bed : 0.0,
              top - 1.0);
  shapes.material(metal);
  for (const double side : {-3.0, -1.5, 1.25, 2.75})
    add_box(shapes, {low, high, z + side, z + side + 0.25}, top, top + 0.25);
  for (double x = low + 1.0; x < high; x += 4.0) {
    shapes.material(trunk);
    add_box(shapes, {x, x + 0.5, z - 3.5, z + 3.5}, top, top + 0.125);
  }
  for (int i = 0; i < 6; ++i) {
    const double x = 90.0 + 19.0 * i;
    shapes.material(car_red);
    add_box(shapes, {x, x + 18.0, z - 3.5, z - 1.0}, top + 0.75, top + 4.0);
    shapes.material(dark_glass);
    add_box(shapes, {x + 1.0, x + 17.0, z - 3.625, z - 0.875}, top + 2.0, top + 3.0);
  }
  shapes.material(pavement);
  add_box(shapes, {-60.0, 60.0, z + 4.0, z + 6.5}, top - 1.0, top + 1.0);
  shapes.material(metal);
  for (double x = -56.0; x < 60.0; x += 16.0)
    add_box(shapes, {x, x + 0.375, z + 6.0, z + 6.375}, top + 1.0, top + 4.5);
  add_box(shapes, {-60.0, 60.0, z + 1.0, z + 6.75}, top + 4.5, top + 4.75);
}

}  // namespace

void add_streets(Shapes& shapes, double detail) {
  add_ground(shapes);
  add_bridges(shapes);
  add_boats(shapes, detail);
  add_traffic_everywhere(shapes, detail);
  add_railway(shapes);
}

}  // namespace hitpipe::ref::city_parts
