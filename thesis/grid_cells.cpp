// Section 8.2: a uniform grid traversed by side relations. A ray that ascends in x, y, z leaves its cell by
// one of three faces. Which one, the side relations of the ray and the edges between these faces say: two of
// them for each step. Beside it the usual way (Amanatides and Woo 1987), which compares distances.
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "sw_ref/render/recording.hpp"
#include "thesis/proposals.hpp"

namespace hitpipe::thesis {
namespace {

constexpr int cells_across = 64;  // on each axis
constexpr std::array side_bits{16, 20, 24};

using Cell = std::array<int, 3>;

/// A ray inside the grid: positions in cells, 0..64, mirrored so that every component ascends.
struct GridRay {
  glm::dvec3 origin{};
  glm::dvec3 direction{};
};

GridRay in_grid(const Ray& ray) {
  GridRay made;
  for (int axis = 0; axis < 3; ++axis) {
    const bool backward = std::signbit(ray.direction[axis]);
    made.direction[axis] = std::abs(double{ray.direction[axis]});
    made.origin[axis] =
        (1.0 + (backward ? -double{ray.origin[axis]} : double{ray.origin[axis]})) * cells_across / 2;
  }
  return made;
}

Cell first_cell(const GridRay& ray) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis)
    cell.at(static_cast<std::size_t>(axis)) = std::min(cells_across - 1, static_cast<int>(ray.origin[axis]));
  return cell;
}

/// Walks to the end of the grid; choose(cell) gives the axis of the next face.
template <class Choose>
std::vector<int> walk(const GridRay& ray, Choose choose) {
  std::vector<int> steps;
  for (Cell cell = first_cell(ray);;) {
    const int axis = choose(cell);
    steps.push_back(axis);
    if (++cell.at(static_cast<std::size_t>(axis)) >= cells_across) return steps;
  }
}

/// Whether the ray reaches the upper face of axis `a` before the upper face of axis `b`: the side on which it
/// passes the edge between them.
template <class T>
bool first_at(const glm::vec<3, T>& to_face, const glm::vec<3, T>& direction, int a, int b) {
  return to_face[a] * direction[b] < to_face[b] * direction[a];
}

template <class T>
int face_by_sides(const glm::vec<3, T>& to_face, const glm::vec<3, T>& direction) {
  const int ahead = first_at(to_face, direction, 1, 0) ? 1 : 0;
  return first_at(to_face, direction, 2, ahead) ? 2 : ahead;
}

template <class T>
std::vector<int> by_sides(const GridRay& ray, const glm::vec<3, T>& origin, const glm::vec<3, T>& direction,
                          T cell_side) {
  return walk(ray, [&](const Cell& cell) {
    glm::vec<3, T> to_face;
    for (int axis = 0; axis < 3; ++axis)
      to_face[axis] = static_cast<T>(cell.at(static_cast<std::size_t>(axis)) + 1) * cell_side - origin[axis];
    return face_by_sides(to_face, direction);
  });
}

/// n-bit origins and directions, as the integer Pluecker unit has them; the products are exact.
std::vector<int> by_integer_sides(const GridRay& ray, int bits) {
  const auto largest = static_cast<double>((std::int64_t{1} << (bits - 1)) - 1);
  const auto cell_side = std::int64_t{1} << (bits - 1 - 6);
  const double longest = std::max({ray.direction.x, ray.direction.y, ray.direction.z});
  glm::vec<3, std::int64_t> origin;
  glm::vec<3, std::int64_t> direction;
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = std::llround(ray.origin[axis] * static_cast<double>(cell_side));
    direction[axis] = std::llround(ray.direction[axis] / longest * largest);
  }
  return by_sides<std::int64_t>(ray, origin, direction, cell_side);
}

std::vector<int> by_distances(const GridRay& ray) {
  std::array<float, 3> next{};
  std::array<float, 3> step{};
  const Cell cell = first_cell(ray);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    step.at(i) = 1.0F / static_cast<float>(ray.direction[axis]);
    const float to_face = static_cast<float>(cell.at(i) + 1) - static_cast<float>(ray.origin[axis]);
    next.at(i) = ray.direction[axis] == 0 ? Ray::infinite : to_face * step.at(i);
  }
  return walk(ray, [&](const Cell&) {
    const std::size_t ahead = next[1] < next[0] ? 1 : 0;
    const std::size_t axis = next[2] < next.at(ahead) ? 2 : ahead;
    next.at(axis) += step.at(axis);
    return static_cast<int>(axis);
  });
}

/// Rays whose cells differ from the exact ones, of all, and the steps of a ray.
struct Cells {
  double rays = 0;
  double steps = 0;
  double by_distances = 0;
  std::array<double, side_bits.size()> by_sides{};
};

Cells measure_cells(const std::vector<RecordedBatch>& batches) {
  Cells all;
  for (const RecordedBatch& batch : batches) {
    for (const Ray& recorded : batch.rays) {
      const GridRay ray = in_grid(recorded);
      // A side relation of binary32 values in double is off by 2^-53 of its terms: exact enough to compare
      // with.
      const std::vector<int> exact = by_sides<double>(ray, ray.origin, ray.direction, 1.0);
      all.rays += 1;
      all.steps += static_cast<double>(exact.size());
      all.by_distances += by_distances(ray) == exact ? 0 : 1;
      for (std::size_t i = 0; i < side_bits.size(); ++i)
        all.by_sides.at(i) += by_integer_sides(ray, side_bits.at(i)) == exact ? 0 : 1;
    }
  }
  return all;
}

}  // namespace

ResultTable grid_cells(std::string_view number, const ExperimentOptions& options) {
  ResultTable table;
  table.number = number;
  table.title = fmt::format(
      "Grid of {0} x {0} x {0} cells: % of rays that walk other cells than the exact ray", cells_across);
  table.labels = {"scene"};
  table.columns = {{"steps_per_ray", 1}, {"fp32_distances", 2}};
  for (const int bits : side_bits) table.columns.push_back({fmt::format("sides_{}", bits), 2});
  const std::vector<std::string> scenes = proposal_scenes(number, options);
  for (const std::string& name : scenes) {
    const Scene scene = proposal_scene(name, options);
    const Cells of =
        measure_cells(record_rays(scene, build_bvh(scene.mesh), options.width, options.height, 1));
    ResultRow row{.labels = {name},
                  .ours = {of.steps / of.rays, 100 * of.by_distances / of.rays},
                  .printed = std::vector<std::optional<double>>(table.columns.size())};
    row.intervals.resize(table.columns.size());
    const auto interval = [&](double wrong) {
      const Interval share =
          wilson_interval(static_cast<std::uint64_t>(wrong), static_cast<std::uint64_t>(of.rays));
      return Interval{100 * share.low, 100 * share.high};
    };
    row.intervals[1] = interval(of.by_distances);
    for (std::size_t i = 0; i < side_bits.size(); ++i) {
      row.ours.emplace_back(100 * of.by_sides.at(i) / of.rays);
      row.intervals[i + 2] = interval(of.by_sides.at(i));
    }
    table.rows.push_back(std::move(row));
    options.progress(static_cast<double>(&name - scenes.data() + 1) / static_cast<double>(scenes.size()));
  }
  table.notes = {fmt::format("{} x {} pixels, all rays, from their start to the end of the grid",
                             options.width, options.height),
                 "fp32_distances: the way of Amanatides and Woo. sides_n: side relations with n-bit origins "
                 "and directions, "
                 "products exact",
                 "a step takes two comparisons and an addition by distances. By side relations it takes two "
                 "signs and two "
                 "additions of 2n bits, or four products if nothing is carried over"};
  return table;
}

}  // namespace hitpipe::thesis
