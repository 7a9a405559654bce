#include <algorithm>
#include <array>

#include "sw_ref/scene/city_parts.hpp"

namespace hitpipe::ref::city_parts {
namespace {

constexpr double storey = 3.5;

/// How the walls of a building look.
enum class Style : std::uint8_t { bands, ledges, piers };

class Building {
 public:
  Building(Shapes& shapes, std::uint64_t number, double detail)
      : shapes_(shapes), detail_(detail), dice_(number + 0xC17), small_(number + 0x5A11) {
    constexpr std::array<Colour, 5> walls{brick, stone, plaster, concrete, brick};
    style_ = static_cast<Style>(dice_.below(3));
    wall_ = style_ == Style::piers ? dark_glass : walls.at(static_cast<std::size_t>(dice_.below(5)));
    trim_ = dice_.chance(0.5) ? stone : plaster;
    is_warm_ = dice_.chance(0.55);
    density_ = dice_.between(0.6, 1.4);
    edged_from_ = dice_.between(0.0, 0.6);
  }

  void add(Plot plot, int storeys) {
    const int tiers = storeys < 9 ? 1 : storeys < 16 ? 2 : 2 + dice_.below(3);
    double base = kerb;
    int left = storeys;
    for (int i = 0; i < tiers; ++i) {
      const int here = i + 1 == tiers ? left : std::max(1, static_cast<int>(left * dice_.between(0.35, 0.6)));
      left -= here;
      add_tier(plot, base, here);
      base += here * storey + roof_thickness;
      if (i == 0 && dice_.chance(0.4)) add_canopy(plot);
      if (i + 1 == tiers || left < 1) break;
      const double most = std::min(plot.width(), plot.depth()) / 6.0;
      const Plot below = plot;
      plot = set_back(plot, most);
      add_terrace(below, plot, base);
    }
    add_roof(plot, base, storeys);
  }

 private:
  static constexpr double roof_thickness = 0.5;

  [[nodiscard]] std::uint8_t roof_colour(double height) const {
    // A step of the ramp is 60 % higher than the one before.
    int tone = 0;
    for (double limit = 9.0; tone + 1 < roof_tones && height > limit; limit *= 1.6) ++tone;
    return static_cast<std::uint8_t>((is_warm_ ? warm_roof : cool_roof) + tone);
  }

  Plot set_back(const Plot& plot, double most) {
    const double west = on_grid(dice_.between(0.3, 1.0) * most);
    const double east = on_grid(dice_.between(0.3, 1.0) * most);
    const double north = on_grid(dice_.between(0.3, 1.0) * most);
    const double south = on_grid(dice_.between(0.3, 1.0) * most);
    return {plot.low_x + west, plot.high_x - east, plot.low_z + north, plot.high_z - south};
  }

  void add_tier(const Plot& plot, double base, int storeys) {
    const double top = base + storeys * storey;
    shapes_.material(wall_);
    add_box(shapes_, plot, base, top);
    shapes_.material(roof_colour(top));
    add_box(shapes_, plot.grown(0.375), top, top + roof_thickness);
    if (style_ == Style::piers)
      add_piers(plot, base, top);
    else
      add_rings(plot, base, top);
  }

  /// Dark rows of windows, or ledges that catch the light, spread over the height.
  void add_rings(const Plot& plot, double base, double top) {
    const bool bands = style_ == Style::bands;
    const int count = scaled(density_ * (top - base) / (2.0 * storey), detail_, 0);
    if (count == 0) return;
    const double step = (top - base) / count;
    const double thick = std::max(0.125, on_grid(std::min(bands ? 0.45 * step : 0.2 * step, 1.75)));
    shapes_.material(bands ? dark_glass : trim_);
    for (int i = 0; i < count; ++i) {
      const double y = on_grid(base + (i + 0.4) * step);
      add_box(shapes_, plot.grown(bands ? 0.125 : 0.375), y, y + thick);
    }
  }

  /// Stone piers on all four walls, which are of glass.
  void add_piers(const Plot& plot, double base, double top) {
    shapes_.material(trim_);
    const auto spread = [&](double low, double high, auto add) {
      const int count = scaled(density_ * (high - low) / 6.0, detail_, 0);
      if (count < 2) return;
      const double width = std::max(0.125, on_grid(std::min(0.3 * (high - low) / count, 1.0)));
      for (int i = 0; i < count; ++i) {
        const double at = on_grid(low + (high - low - width) * i / (count - 1));
        add(at, at + width);
      }
    };
    constexpr double out = 0.25;
    spread(plot.low_x, plot.high_x, [&](double low, double high) {
      add_box(shapes_, {low, high, plot.high_z, plot.high_z + out}, base, top);
      add_box(shapes_, {low, high, plot.low_z - out, plot.low_z}, base, top);
    });
    spread(plot.low_z, plot.high_z, [&](double low, double high) {
      add_box(shapes_, {plot.high_x, plot.high_x + out, low, high}, base, top);
      add_box(shapes_, {plot.low_x - out, plot.low_x, low, high}, base, top);
    });
  }

  /// Planters on the part of a roof that the next tier leaves free.
  void add_terrace(const Plot& below, const Plot& above, double base) {
    shapes_.material(young_leaf);
    const double room = above.low_x - below.low_x;
    if (room > 2.0)
      add_box(shapes_, {below.low_x + 0.5, above.low_x - 0.5, above.low_z, above.high_z}, base, base + 0.75);
    const double front = below.high_z - above.high_z;
    if (front > 2.0)
      add_box(shapes_, {above.low_x, above.high_x, above.high_z + 0.5, below.high_z - 0.5}, base,
              base + 0.75);
  }

  /// A roof over the pavement in front of the door.
  void add_canopy(const Plot& plot) {
    shapes_.material(metal);
    const double middle = on_grid(0.5 * (plot.low_x + plot.high_x));
    add_box(shapes_, {middle - 3.0, middle + 3.0, plot.high_z, plot.high_z + 2.0}, 3.5, 3.75);
  }

  void add_roof(const Plot& plot, double base, int storeys) {
    if (edged_from_ < detail_) add_parapet(plot, base);
    const Plot free = plot.grown(-1.5);
    if (free.width() < 3.0 || free.depth() < 3.0) return;
    if (storeys > 24 && dice_.chance(0.6)) {
      shapes_.material(metal);
      const double x = on_grid(0.5 * (free.low_x + free.high_x));
      const double z = on_grid(0.5 * (free.low_z + free.high_z));
      const double height = on_grid(dice_.between(12.0, 30.0));
      add_box(shapes_, {x - 0.375, x + 0.375, z - 0.375, z + 0.375}, base, base + height);
      add_box(shapes_, {x - 1.5, x + 1.5, z - 1.5, z + 1.5}, base, base + 2.5);
    } else if (wall_ == brick && free.width() > 6.0 && free.depth() > 6.0) {
      add_tank(free, base);
    }
    const int count = scaled(density_ * free.width() * free.depth() / 55.0, detail_, 0);
    for (int i = 0; i < count; ++i) add_plant(free, base);
  }

  void add_parapet(const Plot& plot, double base) {
    shapes_.material(trim_);
    const Plot out = plot.grown(0.375);
    constexpr double wide = 0.375;
    const double top = base + 0.75;
    add_box(shapes_, {out.low_x, out.high_x, out.low_z, out.low_z + wide}, base, top);
    add_box(shapes_, {out.low_x, out.high_x, out.high_z - wide, out.high_z}, base, top);
    add_box(shapes_, {out.low_x, out.low_x + wide, out.low_z + wide, out.high_z - wide}, base, top);
    add_box(shapes_, {out.high_x - wide, out.high_x, out.low_z + wide, out.high_z - wide}, base, top);
  }

  /// A water tank on four legs.
  void add_tank(const Plot& free, double base) {
    const double x = on_grid(dice_.between(free.low_x, free.high_x - 3.5));
    const double z = on_grid(dice_.between(free.low_z, free.high_z - 3.5));
    shapes_.material(metal);
    for (const double dx : {0.25, 2.5})
      for (const double dz : {0.25, 2.5})
        add_box(shapes_, {x + dx, x + dx + 0.25, z + dz, z + dz + 0.25}, base, base + 3.0);
    shapes_.material(trunk);
    add_box(shapes_, {x, x + 3.0, z, z + 3.0}, base + 3.0, base + 6.0);
  }

  /// A box of the building's plant, somewhere on the roof. Its dice are its own, so that their number does
  /// not change the building.
  void add_plant(const Plot& free, double base) {
    // With more boxes each is smaller, so that roofs are not covered.
    const double most = std::clamp(4.0 / std::sqrt(std::max(detail_, 0.25)), 0.5, 4.0);
    const double wide = std::max(0.25, on_grid(small_.between(0.25, 1.0) * std::min(most, free.width())));
    const double deep = std::max(0.25, on_grid(small_.between(0.25, 1.0) * std::min(most, free.depth())));
    const double high = std::max(0.25, on_grid(small_.between(0.25, 0.7) * most));
    const double x = on_grid(small_.between(free.low_x, free.high_x - wide));
    const double z = on_grid(small_.between(free.low_z, free.high_z - deep));
    shapes_.material(small_.chance(0.5) ? concrete : metal);
    add_box(shapes_, {x, x + wide, z, z + deep}, base, base + high);
  }

  Shapes& shapes_;
  double detail_;
  Dice dice_;
  Dice small_;
  Style style_ = Style::bands;
  Colour wall_ = brick;
  Colour trim_ = stone;
  bool is_warm_ = true;
  double density_ = 1.0;  ///< of what scales with the detail; buildings differ, so their numbers do not jump
  double edged_from_ = 0.0;  ///< the detail from which the roof has a parapet
};

}  // namespace

void add_building(Shapes& shapes, const Plot& plot, int storeys, std::uint64_t number, double detail) {
  Building(shapes, number, detail).add(plot, storeys);
}

void add_tree(Shapes& shapes, double x, double z, double ground, Dice& dice) {
  const double height = on_grid(dice.between(2.0, 3.0));
  const double crown = on_grid(dice.between(1.25, 2.5));
  shapes.material(trunk);
  add_box(shapes, {x - 0.25, x + 0.25, z - 0.25, z + 0.25}, ground, ground + height);
  shapes.material(dice.chance(0.6) ? leaf : young_leaf);
  const double middle = ground + height + on_grid(1.5 * crown);
  add_box(shapes, {x - crown, x + crown, z - crown, z + crown}, ground + height, middle);
  const double top = on_grid(0.6 * crown);
  add_box(shapes, {x - top, x + top, z - top, z + top}, middle, middle + top);
}

}  // namespace hitpipe::ref::city_parts
