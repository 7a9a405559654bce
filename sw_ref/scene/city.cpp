#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/city_parts.hpp"

namespace hitpipe::ref {
namespace city_parts {
namespace {

/// Blocks without houses.
bool is_park(int i, int k) {
  return (i == 5 && (k == 4 || k == 5)) || (i == 1 && k == 9) || (i == 8 && k == 2) || (i == 7 && k == 10);
}

class Town {
 public:
  Town(Shapes& shapes, double detail) : shapes_(shapes), detail_(detail) {}

  void build() {
    add_streets(shapes_, detail_);
    for (int i = 0; i < blocks_x; ++i) {
      for (int k = 0; k < blocks_z; ++k) {
        const Plot plot = block(i, k);
        Dice dice(static_cast<std::uint64_t>(i * blocks_z + k) + 0xB10C);
        shapes_.material(is_park(i, k) ? grass : pavement);
        add_box(shapes_, plot, 0.0, kerb);
        if (is_park(i, k))
          add_park(plot, dice);
        else
          divide(plot.grown(-3.0), dice);
        if (!is_park(i, k)) add_street_trees(plot, dice);
      }
    }
  }

 private:
  /// Cuts a block into lots, always across the longer side.
  void divide(const Plot& plot, Dice& dice) {
    const double longer = std::max(plot.width(), plot.depth());
    const double limit = dice.between(18.0, 44.0);
    if (longer < limit || longer < 16.0) {
      add_lot(plot, dice);
      return;
    }
    const double part = dice.between(0.36, 0.64);
    Plot first = plot;
    Plot second = plot;
    if (plot.width() > plot.depth())
      first.high_x = second.low_x = on_grid(plot.low_x + part * plot.width());
    else
      first.high_z = second.low_z = on_grid(plot.low_z + part * plot.depth());
    divide(first, dice);
    divide(second, dice);
  }

  void add_lot(const Plot& lot, Dice& dice) {
    // Half of the neighbours touch, wall on wall.
    const Plot plot = lot.grown(dice.chance(0.5) ? 0.0 : -on_grid(dice.between(0.5, 2.0)));
    const double x = 0.5 * (plot.low_x + plot.high_x);
    const double z = 0.5 * (plot.low_z + plot.high_z);
    // Two centres of high houses; the second is smaller.
    const auto near = [&](double centre_x, double centre_z, double reach) {
      const double away =
          ((x - centre_x) * (x - centre_x) + (z - centre_z) * (z - centre_z)) / (reach * reach);
      return 1.0 / ((1.0 + away) * (1.0 + away));
    };
    const double luck = dice.next();
    const double size = std::min(1.0, std::min(plot.width(), plot.depth()) / 22.0);
    const double high = (46.0 * near(120.0, -40.0, 170.0) + 20.0 * near(-330.0, 260.0, 90.0)) * luck * size;
    const int storeys = 2 + static_cast<int>(high + dice.between(0.0, 4.0));
    add_building(shapes_, plot, storeys, ++buildings_, detail_);
  }

  void add_park(const Plot& plot, Dice& dice) {
    const double x = on_grid(0.5 * (plot.low_x + plot.high_x));
    const double z = on_grid(0.5 * (plot.low_z + plot.high_z));
    shapes_.material(path);
    add_box(shapes_, {plot.low_x, plot.high_x, z - 1.5, z + 1.5}, kerb, kerb + 0.125);
    add_box(shapes_, {x - 1.5, x + 1.5, plot.low_z, plot.high_z}, kerb, kerb + 0.25);
    shapes_.material(stone);
    add_box(shapes_, {x - 9.0, x + 9.0, z - 7.0, z + 7.0}, kerb, kerb + 0.5);
    shapes_.material(water);
    add_box(shapes_, {x - 8.0, x + 8.0, z - 6.0, z + 6.0}, kerb, kerb + 0.625);
    const int trees = scaled(dice.between(60.0, 90.0), detail_, 8);
    Dice own(static_cast<std::uint64_t>(dice.below(1 << 20)));
    for (int i = 0; i < trees; ++i) {
      const double at_x = on_grid(own.between(plot.low_x + 3.0, plot.high_x - 3.0));
      const double at_z = on_grid(own.between(plot.low_z + 3.0, plot.high_z - 3.0));
      const bool in_pond = std::abs(at_x - x) < 12.0 && std::abs(at_z - z) < 10.0;
      add_tree(shapes_, in_pond ? at_x + (at_x < x ? -12.0 : 12.0) : at_x, at_z, kerb, own);
    }
  }

  /// Along the edges of the pavement in the north and south.
  void add_street_trees(const Plot& plot, Dice& dice) {
    const int trees = scaled(dice.between(1.0, 8.0), std::sqrt(detail_), 0);
    for (const double z : {plot.low_z + 1.0, plot.high_z - 1.0}) {
      for (int i = 0; i < trees; ++i)
        add_tree(shapes_, on_grid(plot.low_x + plot.width() * (i + 0.5) / trees), z, kerb, dice);
    }
  }

  Shapes& shapes_;
  double detail_;
  std::uint64_t buildings_ = 0;
};

void build_city(Shapes& shapes, double detail) {
  Town(shapes, detail).build();
}

std::vector<Material> paints() {
  std::vector<Material> all(colours);
  all[water].albedo = {0.10F, 0.24F, 0.32F};
  all[asphalt].albedo = {0.13F, 0.13F, 0.14F};
  all[pavement].albedo = {0.46F, 0.44F, 0.41F};
  all[grass].albedo = {0.26F, 0.40F, 0.16F};
  all[path].albedo = {0.66F, 0.58F, 0.44F};
  all[trunk].albedo = {0.30F, 0.20F, 0.13F};
  all[leaf].albedo = {0.10F, 0.24F, 0.10F};
  all[young_leaf].albedo = {0.20F, 0.36F, 0.13F};
  all[marking].albedo = {0.85F, 0.84F, 0.80F};
  all[concrete].albedo = {0.56F, 0.55F, 0.53F};
  all[brick].albedo = {0.56F, 0.30F, 0.21F};
  all[stone].albedo = {0.74F, 0.69F, 0.60F};
  all[plaster].albedo = {0.84F, 0.80F, 0.72F};
  all[dark_glass].albedo = {0.12F, 0.17F, 0.22F};
  all[metal].albedo = {0.40F, 0.43F, 0.46F};
  all[car_red].albedo = {0.66F, 0.12F, 0.10F};
  all[car_blue].albedo = {0.12F, 0.25F, 0.55F};
  all[car_white].albedo = {0.85F, 0.85F, 0.86F};
  for (int tone = 0; tone < roof_tones; ++tone) {
    const float part = static_cast<float>(tone) / (roof_tones - 1);
    const float high = part * std::sqrt(part);  // the low tones, which most roofs have, stay dark
    all[static_cast<std::size_t>(warm_roof) + static_cast<std::size_t>(tone)].albedo =
        glm::mix(glm::vec3(0.25F, 0.09F, 0.06F), glm::vec3(0.92F, 0.80F, 0.58F), high);
    all[static_cast<std::size_t>(cool_roof) + static_cast<std::size_t>(tone)].albedo =
        glm::mix(glm::vec3(0.09F, 0.11F, 0.15F), glm::vec3(0.80F, 0.87F, 0.92F), high);
  }
  return all;
}

BuiltInDescription whole_city(std::size_t triangles) {
  BuiltInDescription scene;
  scene.mesh.triangles.reserve(triangles);
  scene.mesh.materials.reserve(triangles);
  scene.mesh.vertices.reserve(triangles * 2 / 3);  // a box has 8 vertices for 12 triangles
  Shapes shapes(scene.mesh, Shapes::Normals::flat);
  build_city(shapes, detail_for(triangles, build_city));
  scene.materials = paints();
  scene.projection = Projection::orthographic;
  return scene;
}

}  // namespace
}  // namespace city_parts

BuiltInDescription city(std::size_t triangles) {
  BuiltInDescription scene = city_parts::whole_city(triangles);
  scene.eye = {25.0, 260.0, -40.0};
  scene.target = {25.0, 0.0, -40.0};
  scene.up = {0.0, 0.0, -1.0};  // north
  scene.fov_degrees = 86.0;
  scene.lights = {{{0.0, 1.0, 0.0}, {0.86, 0.83, 0.77}, LightKind::sun}};
  return scene;
}

BuiltInDescription city_oblique(std::size_t triangles) {
  BuiltInDescription scene = city_parts::whole_city(triangles);
  scene.eye = {500.0, 520.0, 560.0};
  scene.target = {70.0, 30.0, 10.0};
  scene.fov_degrees = 26.0;
  scene.lights = {{{0.0, 1.0, 0.0}, {0.86, 0.83, 0.77}, LightKind::sun},
                  {{1.0, 0.0, 0.0}, {0.34, 0.28, 0.20}, LightKind::sun}};
  return scene;
}

}  // namespace hitpipe::ref
