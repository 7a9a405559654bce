// Meshes and rays for tests of scenes, and all that a scene answers.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <hitpipe/scene.hpp>

namespace hitpipe::scenes {

struct Shape {
  std::vector<Point> corners;
  std::vector<TriangleCorners> triangles;

  [[nodiscard]] Scene scene(const SceneOptions& options = {}) const { return {corners, triangles, options}; }
};

/// From 0 to `side` on each axis, counter-clockwise from outside. Corner i has the bits of i as x, y, z.
inline Shape cube(float side = 1) {
  Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.corners.push_back({(i & 1U) != 0 ? side : 0, (i & 2U) != 0 ? side : 0, (i & 4U) != 0 ? side : 0});
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

/// Random triangles, many of them small, with some that share corners.
inline Shape soup(std::uint32_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(random() >> 8U) * 0x1p-23F - 1.0F; };
  Shape shape;
  for (std::uint32_t i = 0; i < count; ++i) {
    Point middle;
    for (float& x : middle) x = 0.8F * number();
    for (int corner = 0; corner < 3; ++corner) {
      Point at = middle;
      for (float& x : at) x += 0.15F * number();
      shape.corners.push_back(at);
    }
    shape.triangles.push_back({3 * i, 3 * i + 1, i % 5 == 4 ? 3 * i - 1 : 3 * i + 2});
  }
  return shape;
}

inline std::vector<Ray> random_rays(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(random() >> 8U) * 0x1p-23F - 1.0F; };
  std::vector<Ray> rays(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (float& x : rays[i].origin) x = 0.95F * number();
    for (float& x : rays[i].direction) x = number();
    if (i % 7 == 0) rays[i].direction[i % 3] = 0;
    rays[i].length = i % 4 == 0 ? std::fabs(number()) : endless;
  }
  return rays;
}

inline const char* const worlds[] = {"float", "20+1s20"};

/// All that a scene answers, as bytes.
inline std::string all_answers(const Scene& scene, int threads) {
  const std::vector<Ray> rays = random_rays(5'000, 3);
  std::string bytes;
  const auto add = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
  };
  const Nearest nearest = scene.nearest(rays, true, threads);
  add(nearest.triangle);
  add(nearest.t);
  add(nearest.weights);
  add(scene.any(rays, threads));
  const Counts counts = scene.count(rays, threads);
  add(counts.crossings);
  add(counts.sides);
  const Crossings all = scene.all(rays, threads);
  add(all.offsets);
  add(all.triangle);
  add(all.t);
  add(all.side);
  return bytes;
}

}  // namespace hitpipe::scenes
