#include "sw_ref/judge/adversary/case.hpp"

#include <fmt/format.h>

namespace hitpipe::ref::adversary {

std::string to_text(const Ray& ray) {
  return fmt::format("origin {:a} {:a} {:a} direction {:a} {:a} {:a} length {:a}", ray.origin.x, ray.origin.y,
                     ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.length);
}

std::string to_text(const Case& c) {
  return to_text(c.ray) + fmt::format(" box {:a} {:a} {:a} to {:a} {:a} {:a}", c.box.min.x, c.box.min.y,
                                      c.box.min.z, c.box.max.x, c.box.max.y, c.box.max.z);
}

}  // namespace hitpipe::ref::adversary
