#include <array>
#include <cmath>
#include <numbers>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/shapes.hpp"

namespace hitpipe::ref {
namespace {

constexpr double half_width = 1.2;
constexpr double half_length = 1.5;

/// A wave that runs across the sea at an angle to its x axis.
struct Swell {
  double angle;   // radians
  double length;  // from crest to crest
  double height;  // of a crest
};
constexpr std::array<Swell, 3> swells{{{1.35, 0.52, 0.045}, {0.6, 0.31, 0.022}, {2.3, 0.19, 0.012}}};

double height(double x, double y) {
  double sum = 0.0;
  for (const Swell& swell : swells) {
    const double along = x * std::cos(swell.angle) + y * std::sin(swell.angle);
    sum += swell.height * std::sin(2.0 * std::numbers::pi * along / swell.length);
  }
  return sum;
}

/// The plane leans by 45 degrees: its normal is (0, 1, 1), its length goes up the slope.
glm::dvec3 point(double u, double v) {
  const double x = half_width * (2.0 * u - 1.0);
  const double y = half_length * (2.0 * v - 1.0);
  const double h = height(x, y);
  const double root_half = std::numbers::sqrt2 / 2.0;
  return {x, root_half * (h + y), root_half * (h - y)};
}

}  // namespace

BuiltInDescription waves(std::size_t triangles) {
  BuiltInDescription scene;
  Shapes shapes(scene.mesh, Shapes::Normals::smooth);
  const double cells = static_cast<double>(triangles) / 2.0;
  const int columns = static_cast<int>(std::sqrt(cells * half_width / half_length));
  shapes.sheet(columns, static_cast<int>(cells / columns), point);
  scene.materials = {{.albedo = {0.42F, 0.56F, 0.62F}}};
  // View and light meet the plane at 25 degrees, so that waves shade other waves.
  scene.eye = {-1.5, -1.5, 4.5};
  scene.fov_degrees = 22.0;
  scene.lights = {{{1.8, 5.4, -1.8}, {1.0, 0.95, 0.86}}};
  return scene;
}

}  // namespace hitpipe::ref
