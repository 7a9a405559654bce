#include "rays/files/gltf_instances.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "host/text.hpp"
#include "rays/files/finite.hpp"

namespace hitpipe::ref {
namespace {

const GltfAccessor* gltf_instance_vectors(GltfAccessors& accessors, const Place& attributes,
                                          const char* name) {
  if (!attributes.has(name)) return nullptr;
  const GltfAccessor& accessor = accessors.at(attributes.at(name));
  if (accessor.type() != "VEC3" || accessor.component_type() != GltfAccessor::floating)
    accessor.place().fail(fmt::format("is for {} of instances; it must be VEC3 and 5126", name));
  return &accessor;
}

const GltfAccessor* gltf_instance_rotations(GltfAccessors& accessors, const Place& attributes) {
  if (!attributes.has("ROTATION")) return nullptr;
  const GltfAccessor& accessor = accessors.at(attributes.at("ROTATION"));
  const unsigned type = accessor.component_type();
  const bool is_fraction =
      accessor.normalised() && (type == GltfAccessor::signed_byte || type == GltfAccessor::signed_short);
  if (accessor.type() != "VEC4" || (type != GltfAccessor::floating && !is_fraction))
    accessor.place().fail(
        "is for ROTATION of instances; it must be VEC4, and 5126, or 5120 or 5122 and normalized");
  return &accessor;
}

glm::dvec3 gltf_instance_vector(const GltfAccessor& accessor, const char* name, std::uint64_t i) {
  const glm::dvec3 v(accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2));
  if (!has_finite_coordinates(v))
    accessor.place().fail(
        fmt::format("instance {} has the {} ({}, {}, {}); numbers must be finite", i, name, v.x, v.y, v.z));
  return v;
}

std::array<double, 4> gltf_instance_quaternion(const GltfAccessor& accessor, std::uint64_t i) {
  const std::array<double, 4> q{accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2),
                                accessor.number(i, 3)};
  // Four bytes that are cut, each by less than 1/127, are shorter by less than this.
  constexpr double rounding = 2.0 / 127;
  if (const double length = gltf_length(q); !(std::abs(length - 1) <= rounding))
    accessor.place().fail(fmt::format(
        "instance {} has a ROTATION of the length {}; a quaternion must have the length 1", i, length));
  return q;
}

}  // namespace

GltfInstances::GltfInstances(const GltfDocument& document, GltfAccessors& accessors, const Place& node) {
  const char* const name = "EXT_mesh_gpu_instancing";
  if (!node.has("extensions") || !node.at("extensions").has(name)) return;
  const Place extension = node.at("extensions").at(name);
  // A skin takes the place of transforms, and nothing says which of them.
  if (node.has("skin")) extension.fail("the node has a skin; allowed are nodes without one");
  is_node_ = false;
  const Place attributes = extension.at("attributes");
  check_counts(document, attributes);
  translations_ = gltf_instance_vectors(accessors, attributes, "TRANSLATION");
  rotations_ = gltf_instance_rotations(accessors, attributes);
  scales_ = gltf_instance_vectors(accessors, attributes, "SCALE");
}

/// Also of attributes that are not read, whose names begin with _.
void GltfInstances::check_counts(const GltfDocument& document, const Place& attributes) {
  const auto members = attributes.members();
  if (members.empty()) attributes.fail("has no attribute; allowed are TRANSLATION, ROTATION and SCALE");
  const auto elements = [&](const Place& number) {
    return document.item("accessors", number).at("count").count(UINT32_MAX);
  };
  const auto& [first, first_number] = members.front();
  count_ = elements(first_number);
  for (const auto& [name, number] : members) {
    if (elements(number) != count_)
      number.fail(fmt::format("has {} elements; {} has {}, and all must have as many", elements(number),
                              host::shortened(first), count_));
  }
}

GltfTransform GltfInstances::placed(const GltfTransform& node, std::uint64_t i) const {
  if (is_node_) return node;
  GltfParts parts;
  if (translations_) parts.translation = gltf_instance_vector(*translations_, "TRANSLATION", i);
  if (rotations_) parts.rotation = gltf_instance_quaternion(*rotations_, i);
  if (scales_) parts.scale = gltf_instance_vector(*scales_, "SCALE", i);
  return node * gltf_transform(parts);
}

}  // namespace hitpipe::ref
