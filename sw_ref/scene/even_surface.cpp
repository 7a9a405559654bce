#include "sw_ref/scene/even_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace hitpipe::ref {

EvenSurface::EvenSurface(std::function<glm::dvec3(double, double)> point) : point_(std::move(point)) {
  constexpr int sides = 64;
  std::vector<glm::dvec3> before;
  for (int i = 0; i <= samples; ++i) {
    std::vector<glm::dvec3> row;
    for (int k = 0; k < sides; ++k)
      row.push_back(point_(static_cast<double>(k) / sides, static_cast<double>(i) / samples));
    double girth = 0.0;
    double step = 0.0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      girth += glm::distance(row[k], row[(k + 1) % row.size()]);
      if (i > 0) step += glm::distance(row[k], before[k]) / sides;
    }
    if (i > 0) area_ += step * 0.5 * (girth + girths_.back());
    along_.push_back(i > 0 ? along_.back() + step : 0.0);
    girths_.push_back(girth);
    before = std::move(row);
  }
}

std::vector<double> EvenSurface::rows(double edge) const {
  constexpr double height = 0.866;  // of an equilateral triangle of edge 1
  const int count = std::max(2, static_cast<int>(along_.back() / (edge * height)));
  std::vector<double> v{0.0};
  std::size_t i = 0;
  for (int row = 1; row < count; ++row) {
    const double wanted = along_.back() * row / count;
    while (along_[i + 1] < wanted) ++i;
    const double part = (wanted - along_[i]) / (along_[i + 1] - along_[i]);
    v.push_back((static_cast<double>(i) + part) / samples);
  }
  v.push_back(1.0);
  return v;
}

std::uint32_t EvenSurface::around(double v, double edge) const {
  if (v == 0.0 || v == 1.0) return 1;
  const auto i = static_cast<std::size_t>(v * samples);
  const double part = v * samples - static_cast<double>(i);
  const double girth = girths_[i] + part * (girths_[i + 1] - girths_[i]);
  return static_cast<std::uint32_t>(std::max(3.0, girth / edge));
}

std::size_t EvenSurface::triangles(double edge) const {
  std::size_t total = 0;
  for (const double v : rows(edge)) total += around(v, edge) == 1 ? 0 : 2 * std::size_t{around(v, edge)};
  return total;
}

void EvenSurface::append(Mesh& mesh, double edge, std::uint8_t material) const {
  std::uint32_t before = 0;
  std::uint32_t before_count = 0;
  for (const double v : rows(edge)) {
    const auto here = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::uint32_t count = around(v, edge);
    for (std::uint32_t k = 0; k < count; ++k)
      mesh.vertices.emplace_back(point_(static_cast<double>(k) / count, v));
    // The next triangle starts from the row that has advanced less far around.
    const auto join = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh.triangles.emplace_back(a, b, c);
      mesh.materials.push_back(material);
    };
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    const std::uint32_t low_count = before_count == 1 ? 0 : before_count;
    const std::uint32_t high_count = count == 1 ? 0 : count;
    while (before_count > 0 && (low < low_count || high < high_count)) {
      const bool on_low =
          high == high_count ||
          (low < low_count && std::uint64_t{low + 1} * count <= std::uint64_t{high + 1} * before_count);
      if (on_low) {
        join(before + (low + 1) % before_count, before + low, here + high % count);
        ++low;
      } else {
        join(here + (high + 1) % count, before + low % before_count, here + high);
        ++high;
      }
    }
    before = here;
    before_count = count;
  }
}

}  // namespace hitpipe::ref
