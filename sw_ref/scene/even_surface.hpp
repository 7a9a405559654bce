// A closed surface cut into triangles of about one size. Rows of vertices run around it, from pole to pole.
// The number of vertices of a row depends on its length, so neighbouring rows can differ; triangles join
// them.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

class EvenSurface {
 public:
  /// point(u, v): u in [0, 1) goes around, clockwise seen from the end; v in [0, 1] goes from pole to pole,
  /// where u does not matter. Triangles are then counter-clockwise seen from outside.
  explicit EvenSurface(std::function<glm::dvec3(double, double)> point);

  [[nodiscard]] double area() const { return area_; }
  /// Triangles with edges of about this length.
  [[nodiscard]] std::size_t triangles(double edge) const;
  void append(Mesh& mesh, double edge, std::uint8_t material) const;

 private:
  static constexpr int samples = 256;  // along v; 64 around

  [[nodiscard]] std::vector<double> rows(double edge) const;
  [[nodiscard]] std::uint32_t around(double v, double edge) const;

  std::function<glm::dvec3(double, double)> point_;
  std::vector<double> along_;   ///< mean length from the first pole to v = i / samples
  std::vector<double> girths_;  ///< length around at v = i / samples
  double area_ = 0.0;
};

}  // namespace hitpipe::ref
