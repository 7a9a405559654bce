// The adversary's rays and boxes, as the library takes them.
#pragma once

#include <cstdint>
#include <vector>

#include <hitpipe/ref.hpp>

#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe {

struct LibraryCase {
  ref::adversary::Case own;
  Ray ray;
  Box box;
};

inline Box as_box(const ref::Aabb& box) {
  return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

/// So many of every category.
inline std::vector<LibraryCase> library_cases(int of_each, std::uint64_t seed) {
  ref::adversary::Random random(seed);
  std::vector<LibraryCase> cases;
  for (const ref::adversary::Category& category : ref::adversary::categories()) {
    for (int i = 0; i < of_each; ++i) {
      const ref::adversary::Case c = category.make(random);
      const auto& [o, d, length] = c.ray;
      cases.push_back({c, {{o.x, o.y, o.z}, {d.x, d.y, d.z}, length}, as_box(c.box)});
    }
  }
  return cases;
}

}  // namespace hitpipe
