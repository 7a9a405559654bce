#include "rays/files/gltf_primitive.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "rays/files/finite.hpp"

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

/// Its sign is 1 if one of the joints keeps the sides of a surface, -1 if none does and one mirrors.
GltfTransform GltfPrimitive::skin_transform(std::uint64_t i, std::span<const GltfTransform> skin) const {
  GltfTransform sum{glm::dmat4(0.0), 0};
  double weights = 0;
  for (const auto& [numbers, parts] : joints_) {
    for (unsigned k = 0; k < 4; ++k) {
      const double weight = parts->number(i, k);
      if (weight == 0) continue;
      const auto joint = static_cast<std::size_t>(numbers->number(i, k));
      if (joint >= skin.size())
        place_.fail(fmt::format("vertex {} has joint {}; the skin has {} joints", i, joint, skin.size()));
      sum.matrix += weight * skin[joint].matrix;
      if (sum.sign != 1 && skin[joint].sign != 0) sum.sign = skin[joint].sign;
      weights += weight;
    }
  }
  if (!(weights > 0))
    place_.fail(fmt::format("vertex {} has joint weights of {}; they must add up to 1", i, weights));
  sum.matrix /= weights;
  return sum;
}

glm::dvec3 GltfPrimitive::position(std::uint64_t i, const GltfTransform& transform) const {
  const auto vector = [i](const GltfAccessor& accessor) {
    return glm::dvec3(accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2));
  };
  glm::dvec3 p = vector(*positions_);
  for (const auto& [weight, deltas] : targets_) p += weight * vector(*deltas);
  if (!has_finite_coordinates(p))
    place_.fail(fmt::format("vertex {} lies at ({}, {}, {}); coordinates must be finite", i, p.x, p.y, p.z));
  const glm::dvec3 moved(transform.matrix * glm::dvec4(p, 1.0));
  if (!has_finite_coordinates(moved))
    place_.fail(fmt::format("a node transform moves vertex {} to ({}, {}, {}); coordinates must be finite", i,
                            moved.x, moved.y, moved.z));
  return moved;
}

void GltfPrimitive::add_to(FileMesh& mesh, const GltfTransform& transform,
                           std::span<const GltfTransform> skin) const {
  const std::size_t first = mesh.positions.size();
  const std::size_t first_corner = mesh.corners.size();
  // A primitive may use a few of many positions that it shares with others.
  const bool few = corners_ < positions_->count();
  if (!few) mesh.positions.resize(first + positions_->count());
  std::vector<bool> is_read(few ? 0 : positions_->count(), false);
  int sign = 0;
  for (std::uint64_t c = 0; c < corners_; ++c) {
    const std::uint64_t vertex = corner(c);
    const std::size_t place = first + (few ? c : vertex);
    mesh.corners.push_back(static_cast<std::uint32_t>(place));
    if (few)
      mesh.positions.emplace_back();
    else if (is_read[vertex])
      continue;
    else
      is_read[vertex] = true;
    const GltfTransform moved = joints_.empty() ? transform : skin_transform(vertex, skin);
    mesh.positions[place] = position(vertex, moved);
    if (sign != 1 && moved.sign != 0) sign = moved.sign;
  }
  if (sign != -1) return;
  for (std::size_t c = first_corner; c < mesh.corners.size(); c += 3)
    std::swap(mesh.corners[c + 1], mesh.corners[c + 2]);
}

}  // namespace hitpipe::ref
