#include <array>
#include <cmath>
#include <vector>

#include "sw_ref/scene/plant_parts.hpp"

namespace hitpipe::ref::plant {
namespace {

// The inner faces of the walls.
constexpr double left = boiler_x * bay + 0.9;
constexpr double right = (boiler_x + boiler_bays_x) * bay - 0.9;
constexpr double back = boiler_z * bay + 0.9;
constexpr double front = (boiler_z + boiler_bays_z) * bay - 0.9;
constexpr double hopper = 4.0;
constexpr double roof = storey * storeys + 5.0;

/// Upright tubes next to each other, with fins between them, and headers above and below.
void add_wall(Shapes& shapes, const glm::dvec3& from, const glm::dvec3& to, double detail) {
  const int tubes = scaled(110, std::sqrt(detail), 24);
  const int sides = scaled(9, std::sqrt(detail), 6);
  const glm::dvec3 step = (to - from) * (1.0 / tubes);
  const double radius = 0.36 * (std::abs(step.x) + std::abs(step.z));
  const glm::dvec3 up(0, roof - hopper, 0);
  shapes.material(tube);
  for (int i = 0; i < tubes; ++i) {
    const glm::dvec3 foot = from + step * (i + 0.5);
    shapes.rod(foot, foot + up, radius, sides);
    shapes.quad(foot, foot + step, foot + step + up, foot + up);
  }
  shapes.material(lagging);
  for (const double y : {0.0, roof - hopper})
    shapes.rod(from + glm::dvec3(0, y, 0), to + glm::dvec3(0, y, 0), 0.28, 20, Ends::closed);
}

/// Nested tubes that go up and down in a plane of constant x.
void add_platen(Shapes& shapes, double x, double low, double high, double near, double far, int tubes,
                int sides, int bend_steps, int passes) {
  for (int i = 0; i < tubes; ++i) {
    const double inset = 0.13 * i;
    std::vector<glm::dvec3> corners;
    const double pass = (far - near) / passes;
    for (int k = 0; k < passes; ++k) {
      const double z0 = near + pass * k + inset * 0.45 + 0.05;
      const double z1 = near + pass * (k + 1) - inset * 0.45 - 0.05;
      if (k == 0) corners.emplace_back(x, high + 0.8, z0);
      corners.emplace_back(x, low + inset, z0);
      corners.emplace_back(x, low + inset, z1);
      corners.emplace_back(x, high - inset, z1);
      if (k + 1 < passes) corners.emplace_back(x, high - inset, near + pass * (k + 1) + inset * 0.45 + 0.05);
    }
    corners.back().y = high + 0.8;
    add_bent_tube(shapes, corners, 0.038, 0.12, sides, bend_steps);
  }
}

void add_burner(Shapes& shapes, const glm::dvec3& centre, const glm::dvec3& inward, double detail) {
  const int sides = scaled(24, std::sqrt(detail), 10);
  shapes.material(dark);
  shapes.turned(centre, inward,
                std::array<glm::dvec2, 6>{
                    {{0.75, -0.5}, {0.72, 0.05}, {0.62, 0.02}, {0.45, -0.5}, {0.16, -0.5}, {0.0, 0.1}}},
                sides);
  const Frame frame = Frame::along(inward);
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5236 * i;
    const glm::dvec3 out = frame.x * std::cos(angle) + frame.y * std::sin(angle);
    shapes.bar(centre + out * 0.18 - inward * 0.3, centre + out * 0.6 - inward * 0.05, {0.02, 0.2});
  }
}

}  // namespace

void add_boiler(Shapes& shapes, double detail) {
  add_wall(shapes, {left, hopper, back}, {right, hopper, back}, detail);
  add_wall(shapes, {right, hopper, back}, {right, hopper, front}, detail);
  add_wall(shapes, {right, hopper, front}, {left, hopper, front}, detail);
  add_wall(shapes, {left, hopper, front}, {left, hopper, back}, detail);
  shapes.material(lagging);
  shapes.box({left - 0.5, roof + 0.2, back - 0.5}, {right + 0.5, roof + 1.6, front + 0.5});
  // The hopper below: two slopes with a slot between them.
  shapes.material(dark);
  const double middle = 0.5 * (back + front);
  for (const double side : {-1.0, 1.0}) {
    const double edge = side < 0.0 ? back : front;
    shapes.quad({left, hopper, edge}, {right, hopper, edge}, {right, 1.0, middle + side},
                {left, 1.0, middle + side});
  }
  for (const double y : {9.0, 12.5}) {
    for (int i = 0; i < 4; ++i) {
      const double x = left + (right - left) * (i + 0.5) / 4.0;
      add_burner(shapes, {x, y, back + 0.12}, {0, 0, 1}, detail);
      add_burner(shapes, {x, y, front - 0.12}, {0, 0, -1}, detail);
    }
  }
  // Superheater platens hang from the roof; below it the economiser's bundles lie across.
  shapes.material(tube);
  const int platens = scaled(14, std::sqrt(detail), 5);
  const int sides = scaled(8, std::sqrt(detail), 5);
  const int bend_steps = scaled(4, std::sqrt(detail), 2);
  const int tubes = scaled(6, std::sqrt(detail), 2);
  for (int i = 0; i < platens; ++i) {
    const double x = left + (right - left) * (i + 0.5) / platens;
    add_platen(shapes, x, 16.5, roof, back + 0.6, middle + 1.0, std::min(tubes, 12), sides, bend_steps, 2);
    add_platen(shapes, x, 19.5, roof, middle + 1.6, front - 0.6, std::min(tubes, 12), sides, bend_steps, 3);
  }
  shapes.material(lagging);
  for (const double z : {back + 1.2, middle, middle + 2.6, front - 1.2})
    shapes.rod({left, roof + 0.9, z}, {right, roof + 0.9, z}, 0.3, 18, Ends::closed);
}

}  // namespace hitpipe::ref::plant
