// The shapes that built-in scenes are made of. First the triangles of a scene are only counted, at several
// details, until their number is the wanted one. Then the scene is built; both steps run the same code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// Three vectors at right angles.
struct Frame {
  glm::dvec3 x, y, z;

  /// Unit vectors; z along `direction`, which is not zero.
  [[nodiscard]] static Frame along(const glm::dvec3& direction);
  /// Turned so that z is the unit vector `direction`, with as little twist as possible.
  [[nodiscard]] Frame turned(const glm::dvec3& direction) const;
};

enum class Ends : std::uint8_t { open, closed };

class Shapes {
 public:
  enum class Normals : std::uint8_t { flat, smooth };

  /// This constructor makes it only count.
  Shapes() = default;
  /// Adds triangles to `mesh`, each with a material.
  Shapes(Mesh& mesh, Normals normals) : mesh_(&mesh), smooth_(normals == Normals::smooth) {}

  [[nodiscard]] std::size_t triangles() const { return triangles_; }
  /// The material of what is added from now on.
  void material(std::uint8_t index) { material_ = index; }

  /// Four corners in a plane, in order; counter-clockwise seen from outside.
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);
  void box(const glm::dvec3& low, const glm::dvec3& high);
  /// A box along from-to; `across` is its full width to the side and upward.
  void bar(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec2& across);
  /// A tube along a path of at least two points; a radius of 0 at an end makes it a point.
  void tube(std::span<const glm::dvec3> path, std::span<const double> radii, int sides, Ends ends);
  void rod(const glm::dvec3& from, const glm::dvec3& to, double radius, int sides, Ends ends = Ends::open);
  /// Profile points (radius, height) turned about a line; only the ends may have a radius of 0.
  void turned(const glm::dvec3& base, const glm::dvec3& axis, std::span<const glm::dvec2> profile, int sides);
  /// A sheet over columns x rows cells; point(u, v), u and v in [0, 1].
  void sheet(int columns, int rows, const std::function<glm::dvec3(double, double)>& point);

 private:
  std::uint32_t vertex(const glm::dvec3& p, const glm::dvec3& normal);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// Joins two rings of `sides` vertices; a ring of one vertex is a point.
  void join(std::uint32_t lower, bool lower_is_point, std::uint32_t upper, bool upper_is_point, int sides);
  std::uint32_t ring(const glm::dvec3& centre, const Frame& frame, double radius, double slope, int sides);

  Mesh* mesh_ = nullptr;
  bool smooth_ = false;
  std::uint8_t material_ = 0;
  std::size_t triangles_ = 0;
};

/// The detail, 1/1000 to 1000, at which a scene has about `wanted` triangles. build(shapes, detail) adds the
/// scene; a greater detail has more triangles.
[[nodiscard]] double detail_for(std::size_t wanted, const std::function<void(Shapes&, double)>& build);

/// round(count * detail), at least `least`.
[[nodiscard]] int scaled(double count, double detail, int least = 1);

}  // namespace hitpipe::ref
