#include "sw_ref/scene/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

namespace hitpipe::ref {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : otherwise;
}

}  // namespace

Frame Frame::along(const glm::dvec3& direction) {
  const glm::dvec3 z = glm::normalize(direction);
  const glm::dvec3 aside = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(aside, z));
  return {x, glm::cross(z, x), z};
}

Frame Frame::turned(const glm::dvec3& direction) const {
  const glm::dvec3 x_left = x - direction * glm::dot(x, direction);
  if (glm::length(x_left) < 1e-6) return along(direction);
  const glm::dvec3 new_x = glm::normalize(x_left);
  return {new_x, glm::cross(direction, new_x), direction};
}

std::uint32_t Shapes::vertex(const glm::dvec3& p, const glm::dvec3& normal) {
  mesh_->vertices.emplace_back(p);
  if (smooth_) mesh_->normals.emplace_back(normal);
  return static_cast<std::uint32_t>(mesh_->vertices.size() - 1);
}

void Shapes::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh_->triangles.emplace_back(a, b, c);
  mesh_->materials.push_back(material_);
}

void Shapes::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  triangles_ += 2;
  if (!mesh_) return;
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const std::uint32_t first = vertex(a, normal);
  vertex(b, normal);
  vertex(c, normal);
  vertex(d, normal);
  triangle(first, first + 1, first + 2);
  triangle(first, first + 2, first + 3);
}

void Shapes::box(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 middle(0.0, 0.5 * (low.y + high.y), 0.5 * (low.z + high.z));
  bar({low.x, middle.y, middle.z}, {high.x, middle.y, middle.z}, {high.z - low.z, high.y - low.y});
}

void Shapes::bar(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec2& across) {
  if (!mesh_) {
    triangles_ += 12;
    return;
  }
  const Frame frame = Frame::along(to - from);
  const glm::dvec3 x = frame.x * (0.5 * across.x);
  const glm::dvec3 y = frame.y * (0.5 * across.y);
  if (smooth_) {
    quad(from - x - y, from - x + y, from + x + y, from + x - y);
    quad(to - x - y, to + x - y, to + x + y, to - x + y);
    quad(from + x - y, from + x + y, to + x + y, to + x - y);
    quad(from - x - y, to - x - y, to - x + y, from - x + y);
    quad(from - x + y, to - x + y, to + x + y, from + x + y);
    quad(from - x - y, from + x - y, to + x - y, to - x - y);
    return;
  }
  triangles_ += 12;
  const std::uint32_t v = vertex(from - x - y, {});
  for (const glm::dvec3& p :
       {from + x - y, from + x + y, from - x + y, to - x - y, to + x - y, to + x + y, to - x + y})
    vertex(p, {});
  constexpr std::array<glm::uvec3, 12> faces{{{0, 2, 1},
                                              {0, 3, 2},
                                              {4, 5, 6},
                                              {4, 6, 7},
                                              {1, 2, 6},
                                              {1, 6, 5},
                                              {0, 4, 7},
                                              {0, 7, 3},
                                              {3, 7, 6},
                                              {3, 6, 2},
                                              {0, 1, 5},
                                              {0, 5, 4}}};
  for (const glm::uvec3& t : faces) triangle(v + t.x, v + t.y, v + t.z);
}

std::uint32_t Shapes::ring(const glm::dvec3& centre, const Frame& frame, double radius, double slope,
                           int sides) {
  if (radius == 0.0) return vertex(centre, frame.z * (slope > 0.0 ? -1.0 : 1.0));
  const auto first = static_cast<std::uint32_t>(mesh_->vertices.size());
  for (int i = 0; i < sides; ++i) {
    const double angle = full_turn * i / sides;
    const glm::dvec3 outward = frame.x * std::cos(angle) + frame.y * std::sin(angle);
    vertex(centre + outward * radius, glm::normalize(outward - frame.z * slope));
  }
  return first;
}

void Shapes::join(std::uint32_t lower, bool lower_is_point, std::uint32_t upper, bool upper_is_point,
                  int sides) {
  for (int i = 0; i < sides; ++i) {
    const auto here = static_cast<std::uint32_t>(i);
    const auto next = static_cast<std::uint32_t>((i + 1) % sides);
    if (!lower_is_point) triangle(lower + here, lower + next, upper_is_point ? upper : upper + next);
    if (!upper_is_point) triangle(lower_is_point ? lower : lower + here, upper + next, upper + here);
  }
}

void Shapes::tube(std::span<const glm::dvec3> path, std::span<const double> radii, int sides, Ends ends) {
  const auto count = static_cast<std::size_t>(sides);
  const std::size_t last = path.size() - 1;
  for (std::size_t i = 0; i < last; ++i)
    triangles_ += count * ((radii[i] > 0.0 ? 1U : 0U) + (radii[i + 1] > 0.0 ? 1U : 0U));
  const bool close_first = ends == Ends::closed && radii[0] > 0.0;
  const bool close_last = ends == Ends::closed && radii[last] > 0.0;
  triangles_ += count * ((close_first ? 1U : 0U) + (close_last ? 1U : 0U));
  if (!mesh_) return;
  Frame frame = Frame::along(path[1] - path[0]);
  const auto cap = [&](std::size_t at, const glm::dvec3& outward) {
    const auto first = static_cast<std::uint32_t>(mesh_->vertices.size());
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = full_turn * static_cast<double>(i) / sides;
      vertex(path[at] + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * radii[at], outward);
    }
    const std::uint32_t middle = vertex(path[at], outward);
    if (at == 0)
      join(middle, true, first, false, sides);
    else
      join(first, false, middle, true, sides);
  };
  if (close_first) cap(0, -frame.z);
  std::uint32_t before = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const glm::dvec3 way = path[std::min(i + 1, last)] - path[i == 0 ? 0 : i - 1];
    frame = frame.turned(unit_or(way, frame.z));
    const double slope =
        (radii[std::min(i + 1, last)] - radii[i == 0 ? 0 : i - 1]) / std::max(glm::length(way), 1e-9);
    const std::uint32_t here = ring(path[i], frame, radii[i], slope, sides);
    if (i > 0) join(before, radii[i - 1] == 0.0, here, radii[i] == 0.0, sides);
    before = here;
  }
  if (close_last) cap(last, frame.z);
}

void Shapes::rod(const glm::dvec3& from, const glm::dvec3& to, double radius, int sides, Ends ends) {
  tube(std::array{from, to}, std::array{radius, radius}, sides, ends);
}

void Shapes::turned(const glm::dvec3& base, const glm::dvec3& axis, std::span<const glm::dvec2> profile,
                    int sides) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    triangles_ += static_cast<std::size_t>(sides) *
                  ((profile[i].x > 0.0 ? 1U : 0U) + (profile[i + 1].x > 0.0 ? 1U : 0U));
  if (!mesh_) return;
  const Frame frame = Frame::along(axis);
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const glm::dvec2 way = profile[std::min(i + 1, profile.size() - 1)] - profile[i == 0 ? 0 : i - 1];
    const double slope = way.x / (std::abs(way.y) > 1e-9 ? way.y : 1e-9);
    const std::uint32_t here = ring(base + frame.z * profile[i].y, frame, profile[i].x, slope, sides);
    if (i > 0) join(before, profile[i - 1].x == 0.0, here, profile[i].x == 0.0, sides);
    before = here;
  }
}

void Shapes::sheet(int columns, int rows, const std::function<glm::dvec3(double, double)>& point) {
  triangles_ += 2 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  if (!mesh_) return;
  const auto width = static_cast<std::size_t>(columns) + 1;
  std::vector<glm::dvec3> points;
  points.reserve(width * (static_cast<std::size_t>(rows) + 1));
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i)
      points.push_back(point(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  }
  const auto first = static_cast<std::uint32_t>(mesh_->vertices.size());
  const auto at = [&](int i, int j) {
    return points[static_cast<std::size_t>(std::clamp(j, 0, rows)) * width +
                  static_cast<std::size_t>(std::clamp(i, 0, columns))];
  };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const glm::dvec3 normal = glm::cross(at(i + 1, j) - at(i - 1, j), at(i, j + 1) - at(i, j - 1));
      vertex(at(i, j), unit_or(normal, {0, 1, 0}));
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto a = first + static_cast<std::uint32_t>(static_cast<std::size_t>(j) * width) +
                     static_cast<std::uint32_t>(i);
      const auto above = a + static_cast<std::uint32_t>(width);
      triangle(a, a + 1, above + 1);
      triangle(a, above + 1, above);
    }
  }
}

double detail_for(std::size_t wanted, const std::function<void(Shapes&, double)>& build) {
  double low = 1e-3;
  double high = 1e3;
  const auto count = [&](double detail) {
    Shapes counter;
    build(counter, detail);
    return counter.triangles();
  };
  // 24 halvings reduce a factor of 10^6 to one of 1 + 10^-6. A large detail is counted only if it is needed.
  while (high > 2.0 && count(std::sqrt(low * high)) > wanted) high = std::sqrt(low * high);
  for (int i = 0; i < 24; ++i) {
    const double middle = std::sqrt(low * high);
    (count(middle) <= wanted ? low : high) = middle;
  }
  return low;
}

int scaled(double count, double detail, int least) {
  return std::max(least, static_cast<int>(std::lround(count * detail)));
}

}  // namespace hitpipe::ref
