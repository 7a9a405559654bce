#include "rays/files/gltf_skin.hpp"

#include <fmt/format.h>

namespace hitpipe::ref {

GltfSkins::GltfSkins(const GltfDocument& document, const GltfNodes& nodes) : document_(document) {
  std::vector<bool> is_joint(document.size("nodes"), false);
  for (std::size_t s = 0; s < document.size("skins"); ++s) {
    const Place joints = document.item("skins", s).at("joints");
    if (joints.size() > is_joint.size())
      joints.fail(fmt::format("has {} joints; the file has {} nodes", joints.size(), is_joint.size()));
    for (const Place& joint : joints.elements()) is_joint[document.index("nodes", joint)] = true;
  }
  if (document.size("skins") == 0) return;
  nodes.visit([&](const Place&, std::size_t number, const GltfTransform& transform) {
    if (is_joint[number]) joints_[number] = transform;
  });
}

std::vector<GltfTransform> GltfSkins::matrices(GltfAccessors& accessors, const Place& number) const {
  const Place skin = document_.item("skins", number);
  const GltfAccessor* inverse = nullptr;
  const std::vector<Place> joints = skin.at("joints").elements();
  if (skin.has("inverseBindMatrices")) {
    inverse = &accessors.at(skin.at("inverseBindMatrices"));
    if (inverse->type() != "MAT4" || inverse->component_type() != GltfAccessor::floating ||
        inverse->count() < joints.size())
      inverse->place().fail(fmt::format(
          "is for inverse matrices of {} joints; it must have as many elements of type MAT4, 5126",
          joints.size()));
  }
  std::vector<GltfTransform> all;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::size_t node = document_.index("nodes", joints[j]);
    const auto found = joints_.find(node);
    if (found == joints_.end()) joints[j].fail(fmt::format("node {} is not in the scene that is read", node));
    glm::dmat4 bind(1.0);
    for (unsigned k = 0; inverse && k < 16; ++k)
      bind[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = inverse->number(j, k);
    all.push_back(found->second * gltf_signed(bind));
  }
  return all;
}

}  // namespace hitpipe::ref
