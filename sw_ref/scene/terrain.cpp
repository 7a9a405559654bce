#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/shapes.hpp"

namespace hitpipe::ref {
namespace {

enum Ground : std::uint8_t { sand, meadow, forest, rock, scree, snow };

// In kilometres, y up. The land is a square around the origin, and the eye looks along -z.
constexpr double half_land = 5.0;

/// Each octave adds less where the sum is low. So valleys are smooth and crests are sharp, as erosion leaves
/// them (Musgrave's ridged multifractal).
double ridges(glm::dvec3 p, int octaves) {
  double sum = 0.0;
  double height = 0.5;
  double weight = 1.0;
  for (int i = 0; i < octaves; ++i) {
    const double crest = 1.0 - std::abs(noise(p));
    const double part = crest * crest * weight;
    sum += height * part;
    weight = std::clamp(1.6 * part, 0.0, 1.0);
    p = 2.03 * p + 11.7;  // the octaves' lattices must not share a point
    height *= 0.5;
  }
  return sum;  // in [0, 1)
}

double height_at(double x, double z) {
  const glm::dvec3 p(x, 0.0, z);
  const double rolling = layered_noise(0.45 * p + 3.1, 5);
  // The mountains begin behind the plain, and are highest at the far edge.
  const double far = glm::smoothstep(-0.6, 0.9, -z / half_land + 0.15 * rolling);
  const double fine = layered_noise(11.0 * p + 7.7, 5);
  return 0.16 * rolling + (0.30 + 1.9 * far) * ridges(0.42 * p + 5.3, 10) + 0.008 * fine - 0.25;
}

/// In [-1, 1), another one for each point and `use`.
double error_of(int column, int row, std::uint64_t use) {
  const std::uint64_t key =
      static_cast<std::uint64_t>(column) << 32U | static_cast<std::uint64_t>(row) << 2U | use;
  return static_cast<double>(mixed(key ^ 0x7E22A1) >> 11U) * 0x1p-52 - 1.0;
}

std::uint8_t colour_of(const Mesh::Corners& corners) {
  const glm::dvec3 a(corners.a);
  const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(corners.b) - a, glm::dvec3(corners.c) - a));
  const glm::dvec3 middle = (a + glm::dvec3(corners.b) + glm::dvec3(corners.c)) / 3.0;
  const double wander = layered_noise(2.2 * middle, 8);
  const double height = middle.y + 0.12 * wander;
  const double steep = 1.0 - normal.y + 0.03 * wander;
  if (height > 0.85 && steep < 0.42) return snow;
  if (steep > 0.26) return height > 0.4 ? rock : scree;
  if (height > 0.62) return scree;
  if (steep > 0.09 || wander > 0.5) return forest;
  return height < -0.12 ? sand : meadow;
}

}  // namespace

BuiltInDescription terrain(std::size_t triangles) {
  BuiltInDescription scene;
  const int side = static_cast<int>(std::sqrt(static_cast<double>(triangles) / 2.0));
  const int rows = static_cast<int>(static_cast<double>(triangles) / 2.0 / side);
  scene.mesh.vertices.reserve(static_cast<std::size_t>(side + 1) * static_cast<std::size_t>(rows + 1));
  scene.mesh.normals.reserve(scene.mesh.vertices.capacity());
  scene.mesh.triangles.reserve(triangles);
  scene.mesh.materials.reserve(triangles);
  Shapes shapes(scene.mesh, Shapes::Normals::smooth);
  const double cell = 2.0 * half_land / side;
  shapes.sheet(side, rows, [&](double u, double v) {
    const auto column = static_cast<int>(std::lround(u * side));
    const auto row = static_cast<int>(std::lround(v * rows));
    // Points stay within a quarter of a cell, so no triangle turns over.
    const double x = half_land * (2.0 * u - 1.0) + 0.25 * cell * error_of(column, row, 0);
    const double z = half_land * (1.0 - 2.0 * v) + 0.25 * cell * error_of(column, row, 1);
    return glm::dvec3(x, height_at(x, z) + 0.06 * cell * error_of(column, row, 2), z);
  });
  for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i)
    scene.mesh.materials[i] = colour_of(scene.mesh.corners(i));
  scene.materials = {{.albedo = {0.62F, 0.54F, 0.40F}}, {.albedo = {0.36F, 0.42F, 0.18F}},
                     {.albedo = {0.15F, 0.24F, 0.12F}}, {.albedo = {0.40F, 0.36F, 0.33F}},
                     {.albedo = {0.52F, 0.47F, 0.41F}}, {.albedo = {0.90F, 0.91F, 0.93F}}};
  scene.eye = {0.4, 0.55, 4.9};
  scene.target = {0.0, 0.25, 0.0};
  scene.fov_degrees = 44.0;
  scene.lights = {{{-0.90, 0.27, 0.30}, {1.20, 1.02, 0.82}, LightKind::sun}};
  return scene;
}

}  // namespace hitpipe::ref
