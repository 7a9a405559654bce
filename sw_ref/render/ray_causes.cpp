#include "sw_ref/render/ray_causes.hpp"

#include <algorithm>
#include <array>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace hitpipe::ref {
namespace {

bool any(const glm::vec3& part) {
  return part.x > 0.0F || part.y > 0.0F || part.z > 0.0F;
}

/// Whether the surface scatters some colour of the light.
bool any_of(const glm::vec3& albedo, const glm::vec3& light) {
  return any(glm::vec3(glm::greaterThan(albedo, glm::vec3(0.0F))) * light);
}

}  // namespace

RayCauses ray_causes(const Scene& scene, const WhittedOptions& options) {
  std::array<bool, 256> used{};
  used[0] = scene.mesh.materials.empty();
  for (const std::uint8_t material : scene.mesh.materials) used[material] = true;
  RayCauses causes;
  glm::vec3 brightest(0.0F);
  for (std::size_t i = 0; i < std::min(used.size(), scene.materials.size()); ++i) {
    if (!used.at(i)) continue;
    const Material& material = scene.materials[i];
    brightest = glm::max(brightest, material.albedo);
    causes.mirrors = causes.mirrors || any(material.reflect) || any(material.transmit);
    causes.refracts = causes.refracts || any(material.transmit);
  }
  if (options.bounces == 0) causes.mirrors = causes.refracts = false;
  causes.scatters = any(brightest);
  causes.scattered = causes.scatters && options.bounces > 0 && options.diffuse > 0;
  causes.occlusion = causes.scatters && options.occlusion > 0;
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i)
    if (any_of(brightest, scene.lights[i].intensity)) causes.lights.push_back(i);
  causes.smooth = !scene.mesh.normals.empty();
  return causes;
}

}  // namespace hitpipe::ref
