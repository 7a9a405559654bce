#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/shapes.hpp"

namespace hitpipe::ref {
namespace {

enum BranchColour : std::uint8_t { paper, bark, old_needle, needle, young_needle, cone_scale };

constexpr double golden_angle = 2.39996323;  // between successive needles, as in real twigs

struct Twig {
  glm::dvec3 from;
  glm::dvec3 direction;  ///< unit
  double length;
  double radius;
  int level;  ///< 0: the branch itself
};

class Spruce {
 public:
  Spruce(Shapes& shapes, double detail) : shapes_(shapes), detail_(detail) {}

  void grow(const Twig& twig) {
    const int steps = twig.level == 0 ? 40 : 16;
    std::vector<glm::dvec3> path{twig.from};
    std::vector<double> radii;
    glm::dvec3 direction = twig.direction;
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      radii.push_back(twig.radius * (1.0 - 0.75 * t) * (1.0 + 0.10 * noise({37.0 * t, 3.0, path[0].x})));
      if (i == steps) break;
      // In braces the dice are thrown from left to right.
      const glm::dvec3 sway{dice_.between(-0.05, 0.05), dice_.between(-0.05, 0.055),
                            dice_.between(-0.05, 0.05)};
      direction = glm::normalize(direction + sway);
      path.push_back(path.back() + direction * (twig.length / steps));
    }
    shapes_.material(bark);
    shapes_.tube(path, radii, twig.level == 0 ? 12 : 7, Ends::closed);
    needles(twig, path, radii);
    if (twig.level < 2) branch_off(twig, path);
  }

  /// Scales in a spiral around a spindle.
  void cone(const glm::dvec3& top, const glm::dvec3& axis, double length) {
    shapes_.material(cone_scale);
    const Frame frame = Frame::along(axis);
    constexpr int scales = 130;
    const int cells = detail_ < 0.4 ? 3 : 6;
    for (int i = 0; i < scales; ++i) {
      const double t = (i + 0.5) / scales;
      const double angle = golden_angle * i;
      const glm::dvec3 out = frame.x * std::cos(angle) + frame.y * std::sin(angle);
      const glm::dvec3 aside = glm::cross(frame.z, out);
      const double radius = 0.20 * length * std::pow(std::sin(std::numbers::pi * (0.06 + 0.9 * t)), 0.6);
      const double size = 0.17 * length * (0.55 + 0.45 * std::sin(std::numbers::pi * t));
      const glm::dvec3 root = top + frame.z * (length * t) + out * (0.35 * radius);
      shapes_.sheet(cells, cells, [&](double u, double v) {
        const double width = size * std::sqrt(std::max(0.0, 1.0 - std::pow(v, 3.0))) * 0.55 + 0.02 * size;
        const double bend = 0.30 * v * v;
        return root + out * (0.85 * radius * v * (1.0 + bend)) + frame.z * (size * (0.9 * v - 0.25 * bend)) +
               aside * (width * (2.0 * u - 1.0)) - out * (0.16 * size * (2.0 * u - 1.0) * (2.0 * u - 1.0));
      });
    }
    shapes_.rod(top - frame.z * (0.12 * length), top + frame.z * (0.95 * length), 0.07 * length, 8,
                Ends::closed);
  }

 private:
  static glm::dvec3 along(const std::vector<glm::dvec3>& path, double t) {
    const double place = t * static_cast<double>(path.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(place), path.size() - 2);
    return glm::mix(path[i], path[i + 1], place - static_cast<double>(i));
  }

  void branch_off(const Twig& twig, const std::vector<glm::dvec3>& path) {
    const int count = twig.level == 0 ? 22 : static_cast<int>(twig.length * 11.0);
    for (int i = 0; i < count; ++i) {
      const double t = 0.10 + 0.86 * (i + dice_.between(-0.3, 0.3)) / count;
      const glm::dvec3 way = glm::normalize(along(path, std::min(1.0, t + 0.05)) - along(path, t - 0.05));
      const glm::dvec3 aside =
          glm::normalize(glm::cross(way, glm::dvec3(0, 1, 0))) * (i % 2 == 0 ? 1.0 : -1.0);
      const double spread = dice_.between(0.85, 1.15);
      const glm::dvec3 direction =
          glm::normalize(way + aside * spread + glm::dvec3(0, dice_.between(-0.1, 0.22), 0));
      const double length =
          twig.length * (twig.level == 0 ? 0.52 : 0.42) * (1.06 - 0.86 * t) * dice_.between(0.8, 1.1);
      grow({along(path, t), direction, length, twig.radius * (0.55 - 0.25 * t), twig.level + 1});
    }
  }

  void needles(const Twig& twig, const std::vector<glm::dvec3>& path, const std::vector<double>& radii) {
    const int count = scaled(165.0 * twig.length, detail_, 3);
    // A twig has its own dice, so that its number of needles does not change how the next twig grows.
    Dice dice(needled_twigs_++);
    for (int i = 0; i < count; ++i) {
      const double t = (i + dice.next()) / count;
      const double bare = twig.level == 0 ? 0.12 : 0.03;
      const double roll = golden_angle * i + dice.between(-0.4, 0.4);
      const double length = dice.between(0.055, 0.085) * (1.0 - 0.35 * t);
      const double lean = dice.between(0.45, 0.9) + 0.7 * t;
      const double tint = dice.next();
      if (t < bare) continue;
      const glm::dvec3 way =
          glm::normalize(along(path, std::min(1.0, t + 0.04)) - along(path, std::max(0.0, t - 0.04)));
      const Frame frame = Frame::along(way);
      const glm::dvec3 out = frame.x * std::cos(roll) + frame.y * std::sin(roll);
      // Needles below the twig bend to the sides; those above stand up.
      const glm::dvec3 direction =
          glm::normalize(out * (out.y < -0.3 ? 0.75 : 1.0) + way * lean + glm::dvec3(0, 0.12, 0));
      const glm::dvec3 root =
          along(path, t) +
          out * (0.7 * radii[static_cast<std::size_t>(t * 0.999 * static_cast<double>(radii.size()))]);
      const double thick = 0.0031;
      const std::array<glm::dvec3, 5> bent{root, root + direction * (0.15 * length),
                                           root + direction * (0.5 * length) + way * (0.02 * length),
                                           root + direction * (0.82 * length) + way * (0.07 * length),
                                           root + direction * length + way * (0.14 * length)};
      const std::array<double, 5> thickness{0.5 * thick, thick, thick, 0.75 * thick, 0.0};
      shapes_.material(t > 0.82 && tint < 0.8 ? young_needle : tint < 0.25 ? old_needle : needle);
      shapes_.tube(bent, thickness, 4, Ends::open);
    }
  }

  Shapes& shapes_;
  double detail_;
  Dice dice_{0x5B2A};
  std::uint64_t needled_twigs_ = 0;
};

void build_branch(Shapes& shapes, double detail) {
  constexpr double half = 4.0;
  shapes.material(paper);
  shapes.quad({-half, -0.42, half}, {half, -0.42, half}, {half, -0.42, -half}, {-half, -0.42, -half});
  Spruce spruce(shapes, detail);
  spruce.grow({{-1.25, -0.10, 0.30}, glm::normalize(glm::dvec3(1.0, 0.12, -0.20)), 2.55, 0.036, 0});
  spruce.cone({0.42, -0.325, 0.92}, {0.90, 0.0, -0.12}, 0.42);
  spruce.cone({-0.28, -0.335, 1.02}, {0.70, 0.0, -0.30}, 0.38);
}

}  // namespace

BuiltInDescription branch(std::size_t triangles) {
  BuiltInDescription scene;
  scene.mesh.triangles.reserve(triangles);
  Shapes shapes(scene.mesh, Shapes::Normals::smooth);
  build_branch(shapes, detail_for(triangles, build_branch));
  scene.materials = {{.albedo = {0.80F, 0.76F, 0.69F}}, {.albedo = {0.36F, 0.25F, 0.17F}},
                     {.albedo = {0.12F, 0.25F, 0.15F}}, {.albedo = {0.17F, 0.36F, 0.19F}},
                     {.albedo = {0.38F, 0.55F, 0.24F}}, {.albedo = {0.50F, 0.33F, 0.20F}}};
  scene.eye = {0.20, 2.5, 2.6};
  scene.target = {0.16, -0.12, 0.02};
  scene.fov_degrees = 36.0;
  scene.lights = {{{-2.6, 3.6, 1.4}, {0.92, 0.86, 0.74}}, {{3.0, 2.4, 2.2}, {0.20, 0.23, 0.28}}};
  return scene;
}

}  // namespace hitpipe::ref
