// Meshes and instances of glTF: flattened they are the mesh of the file, and one message for each fault.
#include "rays/files/gltf_instances.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "rays/files/mesh_file.hpp"
#include "tests/rays/files/gltf_files.hpp"

namespace hitpipe::ref::gltf_instances_test {
namespace {

using nlohmann::json;
using Triangle = SourceMesh::Corners;

/// All triangles of all instances, where they are.
std::vector<Triangle> flattened(const OwnInstances& own) {
  std::vector<Triangle> all;
  for (const OwnInstance& instance : own.instances) {
    const SourceMesh& mesh = own.meshes.at(instance.mesh);
    EXPECT_TRUE(mesh.dropped.empty());
    const bool mirrors = glm::determinant(instance.linear) < 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto [a, b, c] = mesh.corners(i);
      const auto moved = [&](const glm::dvec3& p) { return instance.linear * p + instance.move; };
      all.push_back({moved(a), moved(mirrors ? c : b), moved(mirrors ? b : c)});
    }
  }
  return all;
}

OwnInstances instances(const json& file) {
  return load_instances(file.dump(), "m.gltf");
}
SourceMesh mesh_of(const json& file) {
  std::vector<MeshGroup> groups;
  return load_mesh(file.dump(), "m.gltf", groups);
}

/// Compares with load_mesh(), which has no triangles without area. `error` is what roundings may do.
void expect_same(const json& file, double error = 0) {
  const SourceMesh mesh = mesh_of(file);
  const std::vector<Triangle> all = flattened(instances(file));
  ASSERT_EQ(all.size(), mesh.triangles.size() + mesh.dropped.size());
  std::uint32_t kept = 0;
  std::size_t dropped = 0;
  for (std::uint32_t number = 0; number < all.size(); ++number) {
    if (dropped < mesh.dropped.size() && mesh.dropped[dropped] == number) {
      ++dropped;
      continue;
    }
    const Triangle other = mesh.corners(kept++);
    for (const auto& [a, b] : {std::pair(all[number].a, other.a), std::pair(all[number].b, other.b),
                               std::pair(all[number].c, other.c)})
      EXPECT_LE(glm::distance(a, b), error) << "triangle " << number;
  }
}

/// Two meshes in nodes above one another, some of which mirror. All numbers are dyadic.
json shared_gltf() {
  json file = square_gltf();
  json& meshes = file["meshes"];
  meshes.push_back(meshes[0]);
  meshes[1]["primitives"].push_back(meshes[0]["primitives"][0]);
  meshes[1]["primitives"][1]["mode"] = 5;  // with triangles that have no area
  file["nodes"] = json::parse(R"([
    {"mesh": 0, "translation": [1, 2, 3], "scale": [2, 2, 0.5], "children": [1, 2]},
    {"mesh": 1, "scale": [-1, 1, 1], "children": [3]},
    {"mesh": 0, "matrix": [0,2,0,0, -2,0,0,0, 0,0,2,0, 0.25,0,5,1]},
    {"mesh": 0, "rotation": [0, 0, 1, 0], "scale": [1, -4, 1]}, {"mesh": 1, "translation": [0, 0, 9]}])");
  file["scenes"][0]["nodes"] = {4, 0};
  return file;
}

/// The node 0 with instances: each attribute has the number of an accessor.
json& attributes_of(json& file) {
  return file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}
std::size_t add_vectors(json& file, const std::vector<float>& numbers, const std::string& type = "VEC3") {
  const std::size_t components = type == "VEC3" ? 3 : 4;
  return add_accessor(file, floats(numbers), 5126, static_cast<int>(numbers.size() / components), type);
}

/// Three instances below a node that turns, stretches and moves; one of them mirrors.
json instanced_gltf() {
  json file = square_gltf();
  file["nodes"] = json::parse(R"([{"mesh": 0, "translation": [0, 0, 1], "children": [1]}, {"mesh": 0},
    {"matrix": [0,2,0,0, -1,0,0,0, 0,0,4,0, 8,0,0,1], "children": [0]}])");
  file["scenes"][0]["nodes"] = {2};
  json& attributes = attributes_of(file);
  attributes["TRANSLATION"] = add_vectors(file, {1, 0, 0, 0, 0.5, 0, 0, 0, -2});
  attributes["ROTATION"] = add_vectors(file, {0, 0, 0, 1, 0, 0, 1, 0, 0.5, 0.5, 0.5, 0.5}, "VEC4");
  attributes["SCALE"] = add_vectors(file, {1, 1, 1, 1, -2, 1, 0.5, 4, 1});
  attributes["_ID"] = add_accessor(file, little<std::uint8_t>({7, 8, 9}), 5121, 3, "SCALAR");
  return file;
}

TEST(GltfInstances, NodesShareTheirMeshes) {
  const json file = shared_gltf();
  const OwnInstances own = instances(file);
  ASSERT_EQ(own.meshes.size(), 2U);
  EXPECT_EQ(own.meshes[0].triangles.size(), 6U);  // the node 4 comes first, with mesh 1
  EXPECT_EQ(own.meshes[1].triangles.size(), 2U);
  std::vector<std::uint32_t> numbers;
  for (const OwnInstance& instance : own.instances) {
    numbers.push_back(instance.mesh);
    EXPECT_EQ(instance.mask, 0xff);
  }
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{0, 1, 0, 1, 1}));
  EXPECT_EQ(own.instances[0].move, glm::dvec3(0, 0, 9));
  EXPECT_EQ(own.instances[4].linear, glm::dmat3({0, 4, 0}, {-4, 0, 0}, {0, 0, 1}));
  EXPECT_EQ(own.instances[4].move, glm::dvec3(1.5, 2, 5.5));
  expect_same(file);
}

TEST(GltfInstances, AreTheFlattenedMeshUpToRoundings) {
  json file = shared_gltf();
  file["nodes"][0]["rotation"] = {0.1, 0.5, -0.1, std::sqrt(0.73)};
  file["nodes"][3]["rotation"] = {0.6, 0, 0.8, 0};
  expect_same(file, 1e-14);
  json instanced = instanced_gltf();
  instanced["nodes"][2]["matrix"] = {0.3, 0.2, 0, 0, -0.7, 0.1, 0.9, 0, 1, 0, 0.9, 0, 0.1, 0.2, 0.3, 1};
  expect_same(instanced, 1e-14);
}

TEST(GltfInstances, MoveTheMeshBeforeTheNodeDoes) {
  const json file = instanced_gltf();
  const OwnInstances own = instances(file);
  EXPECT_EQ(own.meshes.size(), 1U);
  ASSERT_EQ(own.instances.size(), 4U);  // the child of the node is no instance
  EXPECT_EQ(own.instances[0].move, glm::dvec3(8, 2, 4));
  EXPECT_EQ(own.instances[1].linear, glm::dmat3({0, -2, 0}, {-2, 0, 0}, {0, 0, 4}));
  EXPECT_EQ(own.instances[1].move, glm::dvec3(7.5, 0, 4));
  EXPECT_EQ(own.instances[2].linear, glm::dmat3({-0.5, 0, 0}, {0, 0, 16}, {0, 2, 0}));
  EXPECT_EQ(own.instances[3].move, glm::dvec3(8, 0, 4));
  expect_same(file);
  EXPECT_EQ(mesh_of(file).triangles.size(), 8U);
  EXPECT_EQ(read(file).groups.size(), 4U);
}

TEST(GltfInstances, LieWhereNodesBelowTheNodeWouldLie) {
  const json file = instanced_gltf();
  json nodes = file;
  nodes["nodes"][0] = json::parse(R"({"translation": [0, 0, 1], "children": [3, 4, 5, 1]})");
  for (const char* const node :
       {R"({"mesh": 0, "translation": [1, 0, 0]})",
        R"({"mesh": 0, "translation": [0, 0.5, 0], "rotation": [0, 0, 1, 0], "scale": [1, -2, 1]})",
        R"({"mesh": 0, "translation": [0, 0, -2], "rotation": [0.5, 0.5, 0.5, 0.5], "scale": [0.5, 4, 1]})"})
    nodes["nodes"].push_back(json::parse(node));
  EXPECT_EQ(read(file).positions, read(nodes).positions);
  EXPECT_EQ(read(file).corners, read(nodes).corners);
}

TEST(GltfInstances, EachAttributeMayBeMissing) {
  for (const char* const name : {"TRANSLATION", "ROTATION", "SCALE", "_ID"}) {
    json file = instanced_gltf();
    json& attributes = attributes_of(file);
    attributes = {{name, attributes[name]}};
    EXPECT_EQ(instances(file).instances.size(), 4U) << name;
    expect_same(file);
    attributes_of(file)[name] = add_accessor(file, "", 5126, 0, name[0] == 'R' ? "VEC4" : "VEC3");
    EXPECT_EQ(instances(file).instances.size(), 1U) << name;
    expect_same(file);
  }
}

TEST(GltfInstances, RotationsMayBeNormalisedIntegers) {
  json file = instanced_gltf();
  const json with_floats = file;
  attributes_of(file)["ROTATION"] =
      add_accessor(file, little<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0, 64, 64, 64, 64}), 5120, 3, "VEC4");
  EXPECT_EQ(reason(file),
            "accessors[6]: is for ROTATION of instances; it must be VEC4, and 5126, or 5120 or 5122 and "
            "normalized");
  file["accessors"].back()["normalized"] = true;
  EXPECT_EQ(flattened(instances(file)).at(3).b, flattened(instances(with_floats)).at(3).b);
  expect_same(file);
  // Each byte is cut.
  attributes_of(file)["ROTATION"] =
      add_accessor(file, little<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0, 63, 63, 63, 63}), 5120, 3, "VEC4");
  file["accessors"].back()["normalized"] = true;
  expect_same(file);
  attributes_of(file)["ROTATION"] =
      add_accessor(file, little<std::int16_t>({0, 0, 0, 32767, 0, 0, -32767, 0, 16384, 16384, 16384, 16384}),
                   5122, 3, "VEC4");
  file["accessors"].back()["normalized"] = true;
  expect_same(file);
}

TEST(GltfInstances, BadAttributesAreRefused) {
  const std::string place = "nodes[0].extensions.EXT_mesh_gpu_instancing";
  const auto reason_of = [](const auto& damage) {
    json file = instanced_gltf();
    damage(file);
    const std::string why = reason(file);
    EXPECT_EQ(message_of([&] { static_cast<void>(instances(file)); }), "mesh file \"m.gltf\": " + why);
    return why;
  };
  EXPECT_EQ(reason_of([](json& file) { attributes_of(file) = json::object(); }),
            place + ".attributes: has no attribute; allowed are TRANSLATION, ROTATION and SCALE");
  EXPECT_EQ(reason_of([](json& file) { attributes_of(file) = 1; }), place + ".attributes: must be an object");
  EXPECT_EQ(reason_of([](json& file) {
              file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = json::object();
            }),
            place + ": needs the key \"attributes\"");
  EXPECT_EQ(reason_of([](json& file) { attributes_of(file)["SCALE"] = 99; }),
            place + ".attributes.SCALE: must be a whole number of 0 to 5");
  for (const char* const name : {"SCALE", "TRANSLATION", "_ID"})
    EXPECT_EQ(reason_of([&](json& file) {
                attributes_of(file)[name] = add_vectors(file, {1, 1, 1, 1, 1, 1});
              }),
              place + ".attributes." + name + ": has 2 elements; ROTATION has 3, and all must have as many");
  for (const char* const name : {"SCALE", "TRANSLATION"}) {
    const std::string line =
        std::string("accessors[6]: is for ") + name + " of instances; it must be VEC3 and 5126";
    EXPECT_EQ(reason_of([&](json& file) {
                attributes_of(file)[name] = add_vectors(file, std::vector<float>(12, 1), "VEC4");
              }),
              line);
    EXPECT_EQ(reason_of([&](json& file) {
                attributes_of(file)[name] =
                    add_accessor(file, little<std::uint32_t>(std::vector<std::uint32_t>(9)), 5125, 3, "VEC3");
              }),
              line);
  }
  EXPECT_EQ(reason_of([](json& file) {
              attributes_of(file)["ROTATION"] = add_vectors(file, std::vector<float>(9), "VEC3");
            }),
            "accessors[6]: is for ROTATION of instances; it must be VEC4, and 5126, or 5120 or 5122 and "
            "normalized");
  EXPECT_EQ(
      reason_of([](json& file) {
        attributes_of(file)["ROTATION"] = add_vectors(file, {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1}, "VEC4");
      }),
      "accessors[6]: instance 1 has a ROTATION of the length 0; a quaternion must have the length 1");
  const float infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(reason_of([&](json& file) {
              attributes_of(file)["TRANSLATION"] = add_vectors(file, {0, 0, 0, 0, 0, 0, 0, infinite, 0});
            }),
            "accessors[6]: instance 2 has the TRANSLATION (0, inf, 0); numbers must be finite");
  EXPECT_EQ(reason_of([](json& file) {
              file["skins"] = json::parse(R"([{"joints": [1]}])");
              file["nodes"][0]["skin"] = 0;
            }),
            place + ": the node has a skin; allowed are nodes without one");
}

TEST(GltfInstances, WeightsAndSkinsMakeMeshesOfTheirOwn) {
  json file = square_gltf();
  const std::size_t up = add_vectors(file, {0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4});
  json& primitive = file["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"POSITION", up}}};
  primitive["attributes"]["JOINTS_0"] = add_accessor(file, std::string(16, '\0'), 5121, 4, "VEC4");
  primitive["attributes"]["WEIGHTS_0"] =
      add_vectors(file, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  file["meshes"][0]["weights"] = {1};
  file["skins"] = json::parse(R"([{"joints": [4]}])");
  file["nodes"] = json::parse(R"([{"mesh": 0}, {"mesh": 0, "weights": [0.5], "translation": [1, 0, 0]},
    {"mesh": 0, "weights": [1], "translation": [2, 0, 0]}, {"mesh": 0, "skin": 0, "translation": [3, 0, 0]},
    {"translation": [0, 8, 0], "scale": [-1, 1, 1]}, {"mesh": 0, "weights": [0.5]}])");
  file["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
  const OwnInstances own = instances(file);
  std::vector<std::uint32_t> numbers;
  for (const OwnInstance& instance : own.instances) numbers.push_back(instance.mesh);
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{0, 1, 0, 2, 1}));
  EXPECT_EQ(own.meshes.size(), 3U);
  EXPECT_EQ(own.instances[3].move, glm::dvec3(0));
  expect_same(file);
}

TEST(GltfInstances, OtherFormatsAreOneInstance) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 1 2\nf 1 2 3 4\n";
  const OwnInstances own = load_instances(obj, "m.obj");
  ASSERT_EQ(own.meshes.size(), 1U);
  ASSERT_EQ(own.instances.size(), 1U);
  EXPECT_EQ(own.instances[0].linear, glm::dmat3(1.0));
  EXPECT_EQ(own.instances[0].move, glm::dvec3(0.0));
  std::vector<MeshGroup> groups;
  const SourceMesh mesh = load_mesh(obj, "m.obj", groups);
  EXPECT_EQ(own.meshes[0].triangles.size(), 3U);
  EXPECT_EQ(own.meshes[0].vertices, mesh.vertices);
  EXPECT_EQ(own.meshes[0].faces, mesh.faces);
  EXPECT_EQ(message_of([] { static_cast<void>(load_instances("v 0 0 0\n", "m.obj")); }),
            "mesh file \"m.obj\": has no triangle; at least one is needed");
  EXPECT_EQ(message_of([] { static_cast<void>(load_instances("v 0 0 0\nf 1 1 1\n", "m.obj")); }),
            "mesh file \"m.obj\": has only triangles without area (1); at least one with area is needed");
  EXPECT_TRUE(may_have_instances("a.GLB"));
  EXPECT_FALSE(may_have_instances("a.obj"));
  EXPECT_FALSE(may_have_instances("a"));
}

TEST(GltfInstances, ScenesWithoutTrianglesAreRefused) {
  json file = square_gltf();
  file["scenes"][0]["nodes"] = json::array();
  const std::string none = "mesh file \"m.gltf\": has no triangle; at least one is needed";
  EXPECT_EQ(message_of([&] { static_cast<void>(instances(file)); }), none);
  file = square_gltf();
  file["meshes"][0]["primitives"][0]["mode"] = 0;
  EXPECT_EQ(message_of([&] { static_cast<void>(instances(file)); }), none);
}

TEST(GltfInstances, PlacesMustFitBinary32) {
  json file = square_gltf();
  file["nodes"] = json::parse(R"([{"mesh": 0}, {"mesh": 0, "scale": [1e39, 1, 1]}])");
  file["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(
      message_of([&] { static_cast<void>(instances(file)); }),
      "mesh file \"m.gltf\": instance 1 has a corner of its mesh's box at (1e+39, 0, 0); coordinates must "
      "be finite and below 3.4e38");
}

/// 10^5 instances of half a million triangles are a small file. Stored are the mesh and the instances.
TEST(GltfInstances, TakeTheirOwnMemoryAndNotThatOfTheFlattenedMesh) {
  json file = square_gltf();
  const json flat = {
      {"componentType", 5125}, {"count", 1500000}, {"type", "SCALAR"}};  // zeros, without a buffer
  const json places = {{"componentType", 5126}, {"count", 100000}, {"type", "VEC3"}};
  file["accessors"].push_back(flat);
  file["accessors"].push_back(places);
  json& primitives = file["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["indices"] = 2;
  attributes_of(file)["TRANSLATION"] = 3;
  const OwnInstances own = instances(file);
  EXPECT_EQ(own.instances.size(), 100000U);
  ASSERT_EQ(own.meshes.size(), 1U);
  EXPECT_EQ(own.meshes[0].triangles.size(), 500002U);
  EXPECT_EQ(reason(file),
            "nodes[0]: with its mesh the scene has more than 4294967295 corners, which is the most allowed");
  file["accessors"][3]["count"] = 4294967295U;
  const std::uint64_t bytes = 2 * (sizeof(FileMesh::Group) + 6 + 4 * sizeof(glm::dvec3)) +
                              4 * std::uint64_t{1500006} + sizeof(OwnInstance) * std::uint64_t{4294967295};
  EXPECT_EQ(message_of([&] { static_cast<void>(instances(file)); }),
            "mesh file \"m.gltf\": nodes[0]: with its mesh the scene needs " + std::to_string(bytes) +
                " bytes; allowed are " + std::to_string((32U << 20U) + 24 * file.dump().size()) +
                ", which is 32 MiB and 24 times the bytes of the file");
}

}  // namespace
}  // namespace hitpipe::ref::gltf_instances_test
