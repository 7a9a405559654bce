#include "sw_ref/render/stiff_rays.hpp"

#include <algorithm>

#include <glm/common.hpp>

namespace hitpipe::ref {

bool is_stiff(const Ray& ray) {
  const glm::vec3 d = glm::abs(ray.direction);
  return std::min({d.x, d.y, d.z}) < stiff_ratio * std::max({d.x, d.y, d.z});
}

bool has_zero_component(const Ray& ray) {
  return ray.direction.x == 0.0F || ray.direction.y == 0.0F || ray.direction.z == 0.0F;
}

void StiffRays::add(std::span<const Ray> rays) {
  rays_ += rays.size();
  stiff_ += static_cast<std::uint64_t>(std::count_if(rays.begin(), rays.end(), is_stiff));
  zero_ += static_cast<std::uint64_t>(std::count_if(rays.begin(), rays.end(), has_zero_component));
}

}  // namespace hitpipe::ref
