// Hierarchies to encode, and what every encoding of one must keep: its nodes, their counts and pointers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rays/tree/bvh.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref::hierarchies {

using adversary::Random;

inline constexpr std::uint64_t seed = 20052;

inline glm::vec3 point(Random& random, float range) {
  // One after the other: compilers evaluate arguments in orders of their own.
  const float z = random.signed_unit();
  const float y = random.signed_unit();
  return glm::vec3(random.signed_unit(), y, z) * range;
}

inline void add(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// Small triangles near spheres.
inline Mesh spheres(Random& random) {
  Mesh mesh;
  for (int sphere = 0; sphere < 10; ++sphere) {
    const glm::vec3 centre = point(random, 0.7F);
    for (int i = 0; i < 400; ++i) {
      glm::vec3 on = point(random, 1);
      on *= 0.25F / std::sqrt(on.x * on.x + on.y * on.y + on.z * on.z);
      const glm::vec3 at = centre + on;
      const glm::vec3 c = at + point(random, 0.02F);
      const glm::vec3 b = at + point(random, 0.02F);
      add(mesh, at, b, c);
    }
  }
  return mesh;
}

/// In a plane of constant y, and some on a line: sides of zero width when boxes are not padded.
inline Mesh flat(Random& random) {
  Mesh mesh;
  const auto in_plane = [&] {
    const float z = random.signed_unit();
    return glm::vec3(random.signed_unit(), 0.3F, z);
  };
  const auto on_line = [&] { return glm::vec3(-0.7F, random.signed_unit(), 1e-30F); };
  const auto add_three = [&](const auto& corner) {
    const glm::vec3 c = corner();
    const glm::vec3 b = corner();
    add(mesh, corner(), b, c);
  };
  for (int i = 0; i < 1000; ++i) add_three(in_plane);
  for (int i = 0; i < 200; ++i) add_three(on_line);
  return mesh;
}

/// Each triangle is half as far from a corner of the cube as the one before, so the hierarchy is as deep as
/// possible.
inline Mesh deep(Random& random) {
  Mesh mesh;
  for (int i = 0; i < 120; ++i) {
    const glm::vec3 at = glm::vec3(-1) + std::ldexp(1.0F, -i / 3) * glm::vec3(1);
    const float size = std::ldexp(1.0F, -i / 3 - 2);
    add(mesh, at, at + point(random, size) * 0.5F, at + glm::vec3(0, size, 0) * 0.5F);
  }
  for (int i = 0; i < 120; ++i) {
    const float small = std::ldexp(1.0F, -i);
    add(mesh, {small, 0, 0}, {0, small, 0}, {0, 0, small});
  }
  return mesh;
}

struct Sample {
  const char* name;
  Mesh (*make)(Random& random);
  BuildOptions options;
};

inline BuildOptions options(int max_triangles, float padding, float min_split) {
  BuildOptions chosen;
  chosen.max_triangles = max_triangles;
  chosen.padding = padding;
  chosen.min_split = min_split;
  return chosen;
}

inline const std::vector<Sample>& samples() {
  static const std::vector<Sample> all{{"spheres", spheres, {}},
                                       {"spheres, single triangles", spheres, options(1, 5e-7F, 1e-6F)},
                                       {"flat", flat, {}},
                                       {"flat, not padded", flat, options(2, 0, 0)},
                                       {"deep", deep, options(1, 5e-7F, 1e-6F)},
                                       {"deep, not padded", deep, options(1, 0, 0)}};
  return all;
}

inline Bvh built(const Sample& sample) {
  Random random(seed);
  return build_bvh(sample.make(random), sample.options);
}

inline std::string describe(const Aabb& box) {
  return fmt::format("({:a}, {:a}, {:a}) to ({:a}, {:a}, {:a})", box.min.x, box.min.y, box.min.z, box.max.x,
                     box.max.y, box.max.z);
}

/// Calls visit(node) for every node, parents first.
template <class Store>
void walk(const Store& store, const std::function<void(const typename Store::Node&)>& visit) {
  std::vector<typename Store::Node> pending{store.root()};
  while (!pending.empty()) {
    const auto node = pending.back();
    pending.pop_back();
    visit(node);
    if (store.count(node) > 0) continue;
    for (unsigned which = 0; which < 2; ++which) pending.push_back(store.child(node, which));
  }
}

/// Checks that every node occurs once, with its count and pointer; returns the number of nodes.
template <class Store>
std::size_t expect_same_tree(const Store& store, const Bvh& bvh) {
  std::vector<bool> seen(bvh.nodes.size());
  walk(store, [&](const typename Store::Node& node) {
    const std::uint32_t index = store.index(node);
    ASSERT_LT(index, seen.size());
    EXPECT_FALSE(seen[index]);
    seen[index] = true;
    EXPECT_EQ(store.count(node), bvh.nodes[index].count);
    EXPECT_EQ(store.first(node), bvh.nodes[index].first);
  });
  EXPECT_EQ(store.size(), bvh.nodes.size());
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
}

/// The message of the exception.
template <class Exception>
std::string refusal(const std::function<void()>& encode) {
  try {
    encode();
  } catch (const Exception& error) {
    return error.what();
  }
  return "accepted";
}

template <class Store>
std::string refusal_of(const Bvh& bvh) {
  return refusal<std::invalid_argument>([&] { const Store store(bvh); });
}

inline Bvh one_leaf(std::int32_t count) {
  Bvh bvh;
  bvh.nodes.push_back({{glm::vec3(-0.5F), glm::vec3(0.5F)}, count, 0});
  return bvh;
}

}  // namespace hitpipe::ref::hierarchies
