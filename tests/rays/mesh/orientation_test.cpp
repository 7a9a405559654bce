// Exact orientations against rational numbers.
#include "rays/mesh/orientation.hpp"

#include <cmath>
#include <random>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

namespace hitpipe::ref::orientation_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int truth(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const Rational det = (Rational(a.x) - Rational(c.x)) * (Rational(b.y) - Rational(c.y)) -
                       (Rational(a.y) - Rational(c.y)) * (Rational(b.x) - Rational(c.x));
  return det.sign();
}

TEST(Orientation, OfPointsNearlyOnALineIsTheRational) {
  std::mt19937_64 random(1);
  const auto unit = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5; };
  int zeros = 0;
  int not_zero = 0;
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 200) - 100);
    // Few bits, so that some lie on the line.
    const double grid = i % 2 == 0 ? 0x1p-53 : 0x1p-12;
    const auto rounded = [&](double x) { return std::round(x / grid) * grid; };
    const glm::dvec2 a = scale * glm::dvec2(rounded(unit()), rounded(unit()));
    const glm::dvec2 step = scale * glm::dvec2(rounded(unit()), rounded(unit()));
    const double t = i % 2 == 0 ? unit() : std::round(unit() * 8);
    const glm::dvec2 b = a + step;
    const glm::dvec2 c = a + t * step;
    const int side = truth(a, b, c);
    ++(side == 0 ? zeros : not_zero);
    ASSERT_EQ(orientation(a, b, c), side);
    ASSERT_EQ(orientation(b, a, c), -side);
    ASSERT_EQ(orientation(c, a, b), side);
  }
  EXPECT_GT(zeros, 5000);
  EXPECT_GT(not_zero, 5000);
}

TEST(Orientation, AtTheEndsOfItsRange) {
  for (const double s : {0x1p-480, 0x1p99}) {
    EXPECT_EQ(orientation({0, 0}, {s, s}, {s, s * (1 + 0x1p-52)}), 1);
    EXPECT_EQ(orientation({0, 0}, {s, s}, {s * (1 + 0x1p-52), s}), -1);
    EXPECT_EQ(orientation({-s, -s}, {0, 0}, {s, s}), 0);
  }
}

}  // namespace
}  // namespace hitpipe::ref::orientation_test
