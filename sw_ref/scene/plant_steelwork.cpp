#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/plant_parts.hpp"

namespace hitpipe::ref::plant {
namespace {

/// An I-section: two flanges and a web.
void add_beam(Shapes& shapes, const glm::dvec3& from, const glm::dvec3& to, double width, double height) {
  const Frame frame = Frame::along(to - from);
  const glm::dvec3 up = frame.y * (0.5 * height - 0.01);
  shapes.bar(from + up, to + up, {width, 0.02});
  shapes.bar(from - up, to - up, {width, 0.02});
  shapes.bar(from, to, {0.012, height - 0.04});
}

/// Posts, two rails and a toe board.
void add_handrail(Shapes& shapes, const glm::dvec3& from, const glm::dvec3& to) {
  shapes.material(yellow);
  const glm::dvec3 up(0, 1, 0);
  const double length = glm::length(to - from);
  const int posts = std::max(1, static_cast<int>(length / 1.5));
  for (int i = 0; i <= posts; ++i) {
    const glm::dvec3 foot = from + (to - from) * (static_cast<double>(i) / posts);
    shapes.rod(foot, foot + up * 1.1, 0.024, 6);
  }
  for (const double height : {0.55, 1.1}) shapes.rod(from + up * height, to + up * height, 0.022, 6);
  shapes.bar(from + up * 0.07, to + up * 0.07, {0.006, 0.12});
}

/// Bearing bars along x, thinner cross rods along z.
void add_grating(Shapes& shapes, const glm::dvec3& corner, double width, double depth, double detail) {
  shapes.material(grating);
  const int bars = scaled(depth / 0.12, detail, 4);
  const int rods = scaled(width / 0.45, detail, 2);
  for (int i = 0; i <= bars; ++i) {
    const double z = corner.z + depth * i / bars;
    shapes.bar({corner.x, corner.y, z}, {corner.x + width, corner.y, z}, {0.008, 0.04});
  }
  for (int i = 0; i <= rods; ++i) {
    const double x = corner.x + width * i / rods;
    shapes.bar({x, corner.y + 0.012, corner.z}, {x, corner.y + 0.012, corner.z + depth}, {0.008, 0.010});
  }
}

void add_stair(Shapes& shapes, const glm::dvec3& foot, double run, double rise, double width, double detail) {
  constexpr int treads = 18;
  const glm::dvec3 top = foot + glm::dvec3(run, rise, 0);
  for (const double side : {0.0, width}) {
    shapes.material(steel);
    shapes.bar(foot + glm::dvec3(0, 0, side), top + glm::dvec3(0, 0, side), {0.02, 0.25});
    shapes.material(yellow);
    for (const double height : {0.55, 1.05})
      shapes.rod(foot + glm::dvec3(0, height, side), top + glm::dvec3(0, height, side), 0.022, 6);
    for (int i = 0; i <= 6; ++i) {
      const glm::dvec3 post = foot + (top - foot) * (i / 6.0) + glm::dvec3(0, 0, side);
      shapes.rod(post, post + glm::dvec3(0, 1.05, 0), 0.022, 6);
    }
  }
  shapes.material(grating);
  const int bars = scaled(4, std::sqrt(detail), 2);
  for (int i = 0; i < treads; ++i) {
    const glm::dvec3 at = foot + (top - foot) * ((i + 0.5) / treads);
    for (int k = 0; k < bars; ++k) {
      const double x = at.x - 0.12 + 0.24 * k / bars;
      shapes.bar({x, at.y, at.z}, {x, at.y, at.z + width}, {0.012, 0.03});
    }
  }
}

/// A ladder with safety hoops.
void add_ladder(Shapes& shapes, const glm::dvec3& foot, double height) {
  shapes.material(yellow);
  for (const double side : {-0.22, 0.22})
    shapes.rod(foot + glm::dvec3(side, 0, 0), foot + glm::dvec3(side, height, 0), 0.025, 6);
  for (double y = 0.3; y < height; y += 0.3)
    shapes.rod(foot + glm::dvec3(-0.22, y, 0), foot + glm::dvec3(0.22, y, 0), 0.014, 5);
  for (double y = 2.4; y < height; y += 0.9) {
    std::array<glm::dvec3, 9> hoop{};
    std::array<double, 9> radii{};
    for (std::size_t i = 0; i < hoop.size(); ++i) {
      const double angle = 3.14159265 * static_cast<double>(i) / 8.0;
      hoop[i] = foot + glm::dvec3(0.38 * std::cos(angle), y, 0.70 * std::sin(angle));
      radii[i] = 0.012;
    }
    shapes.tube(hoop, radii, 4, Ends::open);
  }
}

bool has_grating(int x, int z, int level) {
  return !is_boiler(x, z) && mixed(static_cast<std::uint64_t>(x * 64 + z * 8 + level) + 77) % 8 != 0;
}

}  // namespace

void add_steelwork(Shapes& shapes, double detail) {
  constexpr double height = storey * storeys;
  for (int x = 0; x <= bays_x; ++x) {
    for (int z = 0; z <= bays_z; ++z) {
      const glm::dvec3 foot(x * bay, 0, z * bay);
      if (enters_boiler(foot.x, foot.x, foot.z, foot.z)) continue;
      shapes.material(steel);
      add_beam(shapes, foot, foot + glm::dvec3(0, height, 0), 0.4, 0.4);
      shapes.material(concrete);
      shapes.box(foot - glm::dvec3(0.5, 0.0, 0.5), foot + glm::dvec3(0.5, 0.35, 0.5));
    }
  }
  for (int level = 1; level <= storeys; ++level) {
    const double y = level * storey;
    shapes.material(steel);
    for (int x = 0; x <= bays_x; ++x) {
      for (int z = 0; z <= bays_z; ++z) {
        const glm::dvec3 from(x * bay, y, z * bay);
        for (const glm::dvec3& to : {from + glm::dvec3(bay, 0, 0), from + glm::dvec3(0, 0, bay)}) {
          const bool ends = to.x > bays_x * bay || to.z > bays_z * bay;
          if (!ends && !enters_boiler(from.x, to.x, from.z, to.z)) add_beam(shapes, from, to, 0.25, 0.5);
        }
      }
    }
    for (int x = 0; x < bays_x; ++x) {
      for (int z = 0; z < bays_z; ++z) {
        if (is_boiler(x, z)) continue;
        shapes.material(steel);
        for (const double part : {1.0 / 3.0, 2.0 / 3.0}) {
          const double at = (z + part) * bay;
          add_beam(shapes, {x * bay, y + 0.12, at}, {(x + 1) * bay, y + 0.12, at}, 0.12, 0.24);
        }
        if (has_grating(x, z, level)) add_grating(shapes, {x * bay, y + 0.27, z * bay}, bay, bay, detail);
      }
    }
    const double rail = y + 0.29;
    for (int x = 0; x < bays_x; ++x) {
      for (const double z : {0.0, bays_z * bay})
        add_handrail(shapes, {x * bay, rail, z}, {(x + 1) * bay, rail, z});
    }
    for (int z = 0; z < bays_z; ++z) {
      for (const double x : {0.0, bays_x * bay})
        add_handrail(shapes, {x, rail, z * bay}, {x, rail, (z + 1) * bay});
    }
  }
  for (int level = 0; level < storeys; ++level) {
    const double y = level * storey;
    // Bracing of the outer bays, and a stair tower in front of the frame.
    shapes.material(steel);
    for (const int x : {0, 5, bays_x - 1}) {
      for (const double z : {0.0, bays_z * bay}) {
        shapes.bar({x * bay, y, z}, {(x + 1) * bay, y + storey, z}, {0.12, 0.12});
        shapes.bar({x * bay, y + storey, z}, {(x + 1) * bay, y, z}, {0.12, 0.12});
      }
    }
    add_stair(shapes, {1.2, y + 0.29, bays_z * bay + 0.6}, 5.0, 3.0, 1.0, detail);
    add_stair(shapes, {6.2, y + 3.29, bays_z * bay + 1.8}, -5.0, 3.0, 1.0, detail);
    add_grating(shapes, {6.2, y + 3.29, bays_z * bay + 0.6}, 1.2, 2.2, detail);
    add_grating(shapes, {0.0, y + 6.29, bays_z * bay + 0.0}, 1.2, 2.8, detail);
    add_ladder(shapes, {bays_x * bay - 1.5, y, bays_z * bay + 0.35}, storey + 1.0);
    add_ladder(shapes, {3.5 * bay, y, -1.05}, storey + 1.0);
  }
}

}  // namespace hitpipe::ref::plant
