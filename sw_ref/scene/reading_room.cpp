#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/shapes.hpp"

namespace hitpipe::ref {
namespace reading_room_parts {
namespace {

enum RoomColour : std::uint8_t {
  plaster,
  oak,
  walnut,
  light_tile,
  dark_tile,
  stone,
  brass,
  shade,
  paper,
  first_binding,
  bindings = 7,
  colours = first_binding + bindings
};

// In metres; y is up. Lengths are multiples of 1/64 m, which binary32 holds exactly, so faces that should lie
// in one plane do.
constexpr double half_width = 8.0;    // along x
constexpr double half_length = 14.0;  // along z
constexpr double ceiling = 9.0;
constexpr double wall = 0.5;
constexpr double gallery = 4.25;  // height of the upper floor, which runs along both long walls
constexpr double gallery_depth = 2.0;
constexpr double case_depth = 0.4375;

double on_grid(double metres) {
  return std::floor(metres * 64.0 + 0.5) / 64.0;
}

class Room {
 public:
  Room(Shapes& shapes, double detail) : shapes_(shapes), detail_(detail) {}

  void build() {
    add_shell();
    add_roof();
    for (const double side : {-1.0, 1.0}) {
      add_gallery(side);
      add_bookcases(side, 0.0, gallery - 0.25);
      add_bookcases(side, gallery, ceiling - 0.75);
    }
    for (int row = 0; row < 7; ++row) {
      for (const double side : {-1.0, 1.0}) add_desk(side * 2.75, -10.5 + 3.5 * row);
    }
  }

 private:
  void box(RoomColour colour, const glm::dvec3& low, const glm::dvec3& high) {
    shapes_.material(colour);
    shapes_.box(low, high);
  }
  /// A box that reaches from x0 to x1 on the side of the room where x has the sign of `side`.
  void side_box(RoomColour colour, double side, glm::dvec3 low, glm::dvec3 high) {
    if (side < 0) {
      const double near = low.x;
      low.x = -high.x;
      high.x = -near;
    }
    box(colour, low, high);
  }

  void add_shell() {
    box(stone, {-half_width - wall, -wall, -half_length - wall},
        {half_width + wall, -0.03125, half_length + wall});
    for (int i = 0; i < 2 * static_cast<int>(half_width); ++i) {
      for (int k = 0; k < 2 * static_cast<int>(half_length); ++k) {
        const double x = -half_width + i;
        const double z = -half_length + k;
        box((i + k) % 2 == 0 ? light_tile : dark_tile, {x, -0.03125, z}, {x + 1.0, 0.0, z + 1.0});
      }
    }
    for (const double side : {-1.0, 1.0}) {
      side_box(plaster, side, {half_width, -0.03125, -half_length - wall},
               {half_width + wall, ceiling + wall, half_length + wall});
      const double z = side < 0 ? -half_length - wall : half_length;
      box(plaster, {-half_width, -0.03125, z}, {half_width, ceiling + wall, z + wall});
    }
    // A door, and a clock above it.
    box(walnut, {-1.5, 0.0, -half_length}, {-0.03125, 3.25, -half_length + 0.125});
    box(walnut, {0.03125, 0.0, -half_length}, {1.5, 3.25, -half_length + 0.125});
    box(stone, {-2.0, 3.25, -half_length}, {2.0, 3.75, -half_length + 0.25});
    shapes_.material(brass);
    shapes_.rod({0.0, 5.5, -half_length}, {0.0, 5.5, -half_length + 0.125}, 0.75,
                scaled(24.0, std::sqrt(detail_), 8), Ends::closed);
  }

  /// Slabs around two rows of four skylights, whose glass is left out, and the bars that would hold it.
  void add_roof() {
    constexpr std::array<double, 4> across{-6.5, -1.5, 1.5, 6.5};
    constexpr double opening = 4.5;
    constexpr double beam = 2.0;
    for (const auto& [low, high] :
         {std::pair(-half_width, across[0]), {across[1], across[2]}, {across[3], half_width}})
      box(plaster, {low, ceiling, -half_length}, {high, ceiling + wall, half_length});
    for (std::size_t row = 0; row < 2; ++row) {
      const double low = across[2 * row];
      const double high = across[2 * row + 1];
      for (int k = 0; k <= 4; ++k) {
        const double z = -half_length + 2.0 + (opening + beam) * k;
        const double before = k == 0 ? -half_length : z - beam;
        const double after = k == 4 ? half_length : z;
        if (before < after) box(plaster, {low, ceiling, before}, {high, ceiling + wall, after});
        if (k == 4) break;
        const int bars = scaled(6.0, std::sqrt(detail_), 2);
        for (int bar = 1; bar < bars; ++bar) {
          const double x = on_grid(low + (high - low) * bar / bars);
          box(brass, {x, ceiling + 0.25, z}, {x + 0.0625, ceiling + 0.3125, z + opening});
          const double at = on_grid(z + opening * bar / bars);
          box(brass, {low, ceiling + 0.3125, at}, {high, ceiling + 0.375, at + 0.0625});
        }
      }
    }
  }

  void add_gallery(double side) {
    const double edge = half_width - gallery_depth;
    side_box(oak, side, {edge, gallery - 0.25, -half_length}, {half_width, gallery, half_length});
    for (int k = 0; k <= 8; ++k) {
      const double z = on_grid(-half_length + 0.5 + 27.0 * k / 8.0);
      side_box(stone, side, {edge, 0.0, z - 0.25}, {edge + 0.5, 0.25, z + 0.25});
      side_box(plaster, side, {edge + 0.0625, 0.25, z - 0.1875}, {edge + 0.4375, gallery - 0.5, z + 0.1875});
      side_box(stone, side, {edge, gallery - 0.5, z - 0.25}, {edge + 0.5, gallery - 0.25, z + 0.25});
    }
    side_box(brass, side, {edge, gallery + 1.0, -half_length},
             {edge + 0.0625, gallery + 1.0625, half_length});
    const int posts = scaled(140.0, std::sqrt(detail_), 20);
    for (int i = 0; i < posts; ++i) {
      const double z = on_grid(-half_length + 2.0 * half_length * (i + 0.5) / posts);
      side_box(brass, side, {edge + 0.015625, gallery, z}, {edge + 0.046875, gallery + 1.0, z + 0.03125});
    }
  }

  /// Bookcases along one long wall, from one height to another.
  void add_bookcases(double side, double low, double high) {
    constexpr double unit = 1.75;
    constexpr double shelf = 0.03125;
    constexpr double rise = 0.40625;
    const double front = half_width - case_depth;
    const int levels = static_cast<int>((high - low) / rise);
    for (int k = 0; k < static_cast<int>(2.0 * half_length / unit); ++k) {
      const double z = -half_length + unit * k;
      side_box(walnut, side, {front, low, z}, {half_width, low + levels * rise + shelf, z + 0.0625});
      for (int level = 0; level <= levels; ++level)
        side_box(walnut, side, {front, low + level * rise, z + 0.0625},
                 {half_width, low + level * rise + shelf, z + unit});
      for (int level = 0; level < levels; ++level)
        add_books(side, low + level * rise + shelf, rise - 2 * shelf, z + 0.0625, z + unit);
    }
  }

  void add_books(double side, double base, double most, double from, double to) {
    Dice dice(++shelves_ + 0xB00C);
    const double thickness = 0.046875 / detail_;
    for (double z = from; z + 0.25 * thickness < to;) {
      const double end = std::min(to, on_grid(z + dice.between(0.6, 1.6) * thickness + 0.0078125));
      const double height = on_grid(dice.between(0.62, 1.0) * most);
      const double depth = on_grid(dice.between(0.55, 0.9) * case_depth);
      const auto colour = static_cast<RoomColour>(first_binding + dice.below(bindings));
      const bool missing = dice.chance(0.04);
      if (end <= z) break;
      if (!missing) side_box(colour, side, {half_width - depth, base, z}, {half_width, base + height, end});
      z = end;
    }
  }

  void add_desk(double x, double z) {
    box(oak, {x - 1.5, 0.6875, z - 0.625}, {x + 1.5, 0.75, z + 0.625});
    for (const double dx : {-1.4375, 1.3125}) {
      for (const double dz : {-0.5625, 0.4375})
        box(walnut, {x + dx, 0.0, z + dz}, {x + dx + 0.125, 0.6875, z + dz + 0.125});
    }
    for (const double place : {-0.75, 0.75}) {
      add_chair(x + place, z + 1.0);
      box(paper, {x + place - 0.25, 0.75, z + 0.125}, {x + place - 0.015625, 0.78125, z + 0.4375});
      box(paper, {x + place + 0.015625, 0.75, z + 0.125}, {x + place + 0.25, 0.78125, z + 0.4375});
    }
    const int sides = scaled(16.0, std::sqrt(detail_), 6);
    shapes_.material(brass);
    shapes_.rod({x, 0.75, z - 0.25}, {x, 1.25, z - 0.25}, 0.015625, sides);
    shapes_.rod({x, 0.75, z - 0.25}, {x, 0.78125, z - 0.25}, 0.125, sides, Ends::closed);
    shapes_.material(shade);
    constexpr std::array<glm::dvec2, 4> lamp{
        {{0.28125, 0.0}, {0.25, 0.125}, {0.125, 0.1875}, {0.0, 0.203125}}};
    shapes_.turned({x, 1.125, z - 0.25}, {0.0, 1.0, 0.0}, lamp, sides);
  }

  void add_chair(double x, double z) {
    box(walnut, {x - 0.25, 0.4375, z - 0.25}, {x + 0.25, 0.46875, z + 0.25});
    for (const double dx : {-0.25, 0.203125}) {
      for (const double dz : {-0.25, 0.203125}) {
        const double top = dz > 0 ? 1.0 : 0.4375;
        box(walnut, {x + dx, 0.0, z + dz}, {x + dx + 0.046875, top, z + dz + 0.046875});
      }
    }
    for (int slat = 0; slat < 3; ++slat) {
      const double y = 0.59375 + 0.15625 * slat;
      box(walnut, {x - 0.203125, y, z + 0.21875}, {x + 0.203125, y + 0.0625, z + 0.234375});
    }
  }

  Shapes& shapes_;
  double detail_;
  std::uint64_t shelves_ = 0;
};

void build_room(Shapes& shapes, double detail) {
  Room(shapes, detail).build();
}

std::vector<Material> surfaces() {
  std::vector<Material> all(colours);
  all[plaster].albedo = {0.80F, 0.76F, 0.68F};
  all[oak].albedo = {0.52F, 0.36F, 0.21F};
  all[walnut].albedo = {0.30F, 0.19F, 0.12F};
  all[light_tile].albedo = {0.72F, 0.69F, 0.64F};
  all[dark_tile].albedo = {0.30F, 0.31F, 0.33F};
  all[stone].albedo = {0.62F, 0.58F, 0.52F};
  all[brass] = {.albedo = {0.30F, 0.22F, 0.10F}, .reflect = {0.50F, 0.40F, 0.22F}};
  all[shade].albedo = {0.10F, 0.38F, 0.25F};
  all[paper].albedo = {0.88F, 0.86F, 0.80F};
  constexpr std::array<glm::vec3, bindings> leather{{{0.46F, 0.12F, 0.10F},
                                                     {0.14F, 0.26F, 0.18F},
                                                     {0.14F, 0.19F, 0.36F},
                                                     {0.60F, 0.44F, 0.20F},
                                                     {0.16F, 0.14F, 0.13F},
                                                     {0.76F, 0.68F, 0.54F},
                                                     {0.40F, 0.25F, 0.16F}}};
  for (std::size_t i = 0; i < bindings; ++i) all[first_binding + i].albedo = leather.at(i);
  return all;
}

}  // namespace
}  // namespace reading_room_parts

BuiltInDescription reading_room(std::size_t triangles) {
  BuiltInDescription scene;
  Shapes shapes(scene.mesh, Shapes::Normals::flat);
  reading_room_parts::build_room(shapes, detail_for(triangles, reading_room_parts::build_room));
  scene.materials = reading_room_parts::surfaces();
  scene.eye = {-4.5, 5.5, 13.0};
  scene.target = {1.0, 2.5, -4.0};
  scene.fov_degrees = 62.0;
  scene.lights = {{{0.0, 1.0, 0.0}, {1.0, 0.95, 0.86}, LightKind::sun}};
  return scene;
}

}  // namespace hitpipe::ref
