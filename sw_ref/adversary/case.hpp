// One ray and one box, as an adversary hands them to a ray-box test.
#pragma once

#include <string>

#include "sw_ref/geometry/aabb.hpp"
#include "sw_ref/geometry/ray.hpp"

namespace hitpipe::ref::adversary {

struct Case {
  Ray ray;
  Aabb box;
};

/// All coordinates as hexadecimal floats: exact, and C++ reads them back.
[[nodiscard]] std::string to_text(const Ray& ray);
[[nodiscard]] std::string to_text(const Case& c);

}  // namespace hitpipe::ref::adversary
