// On which side of a line a point of the plane lies, exactly.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/vec2.hpp>

#ifdef __FAST_MATH__
#error "exact orientations need IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {

/// Shewchuk (1997): a sum of doubles whose parts do not overlap, so its sign is that of its last part.
class ExactSum {
 public:
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  [[nodiscard]] int sign() const {
    for (std::size_t i = parts_; i-- > 0;)
      if (part_[i] != 0.0) return part_[i] > 0.0 ? 1 : -1;
    return 0;
  }

 private:
  void add(double b) {
    for (std::size_t i = 0; i < parts_; ++i) {
      const double sum = b + part_[i];
      const double of_part = sum - b;
      part_[i] = (b - (sum - of_part)) + (part_[i] - of_part);
      b = sum;
    }
    part_[parts_++] = b;
  }

  std::array<double, 12> part_{};  // six products
  std::size_t parts_ = 0;
};

/// 1 if a, b, c turn left, -1 if they turn right, 0 if they lie on a line. Coordinates are 0 or between
/// 2^-480 and 2^100 in magnitude, so no product loses a bit.
[[nodiscard]] inline int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  // Shewchuk's ccwerrboundA.
  const double error = (3.0 + 16.0 * 0x1p-53) * 0x1p-53 * (std::abs(left) + std::abs(right));
  if (std::abs(det) > error) return det > 0.0 ? 1 : -1;
  if (a == b || b == c || c == a) return 0;
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.sign();
}

}  // namespace hitpipe::ref
