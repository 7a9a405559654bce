// The built-in scenes at their smallest: they keep the promises of their table and have the same bits every
// time.
#include "sw_ref/scene/built_in.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/figure.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref::built_in_test {
namespace {

/// FNV-1a over the bits of vertices, indices and materials.
std::uint64_t hash(const Mesh& mesh) {
  std::uint64_t h = 0xCBF29CE484222325U;
  const auto add = [&](std::uint32_t word) { h = (h ^ word) * 0x100000001B3U; };
  for (const glm::vec3& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) add(std::bit_cast<std::uint32_t>(v[k]));
  }
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) add(t[k]);
  }
  for (const std::uint8_t material : mesh.materials) add(material);
  return h;
}

struct Small {
  const char* name;
  std::uint64_t hash;
};

class BuiltIn : public testing::TestWithParam<Small> {};

TEST_P(BuiltIn, IsWhatItsTablePromises) {
  const BuiltInScene& promised = *find_built_in(GetParam().name);
  const SceneDescription described =
      make_built_in(promised.name, promised.scales() ? std::optional(promised.least) : std::nullopt);
  const Mesh made = promised.make(promised.least).mesh;
  EXPECT_EQ(hash(made), GetParam().hash) << std::hex << hash(made);
  const auto wanted = static_cast<double>(promised.least);
  EXPECT_NEAR(static_cast<double>(described.mesh.triangles.size()), wanted, 0.02 * wanted);
  const Scene scene = place(described);
  EXPECT_EQ(scene.name, promised.name);
  EXPECT_EQ(scene.stand_in_for, promised.stands_for);
  EXPECT_EQ(scene.lights.size(), static_cast<std::size_t>(promised.lights));
  EXPECT_EQ(scene.mesh.dropped.size(), 0U);
  ASSERT_EQ(scene.mesh.materials.size(), scene.mesh.triangles.size());
  EXPECT_LT(*std::max_element(scene.mesh.materials.begin(), scene.mesh.materials.end()),
            scene.materials.size());
  constexpr auto bound = static_cast<float>(cube_bound);
  for (const glm::vec3& v : scene.mesh.vertices)
    ASSERT_TRUE(std::abs(v.x) <= bound && std::abs(v.y) <= bound && std::abs(v.z) <= bound);
  for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i)
    ASSERT_TRUE(has_area(scene.mesh.corners(i))) << i;
  if (scene.mesh.normals.empty()) return;
  ASSERT_EQ(scene.mesh.normals.size(), scene.mesh.vertices.size());
  for (const glm::vec3& n : scene.mesh.normals) ASSERT_NEAR(glm::length(n), 1.0F, 1e-5F);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, BuiltIn,
    testing::Values(Small{"spheres", 0x765716A8890361C6}, Small{"branch", 0x02B351868AE5B2D3},
                    Small{"poppy", 0x46231E5A3665F8EC}, Small{"plant_front", 0x536EB96ED1BAFF75},
                    Small{"plant_north", 0x536EB96ED1BAFF75}, Small{"plant_boiler", 0x536EB96ED1BAFF75},
                    Small{"statue", 0x19385A9A4F16B5D2}, Small{"two_statues", 0x06BA5CAF1DDCE6F9},
                    Small{"plant_slice", 0x0ECD82323750C5CD}, Small{"waves", 0xD4B1C229A29C7609},
                    Small{"city", 0x761D6AE4C624BD71}, Small{"city_oblique", 0x761D6AE4C624BD71},
                    Small{"reading_room", 0x4FBBB262563A7AB3}, Small{"terrain", 0x4BA098A095EF2ABD}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(BuiltInScenes, HaveTheNumberOfTrianglesAskedFor) {
  for (const auto& [name, triangles] : {std::pair("branch", 150'000U),
                                        {"poppy", 60'000U},
                                        {"plant", 500'000U},
                                        {"statue", 33'333U},
                                        {"two_statues", 50'000U},
                                        {"waves", 20'000U},
                                        {"city", 140'000U},
                                        {"reading_room", 100'000U},
                                        {"terrain", 50'000U}}) {
    const std::size_t count = make_built_in(name, triangles).mesh.triangles.size();
    EXPECT_NEAR(static_cast<double>(count), triangles, 0.02 * triangles) << name;
  }
}

TEST(BuiltInScenes, DefaultsAreWithinTheirRangesAndNamesDiffer) {
  std::map<std::string, int> names;
  for (const BuiltInScene& scene : built_in_scenes()) {
    EXPECT_LE(scene.least, scene.triangles) << scene.name;
    EXPECT_LE(scene.triangles, scene.most) << scene.name;
    EXPECT_EQ(++names[scene.name], 1) << scene.name;
  }
}

/// Each side of a triangle is also a side of exactly one other, in the opposite direction.
TEST(Statue, PartsAreClosedWithTheirOutsidesOut) {
  for (const EvenSurface& part : winged_figure()) {
    Mesh mesh;
    part.append(mesh, 0.02, 0);
    EXPECT_EQ(mesh.triangles.size(), part.triangles(0.02));
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    double volume = 0.0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const glm::uvec3& t = mesh.triangles[i];
      for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
      const Mesh::Corners c = mesh.corners(i);
      const glm::dvec3 a(mesh.vertices[0]);
      volume += glm::dot(glm::dvec3(c.a) - a, glm::cross(glm::dvec3(c.b) - a, glm::dvec3(c.c) - a)) / 6.0;
    }
    for (const auto& [side, count] : sides) {
      ASSERT_EQ(count, 1) << side.first << "-" << side.second;
      ASSERT_TRUE(sides.contains({side.second, side.first})) << side.first << "-" << side.second;
    }
    EXPECT_GT(volume, 0.0) << mesh.triangles.size();
  }
}

TEST(Statue, TrianglesAreOfOneSize) {
  const Mesh mesh = statue(40'000).mesh;
  std::vector<double> areas;
  for (std::uint32_t i = 4; i < mesh.triangles.size(); ++i) {
    const Mesh::Corners c = mesh.corners(i);
    areas.push_back(0.5 * glm::length(glm::cross(glm::dvec3(c.b - c.a), glm::dvec3(c.c - c.a))));
  }
  std::sort(areas.begin(), areas.end());
  EXPECT_LT(areas[areas.size() * 9 / 10], 4.0 * areas[areas.size() / 10]);
}

TEST(PlantSlice, IsNarrowWithItsEyeAndLight) {
  const Scene scene = load_scene("plant_slice");
  constexpr float reach = 0x1p-5F;
  for (const glm::vec3& v : scene.mesh.vertices) ASSERT_LT(std::abs(v.z), reach);
  EXPECT_LT(std::abs(scene.camera.eye.z), reach);
  for (const Light& light : scene.lights) EXPECT_LT(std::abs(light.position.z), reach);
  for (const glm::uvec3& t : scene.mesh.triangles)
    for (int k = 0; k < 3; ++k) ASSERT_LT(t[k], scene.mesh.vertices.size());
}

TEST(BuiltInScenes, NumbersOfTrianglesTheyCannotHaveRejected) {
  EXPECT_EQ(message_of<std::exception>([] { return make_built_in("branch", 79'999); }),
            "scene \"branch\": 79999 triangles; allowed are 80000 to 10000000");
  EXPECT_EQ(message_of<std::exception>([] { return make_built_in("statue", 50'000'001); }),
            "scene \"statue\": 50000001 triangles; allowed are 10000 to 50000000");
  EXPECT_EQ(message_of<std::exception>([] { return make_built_in("spheres", 24'578); }),
            "scene \"spheres\": has 24578 triangles; their number can be chosen for: " + scaling_names());
}

}  // namespace
}  // namespace hitpipe::ref::built_in_test
