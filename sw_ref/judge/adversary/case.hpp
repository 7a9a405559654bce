// One ray and one box, made to break a ray-box test.
#pragma once

#include <string>

#include "sw_ref/scene/aabb.hpp"
#include "sw_ref/scene/ray.hpp"

namespace hitpipe::ref::adversary {

struct Case {
  Ray ray;
  Aabb box;
};

/// All coordinates as hexadecimal floats, which are exact and readable by C++.
[[nodiscard]] std::string to_text(const Ray& ray);
[[nodiscard]] std::string to_text(const Case& c);

}  // namespace hitpipe::ref::adversary
