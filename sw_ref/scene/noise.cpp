#include "sw_ref/scene/noise.hpp"

namespace hitpipe::ref {
namespace {

double at_integers(std::int64_t x, std::int64_t y, std::int64_t z) {
  // 21 bits each.
  constexpr std::uint64_t mask = (1U << 21U) - 1;
  const std::uint64_t key = (static_cast<std::uint64_t>(x) & mask) |
                            (static_cast<std::uint64_t>(y) & mask) << 21U |
                            (static_cast<std::uint64_t>(z) & mask) << 42U;
  return static_cast<double>(mixed(key + golden_step) >> 11U) * 0x1p-52 - 1.0;
}

double smooth(double t) {
  return t * t * (3.0 - 2.0 * t);
}

double mix(double a, double b, double t) {
  return a + (b - a) * t;
}

}  // namespace

double noise(const glm::dvec3& p) {
  const glm::dvec3 whole(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const auto x = static_cast<std::int64_t>(whole.x);
  const auto y = static_cast<std::int64_t>(whole.y);
  const auto z = static_cast<std::int64_t>(whole.z);
  const double u = smooth(p.x - whole.x);
  const double v = smooth(p.y - whole.y);
  const double w = smooth(p.z - whole.z);
  const auto along_x = [&](std::int64_t j, std::int64_t k) {
    return mix(at_integers(x, j, k), at_integers(x + 1, j, k), u);
  };
  return mix(mix(along_x(y, z), along_x(y + 1, z), v), mix(along_x(y, z + 1), along_x(y + 1, z + 1), v), w);
}

double layered_noise(glm::dvec3 p, int octaves) {
  double sum = 0.0;
  double height = 1.0;
  for (int i = 0; i < octaves; ++i) {
    sum += height * noise(p);
    p = 2.0 * p + 17.3;  // the octaves' lattices must not share a point
    height *= 0.5;
  }
  return sum;
}

}  // namespace hitpipe::ref
