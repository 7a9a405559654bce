#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/plant_parts.hpp"

namespace hitpipe::ref::plant {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// Two discs and their bolts.
void add_flange(Shapes& shapes, const glm::dvec3& centre, const glm::dvec3& way, double radius,
                double detail) {
  const glm::dvec3 half = way * 0.035;
  const int sides = scaled(14, std::sqrt(detail), 8);
  shapes.rod(centre - half, centre + half, 1.45 * radius, sides, Ends::closed);
  const int bolts = scaled(6, detail, 4);
  const Frame frame = Frame::along(way);
  for (int i = 0; i < std::min(bolts, 20); ++i) {
    const double angle = full_turn * i / std::min(bolts, 20);
    const glm::dvec3 at = centre + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * (1.24 * radius);
    shapes.rod(at - way * 0.06, at + way * 0.06, 0.10 * radius + 0.004, 6, Ends::closed);
  }
}

/// A body, a spindle and a handwheel of four spokes.
void add_valve(Shapes& shapes, const glm::dvec3& centre, const glm::dvec3& way, double radius,
               double detail) {
  const Frame frame = Frame::along(way);
  const glm::dvec3 up = std::abs(way.y) < 0.5 ? glm::dvec3(0, 1, 0) : frame.x;
  const glm::dvec3 aside = glm::cross(way, up);
  shapes.material(pipe_red);
  const std::array<glm::dvec2, 7> body{
      {{1.0, -2.0}, {1.1, -1.2}, {1.7, -0.6}, {1.8, 0.0}, {1.7, 0.6}, {1.1, 1.2}, {1.0, 2.0}}};
  std::array<glm::dvec2, 7> profile{};
  for (std::size_t i = 0; i < body.size(); ++i) profile[i] = body[i] * radius;
  shapes.turned(centre, way, profile, scaled(12, std::sqrt(detail), 6));
  shapes.rod(centre, centre + up * (3.6 * radius), 0.25 * radius, 6);
  const glm::dvec3 hub = centre + up * (3.5 * radius);
  const int steps = scaled(14, std::sqrt(detail), 8);
  std::vector<glm::dvec3> wheel;
  for (int i = 0; i <= steps; ++i) {
    const double angle = full_turn * i / steps;
    wheel.push_back(hub + (way * std::cos(angle) + aside * std::sin(angle)) * (2.0 * radius));
  }
  shapes.tube(wheel, std::vector<double>(wheel.size(), 0.16 * radius), 6, Ends::open);
  for (const glm::dvec3& spoke : {way, aside})
    shapes.rod(hub - spoke * (2.0 * radius), hub + spoke * (2.0 * radius), 0.1 * radius, 5);
}

constexpr std::array<glm::dvec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// A random route along the axes, inside the frame.
void add_route(Shapes& shapes, Dice& dice, double detail) {
  const double radius = 0.035 + 0.22 * std::pow(dice.next(), 3.0);
  const glm::dvec3 low(0.6, 0.8, 0.6);
  const glm::dvec3 high(bays_x * bay - 0.6, storeys * storey + 2.0, bays_z * bay - 0.6);
  const double floor = dice.below(storeys) * storey;
  // In braces the dice are thrown from left to right.
  glm::dvec3 at{dice.between(low.x, high.x), floor + dice.between(2.6, 5.2), dice.between(low.z, high.z)};
  std::vector<glm::dvec3> corners{at};
  int axis = dice.below(2) * 2;
  const int legs = 3 + dice.below(8);
  for (int i = 0; i < legs; ++i) {
    const double there = dice.chance(0.5) ? 1.0 : -1.0;
    const double length = there * dice.between(1.5, axis == 1 ? 6.0 : 14.0);
    glm::dvec3 next = at + axes[static_cast<std::size_t>(axis)] * length;
    // A leg that would leave the frame turns back.
    if (next[axis] < low[axis] || next[axis] > high[axis])
      next = at - axes[static_cast<std::size_t>(axis)] * length;
    const bool leaves = next[axis] < low[axis] || next[axis] > high[axis];
    const bool burns = enters_boiler(std::min(at.x, next.x), std::max(at.x, next.x), std::min(at.z, next.z),
                                     std::max(at.z, next.z));
    if (!leaves && !burns) {
      corners.push_back(next);
      at = next;
    }
    axis = (axis + 1 + dice.below(2)) % 3;
  }
  const double flanged = dice.next();
  const bool valved = dice.chance(0.35);
  const auto colour = static_cast<std::uint8_t>(dice.chance(0.3) ? int{lagging} : pipe_grey + dice.below(4));
  if (corners.size() < 2) return;
  shapes.material(colour);
  add_bent_tube(shapes, corners, radius, 2.5 * radius, scaled(12, std::sqrt(detail), 6),
                scaled(5, std::sqrt(detail), 2));
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const glm::dvec3 leg = corners[i + 1] - corners[i];
    const double length = glm::length(leg);
    if (length < 12.0 * radius || flanged > 0.6) continue;
    const glm::dvec3 way = leg / length;
    shapes.material(colour);
    for (const double from_end : {0.25, 0.75})
      add_flange(shapes, corners[i] + leg * from_end, way, radius, detail);
    if (valved && i == 1) add_valve(shapes, corners[i] + leg * 0.5, way, radius, detail);
  }
}

/// Parallel pipes under a floor, along x, hung every bay.
void add_rack(Shapes& shapes, Dice& dice, int level, int lane, double detail) {
  const double y = level * storey - 1.1 - 0.5 * (lane % 2);
  const double z = (lane + 0.5) * bay;
  const int pipes = scaled(7, std::sqrt(detail), 4);
  for (int i = 0; i < pipes; ++i) {
    const double radius = dice.between(0.04, 0.14);
    const double at = z + 4.4 * (static_cast<double>(i) / pipes - 0.5);
    shapes.material(static_cast<std::uint8_t>(pipe_grey + dice.below(4)));
    // The boiler interrupts the lanes behind it.
    const bool cut = lane >= boiler_z && lane < boiler_z + boiler_bays_z;
    const double stop = cut ? boiler_x * bay - 0.8 : bays_x * bay + 1.0;
    const int sides = scaled(14, std::sqrt(detail), 6);
    shapes.rod({-1.0, y, at}, {stop, y, at}, radius, sides, Ends::closed);
    if (cut)
      shapes.rod({(boiler_x + boiler_bays_x) * bay + 0.8, y, at}, {bays_x * bay + 1.0, y, at}, radius, sides,
                 Ends::closed);
    for (double x = 2.0; x < stop; x += 6.0 / std::max(0.7, std::sqrt(detail)))
      add_flange(shapes, {x + 0.2 * i, y, at}, {1, 0, 0}, radius, detail);
  }
  shapes.material(steel);
  for (int x = 0; x <= bays_x; ++x) {
    for (const double side : {-2.4, 2.4})
      shapes.rod({x * bay, y - 0.2, z + side}, {x * bay, level * storey, z + side}, 0.02, 5);
    shapes.bar({x * bay, y - 0.2, z - 2.5}, {x * bay, y - 0.2, z + 2.5}, {0.08, 0.08});
  }
}

}  // namespace

void add_bent_tube(Shapes& shapes, std::span<const glm::dvec3> corners, double radius, double bend, int sides,
                   int bend_steps) {
  std::vector<glm::dvec3> path{corners.front()};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const glm::dvec3 in = glm::normalize(corners[i] - corners[i - 1]);
    const glm::dvec3 out = glm::normalize(corners[i + 1] - corners[i]);
    const double shortest =
        std::min(glm::distance(corners[i], corners[i - 1]), glm::distance(corners[i], corners[i + 1]));
    const double r = std::min(bend, 0.45 * shortest);
    if (glm::dot(in, out) > 0.5) continue;  // straight on
    if (glm::dot(in, out) < -0.5) {
      path.push_back(corners[i]);
      continue;
    }
    const glm::dvec3 centre = corners[i] - in * r + out * r;
    for (int k = 0; k <= bend_steps; ++k) {
      const double angle = 0.25 * full_turn * k / bend_steps;
      path.push_back(centre - out * (r * std::cos(angle)) + in * (r * std::sin(angle)));
    }
  }
  path.push_back(corners.back());
  shapes.tube(path, std::vector<double>(path.size(), radius), sides, Ends::closed);
}

void add_pipework(Shapes& shapes, double detail) {
  Dice dice(0x71E5);
  const int routes = scaled(420, detail, 20);
  for (int i = 0; i < routes; ++i) {
    Dice route(static_cast<std::uint64_t>(i) +
               1000);  // its own dice, so that more routes do not change the first routes
    add_route(shapes, route, detail);
  }
  for (int level = 1; level <= storeys; ++level) {
    for (int lane = 0; lane < bays_z; ++lane) add_rack(shapes, dice, level, lane, detail);
  }
}

}  // namespace hitpipe::ref::plant
