// Meshes for the builders, from a few triangles at known places to a hilly sheet that several threads share.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// One small triangle, 0.01 wide along each axis, with its box centred at each point.
inline Mesh triangles_at(const std::vector<glm::vec3>& centres, float half = 0.005F) {
  Mesh mesh;
  for (const glm::vec3& c : centres) {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(c - half);
    mesh.vertices.push_back(c + glm::vec3(half, half, -half));
    mesh.vertices.push_back(c + half);
    mesh.triangles.emplace_back(base, base + 1, base + 2);
  }
  return mesh;
}

constexpr unsigned soup_seed = 43;

inline float random_coordinate(std::mt19937& random) {
  return static_cast<float>(random() >> 8U) * 0x1p-23F - 1.0F;
}

/// Random triangles of at most `size`, all over the cube.
inline Mesh soup(std::uint32_t triangles, float size) {
  std::mt19937 random(soup_seed);
  Mesh mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const auto point = [&](float range) {
      const float x = random_coordinate(random);
      const float y = random_coordinate(random);
      return glm::vec3(x, y, random_coordinate(random)) * range;
    };
    const glm::vec3 centre = point(0.9F);
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(centre + point(size));
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

/// A sheet of side x side cells of two triangles; flat unless `height` is more than 0.
inline Mesh hills(std::uint32_t side, float height) {
  Mesh mesh;
  for (std::uint32_t row = 0; row <= side; ++row) {
    for (std::uint32_t column = 0; column <= side; ++column) {
      const float x = static_cast<float>(column) * 1.8F / static_cast<float>(side) - 0.9F;
      const float z = static_cast<float>(row) * 1.8F / static_cast<float>(side) - 0.9F;
      const float wave = std::sin(7.0F * x + 3.0F * z) + 0.3F * std::sin(31.0F * z * x);
      mesh.vertices.emplace_back(x, height * wave, z);
    }
  }
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const std::uint32_t here = row * (side + 1) + column;
      mesh.triangles.emplace_back(here, here + 1, here + side + 1);
      mesh.triangles.emplace_back(here + 1, here + side + 2, here + side + 1);
    }
  }
  return mesh;
}

/// Copies of one triangle.
inline Mesh coincident(std::uint32_t triangles) {
  Mesh mesh;
  mesh.vertices = {{-0.5F, 0.1F, 0.2F}, {0.6F, 0.1F, 0.3F}, {0.1F, 0.7F, -0.4F}};
  mesh.triangles.assign(triangles, {0, 1, 2});
  return mesh;
}

/// Triangles of many sizes whose boxes have one centre.
inline Mesh concentric(std::uint32_t triangles) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const float half = static_cast<float>(i + 1) / static_cast<float>(triangles);
    mesh.vertices.insert(mesh.vertices.end(),
                         {{-half, half, -half}, {half, -half, -half}, {-half, -half, half}});
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

}  // namespace hitpipe::ref
