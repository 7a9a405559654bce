#include "sw_ref/mesh/gltf_primitive.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "sw_ref/mesh/finite.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::uint64_t gltf_triangles = 4;
constexpr std::uint64_t gltf_strip = 5;
constexpr std::uint64_t gltf_fan = 6;

const GltfAccessor& gltf_vectors(const GltfDocument& document, GltfAccessors& accessors,
                                 const Place& number) {
  const GltfAccessor& accessor = accessors.at(number);
  if (accessor.type() != "VEC3") accessor.place().fail("is for positions; its type must be VEC3");
  const bool quantised = document.uses("KHR_mesh_quantization");
  if (accessor.component_type() == GltfAccessor::floating) return accessor;
  if (!quantised || accessor.component_type() == GltfAccessor::unsigned_int)
    accessor.place().fail(
        fmt::format("is for positions and has the componentType {}; allowed are 5126, and 5120 to 5123 with "
                    "KHR_mesh_quantization",
                    accessor.component_type()));
  return accessor;
}

const GltfAccessor& gltf_indices(GltfAccessors& accessors, const Place& number) {
  const GltfAccessor& accessor = accessors.at(number);
  const unsigned type = accessor.component_type();
  if (accessor.type() != "SCALAR" || accessor.normalised() ||
      (type != GltfAccessor::unsigned_byte && type != GltfAccessor::unsigned_short &&
       type != GltfAccessor::unsigned_int))
    accessor.place().fail("is for indices; it must be SCALAR, 5121, 5123 or 5125, and not normalized");
  return accessor;
}

}  // namespace

void check_gltf_attributes(const GltfDocument& document, const Place& primitive) {
  const Place attributes = primitive.at("attributes");
  if (!attributes.has("POSITION")) return;
  const auto count = [&](const Place& number) {
    return document.item("accessors", number).at("count").count(UINT32_MAX);
  };
  const std::uint64_t positions = count(attributes.at("POSITION"));
  const auto check = [&](const Place& numbers) {
    for (const auto& [name, number] : numbers.members()) {
      if (count(number) != positions)
        number.fail(fmt::format("has {} elements; POSITION has {}, and all must have as many", count(number),
                                positions));
    }
  };
  check(attributes);
  if (!primitive.has("targets")) return;
  for (const Place& target : primitive.at("targets").elements()) check(target);
}

GltfPrimitive::GltfPrimitive(const GltfDocument& document, GltfAccessors& accessors, const Place& primitive,
                             std::span<const double> weights, bool skinned)
    : place_(primitive),
      mode_(primitive.has("mode") ? primitive.at("mode").count(gltf_fan) : gltf_triangles) {
  const Place attributes = place_.at("attributes");
  if (mode_ < gltf_triangles || !attributes.has("POSITION")) return;
  positions_ = &gltf_vectors(document, accessors, attributes.at("POSITION"));
  if (place_.has("extensions") && place_.at("extensions").has("KHR_draco_mesh_compression") &&
      !positions_->has_buffer_view())
    place_.fail("has positions in KHR_draco_mesh_compression alone, which is not read; give plain ones");
  if (place_.has("indices")) indices_ = &gltf_indices(accessors, place_.at("indices"));
  const std::uint64_t entries = indices_ ? indices_->count() : positions_->count();
  const bool whole = mode_ == gltf_triangles ? entries % 3 == 0 : entries == 0 || entries >= 3;
  if (!whole)
    place_.fail(fmt::format("has {} {}; mode {} needs {}", entries, indices_ ? "indices" : "positions", mode_,
                            mode_ == gltf_triangles ? "a multiple of 3" : "3 or more"));
  corners_ = mode_ == gltf_triangles || entries == 0 ? entries : 3 * (entries - 2);
  read_targets(document, accessors, weights);
  if (skinned) read_joints(accessors);
}

std::uint64_t GltfPrimitive::positions() const {
  return corners_ == 0 ? 0 : std::min(corners_, positions_->count());
}

void GltfPrimitive::read_targets(const GltfDocument& document, GltfAccessors& accessors,
                                 std::span<const double> weights) {
  const std::size_t targets = place_.has("targets") ? place_.at("targets").size() : 0;
  if (!weights.empty() && weights.size() != targets)
    place_.fail(fmt::format("has {} morph targets; the weights are {}", targets, weights.size()));
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const Place target = place_.at("targets").element(t);
    if (weights[t] != 0 && target.has("POSITION"))
      targets_.emplace_back(weights[t], &gltf_vectors(document, accessors, target.at("POSITION")));
  }
}

void GltfPrimitive::read_joints(GltfAccessors& accessors) {
  const Place attributes = place_.at("attributes");
  for (int set = 0;; ++set) {
    const std::string joints = fmt::format("JOINTS_{}", set);
    const std::string weights = fmt::format("WEIGHTS_{}", set);
    if (set > 0 && !attributes.has(joints.c_str()) && !attributes.has(weights.c_str())) return;
    const GltfAccessor& numbers = accessors.at(attributes.at(joints));
    const GltfAccessor& parts = accessors.at(attributes.at(weights));
    const unsigned type = numbers.component_type();
    if (numbers.type() != "VEC4" ||
        (type != GltfAccessor::unsigned_byte && type != GltfAccessor::unsigned_short))
      numbers.place().fail("is for joints; it must be VEC4, 5121 or 5123");
    if (parts.type() != "VEC4" || (parts.component_type() != GltfAccessor::floating && !parts.normalised()))
      parts.place().fail("is for weights; it must be VEC4, and 5126 or normalized");
    joints_.push_back({&numbers, &parts});
  }
}

/// The position of corner c of all triangles, as the specification numbers them.
std::uint64_t GltfPrimitive::corner(std::uint64_t c) const {
  const std::uint64_t triangle = c / 3;
  const std::uint64_t k = c % 3;
  std::uint64_t entry = c;
  if (mode_ == gltf_strip) entry = triangle + (k == 0 ? 0 : k == 1 ? 1 + triangle % 2 : 2 - triangle % 2);
  if (mode_ == gltf_fan) entry = k == 2 ? 0 : triangle + 1 + k;
  if (!indices_) return entry;
  const std::uint64_t index = indices_->index(entry);
  if (index >= positions_->count())
    place_.at("indices").fail(fmt::format(
        "index {} refers to vertex {}; the primitive has {}", entry, index,
        positions_->count() == 0 ? "no vertex" : fmt::format("vertices 0 to {}", positions_->count() - 1)));
  return index;
}

glm::dmat4 GltfPrimitive::skin_matrix(std::uint64_t i, std::span<const glm::dmat4> skin) const {
  glm::dmat4 sum(0.0);
  double weights = 0;
  for (const auto& [numbers, parts] : joints_) {
    for (unsigned k = 0; k < 4; ++k) {
      const double weight = parts->number(i, k);
      if (weight == 0) continue;
      const auto joint = static_cast<std::size_t>(numbers->number(i, k));
      if (joint >= skin.size())
        place_.fail(fmt::format("vertex {} has joint {}; the skin has {} joints", i, joint, skin.size()));
      sum += weight * skin[joint];
      weights += weight;
    }
  }
  if (!(weights > 0))
    place_.fail(fmt::format("vertex {} has joint weights of {}; they must add up to 1", i, weights));
  return sum / weights;
}

glm::dvec3 GltfPrimitive::position(std::uint64_t i, const glm::dmat4& transform,
                                   std::span<const glm::dmat4> skin) const {
  const auto vector = [i](const GltfAccessor& accessor) {
    return glm::dvec3(accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2));
  };
  glm::dvec3 p = vector(*positions_);
  for (const auto& [weight, deltas] : targets_) p += weight * vector(*deltas);
  if (!has_finite_coordinates(p))
    place_.fail(fmt::format("vertex {} lies at ({}, {}, {}); coordinates must be finite", i, p.x, p.y, p.z));
  const glm::dvec3 moved(joints_.empty() ? transform * glm::dvec4(p, 1.0)
                                         : skin_matrix(i, skin) * glm::dvec4(p, 1.0));
  if (!has_finite_coordinates(moved))
    place_.fail(fmt::format("a node transform moves vertex {} to ({}, {}, {}); coordinates must be finite", i,
                            moved.x, moved.y, moved.z));
  return moved;
}

void GltfPrimitive::add_to(FileMesh& mesh, const glm::dmat4& transform,
                           std::span<const glm::dmat4> skin) const {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  // A primitive may use a few of many positions that it shares with others.
  const bool few = corners_ < positions_->count();
  for (std::uint64_t i = 0; !few && i < positions_->count(); ++i)
    mesh.positions.push_back(position(i, transform, skin));
  for (std::uint64_t c = 0; c < corners_; ++c) {
    const std::uint64_t vertex = corner(c);
    if (few) mesh.positions.push_back(position(vertex, transform, skin));
    mesh.corners.push_back(first + static_cast<std::uint32_t>(few ? c : vertex));
  }
}

}  // namespace hitpipe::ref
