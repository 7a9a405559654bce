#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/plant_parts.hpp"

namespace hitpipe::ref::plant {
namespace {

/// A cylinder with rounded heads, from `base` along `axis`.
void add_vessel(Shapes& shapes, const glm::dvec3& base, const glm::dvec3& axis, double radius, double length,
                double detail) {
  const int sides = scaled(28, std::sqrt(detail), 10);
  const int steps = scaled(5, std::sqrt(detail), 3);
  std::vector<glm::dvec2> profile;
  const double head = 0.45 * radius;
  for (int i = 0; i <= steps; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / steps;
    profile.emplace_back(i == 0 ? 0.0 : radius * std::sin(angle), head * (1.0 - std::cos(angle)));
  }
  // Plates with a seam between them.
  const int plates = std::max(2, static_cast<int>(length / 1.6));
  for (int i = 1; i < plates; ++i) {
    const double y = head + (length - 2.0 * head) * i / plates;
    for (const double step : {-0.02, 0.0, 0.02})
      profile.emplace_back(radius + (step == 0.0 ? 0.015 : 0.0), y + step);
  }
  for (int i = steps; i >= 0; --i) {
    const double angle = 0.5 * std::numbers::pi * i / steps;
    profile.emplace_back(i == 0 ? 0.0 : radius * std::sin(angle), length - head * (1.0 - std::cos(angle)));
  }
  shapes.turned(base, axis, profile, sides);
}

void add_pump(Shapes& shapes, const glm::dvec3& at, double detail) {
  shapes.material(concrete);
  shapes.box(at + glm::dvec3(-0.9, 0.0, -0.4), at + glm::dvec3(0.9, 0.25, 0.4));
  shapes.material(pipe_blue);
  add_vessel(shapes, at + glm::dvec3(-0.75, 0.65, 0.0), {1, 0, 0}, 0.32, 0.95, detail);
  shapes.material(dark);
  const int fins = scaled(18, detail, 6);
  for (int i = 0; i < fins; ++i) {
    const double x = at.x - 0.65 + 0.75 * i / fins;
    shapes.bar({x, at.y + 0.30, at.z}, {x, at.y + 1.02, at.z}, {0.012, 0.72});
  }
  shapes.material(pipe_green);
  shapes.rod(at + glm::dvec3(0.2, 0.65, 0.0), at + glm::dvec3(0.55, 0.65, 0.0), 0.06, 10);
  shapes.rod(at + glm::dvec3(0.65, 0.65, -0.16), at + glm::dvec3(0.65, 0.65, 0.16), 0.38,
             scaled(20, std::sqrt(detail), 10), Ends::closed);
  shapes.rod(at + glm::dvec3(0.65, 0.65, 0.0), at + glm::dvec3(0.65, 2.2, 0.0), 0.11, 12);
}

void add_equipment(Shapes& shapes, const glm::dvec3& floor, Dice& dice, double detail) {
  const int kind = dice.below(6);
  const glm::dvec3 centre = floor + glm::dvec3(0.5 * bay, 0.0, 0.5 * bay);
  const double size = dice.between(0.8, 1.2);
  if (kind <= 1) {
    shapes.material(kind == 0 ? tank_white : lagging);
    add_vessel(shapes, centre + glm::dvec3(0, 0.5, 0), {0, 1, 0}, 1.15 * size, 3.9, detail);
    shapes.material(steel);
    for (const double x : {-0.7, 0.7}) {
      for (const double z : {-0.7, 0.7})
        shapes.bar(centre + glm::dvec3(x * size, 0, z * size), centre + glm::dvec3(x * size, 1.0, z * size),
                   {0.12, 0.12});
    }
  } else if (kind <= 3) {
    for (int i = 0; i < kind; ++i) {
      const double z = centre.z - 1.1 + 1.8 * i;
      shapes.material(i == 0 ? lagging : pipe_green);
      add_vessel(shapes, {floor.x + 1.0, floor.y + 1.4, z}, {1, 0, 0}, 0.6 * size, 5.4, detail);
      shapes.material(concrete);
      for (const double x : {2.0, 5.2})
        shapes.box({floor.x + x, floor.y, z - 0.45}, {floor.x + x + 0.4, floor.y + 1.1, z + 0.45});
    }
  } else if (kind == 4) {
    for (int i = 0; i < 3; ++i)
      add_pump(shapes, floor + glm::dvec3(1.6 + 0.3 * i, 0.0, 1.4 + 2.1 * i), detail);
  } else {
    // Switchgear: a row of cabinets.
    for (int i = 0; i < 6; ++i) {
      const double x = floor.x + 1.0 + 0.85 * i;
      shapes.material(tank_white);
      shapes.box({x, floor.y, centre.z - 0.4}, {x + 0.8, floor.y + 2.1, centre.z + 0.4});
      shapes.material(dark);
      const int slats = scaled(9, detail, 3);
      for (int k = 0; k < slats; ++k) {
        const double y = floor.y + 0.3 + 0.7 * k / slats;
        shapes.bar({x + 0.15, y, centre.z + 0.41}, {x + 0.65, y, centre.z + 0.41}, {0.02, 0.02});
      }
    }
  }
}

void add_chimney(Shapes& shapes, const glm::dvec3& foot, double height, double detail) {
  std::vector<glm::dvec2> profile;
  const int rings = 30;
  for (int i = 0; i <= rings; ++i) profile.emplace_back(2.4 - 0.9 * i / rings, height * i / rings);
  profile.emplace_back(1.30, height);
  profile.emplace_back(1.25, height - 4.0);
  shapes.material(concrete);
  shapes.turned(foot, {0, 1, 0}, profile, scaled(36, std::sqrt(detail), 12));
  for (const double part : {0.45, 0.72, 0.96}) {
    const double y = height * part;
    const double radius = 2.4 - 0.9 * part;
    shapes.material(pipe_red);
    shapes.rod(foot + glm::dvec3(0, y - 1.2, 0), foot + glm::dvec3(0, y + 1.2, 0), radius + 0.05,
               scaled(36, std::sqrt(detail), 12));
    shapes.material(yellow);
    const int posts = 24;
    std::vector<glm::dvec3> ring;
    for (int i = 0; i <= posts; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / posts;
      ring.push_back(foot +
                     glm::dvec3((radius + 1.0) * std::cos(angle), y + 1.1, (radius + 1.0) * std::sin(angle)));
      shapes.rod(ring.back() - glm::dvec3(0, 1.1, 0), ring.back(), 0.03, 5);
      shapes.rod(ring.back() - glm::dvec3(0, 1.1, 0),
                 {foot.x + radius * std::cos(angle), y, foot.z + radius * std::sin(angle)}, 0.05, 5);
    }
    shapes.tube(ring, std::vector<double>(ring.size(), 0.03), 5, Ends::open);
  }
}

}  // namespace

void add_vessels(Shapes& shapes, double detail) {
  for (int level = 0; level < storeys; ++level) {
    for (int x = 0; x < bays_x; ++x) {
      for (int z = 0; z < bays_z; ++z) {
        if (is_boiler(x, z)) continue;
        Dice dice(static_cast<std::uint64_t>((level * bays_x + x) * bays_z + z) + 5000);
        add_equipment(shapes, {x * bay, level * storey + (level == 0 ? 0.0 : 0.3), z * bay}, dice, detail);
      }
    }
  }
  add_chimney(shapes, {18.0, 0.0, -10.0}, 68.0, detail);
  add_chimney(shapes, {38.0, 0.0, -10.0}, 68.0, detail);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 base(bays_x * bay + 9.0, 0.0, 3.0 + 13.0 * i);
    shapes.material(tank_white);
    add_vessel(shapes, base, {0, 1, 0}, 5.2, 11.0, detail);
  }
  for (int i = 0; i < 2; ++i) {
    shapes.material(i == 0 ? tank_white : lagging);
    add_vessel(shapes, {-9.0, 0.0, 6.0 + 14.0 * i}, {0, 1, 0}, 4.4, 14.0 - 3.0 * i, detail);
  }
}

}  // namespace hitpipe::ref::plant
