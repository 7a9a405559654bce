#include "sw_ref/judge/triangle_test.hpp"

#include <array>
#include <bit>
#include <cstddef>

#include <boost/multiprecision/cpp_int.hpp>

#include "sw_ref/judge/wide_int.hpp"

namespace hitpipe::ref {
namespace {

/// Doubles as integers of any size, in units of 2^-1074.
using BigVec = std::array<boost::multiprecision::cpp_int, 3>;

BigVec in_big_units(const glm::dvec3& v) {
  BigVec big;
  for (int axis = 0; axis < 3; ++axis) {
    int exponent = 0;
    const double part = std::frexp(v[axis], &exponent);  // a multiple of 2^-53, and v of 2^-1074
    constexpr int digits = 53;
    boost::multiprecision::cpp_int& x = big[static_cast<std::size_t>(axis)];
    x = static_cast<std::int64_t>(std::ldexp(part, digits));
    const int shift = exponent - digits + 1074;
    if (shift >= 0)
      x <<= static_cast<unsigned>(shift);
    else
      x /= boost::multiprecision::cpp_int(1) << static_cast<unsigned>(-shift);  // without a rest
  }
  return big;
}

/// False if doubles cannot say it.
bool surely_has_area(const SourceMesh::Corners& corners) {
  // A component of (b - a) x (c - a) errs by at most 4 u times the sum of its |products|: 2 roundings of
  // entries, 1 of the product, 1 of the difference. 8 u covers the rounding of the bound. `least` covers
  // products that underflow.
  constexpr double least = 0x1p-1000;
  const glm::dvec3 b = corners.b - corners.a;
  const glm::dvec3 c = corners.c - corners.a;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double left = b[i] * c[j];
    const double right = b[j] * c[i];
    if (std::abs(left - right) >
        8 * triangle_filter::unit_roundoff * (std::abs(left) + std::abs(right)) + least) {
      return true;
    }
  }
  return false;
}

/// t = numerator / denominator. The denominator is 0 if the line misses the triangle or is parallel to it;
/// otherwise it is > 0.
struct ExactTime {
  WideInt numerator;
  WideInt denominator;
};

/// How a line passes a triangle.
struct Passage {
  WideVec a, b_cross_c;          ///< seen from the ray's origin
  std::array<WideInt, 3> edges;  ///< on which side it passes the edge opposite each corner

  Passage(const Mesh::Corners& corners, const Ray& ray) {
    const WideVec origin = in_units(ray.origin);
    const WideVec direction = in_units(ray.direction);
    a = difference(in_units(corners.a), origin);
    const WideVec b = difference(in_units(corners.b), origin);
    const WideVec c = difference(in_units(corners.c), origin);
    b_cross_c = cross(b, c);
    edges = {dot(direction, b_cross_c), dot(direction, cross(c, a)), dot(direction, cross(a, b))};
  }
  /// b x c + c x a + a x b is the normal (b - a) x (c - a), so the sum is direction . normal.
  [[nodiscard]] WideInt determinant() const { return edges[0] + edges[1] + edges[2]; }
  /// a . normal
  [[nodiscard]] WideInt height() const { return dot(a, b_cross_c); }
};

ExactTime exact_time(const Mesh::Corners& corners, const Ray& ray) {
  const Passage passage(corners, ray);
  const auto& [edge_bc, edge_ca, edge_ab] = passage.edges;
  const bool left = edge_bc >= 0 && edge_ca >= 0 && edge_ab >= 0;
  const bool right = edge_bc <= 0 && edge_ca <= 0 && edge_ab <= 0;
  if (!left && !right) {
    return {0, 0};
  }
  // The determinant is 0 only if all edges are.
  const WideInt determinant = passage.determinant();
  const WideInt height = passage.height();
  return right ? ExactTime{-height, -determinant} : ExactTime{height, determinant};
}

/// The neighbouring doubles around a quotient >= 0, or the quotient itself. It is 0 or in [2^-600, 2^500], so
/// ldexp is exact.
triangle_filter::Enclosure enclose_quotient(const ExactTime& t) {
  if (t.numerator == 0) {
    return {0, 0};
  }
  // Scale so that the integer quotient has 53 or 54 bits. With 55 bits a bit could be lost below.
  const int shift = 53 - (static_cast<int>(msb(t.numerator)) - static_cast<int>(msb(t.denominator)));
  WideInt numerator = t.numerator;
  WideInt denominator = t.denominator;
  (shift >= 0 ? numerator : denominator) <<= static_cast<unsigned>(shift >= 0 ? shift : -shift);
  WideInt quotient;
  WideInt remainder;
  divide_qr(numerator, denominator, quotient, remainder);
  auto low = static_cast<std::uint64_t>(quotient);
  bool inexact = remainder != 0;
  int exponent = -shift;
  if (std::bit_width(low) > 53) {
    inexact = inexact || (low & 1U) != 0;
    low >>= 1U;
    ++exponent;
  }
  const std::uint64_t high = low + (inexact ? 1U : 0U);
  return {std::ldexp(static_cast<double>(low), exponent), std::ldexp(static_cast<double>(high), exponent)};
}

}  // namespace

namespace triangle_filter {

bool enclose_exactly(const Mesh::Corners& corners, const Ray& ray, Enclosure& t) {
  const ExactTime exact = exact_time(corners, ray);
  if (exact.denominator == 0 || exact.numerator < 0) {
    return false;
  }
  if (!ray.is_infinite() && (exact.numerator << unit_bits) > in_units(ray.length) * exact.denominator) {
    return false;
  }
  t = enclose_quotient(exact);
  return true;
}

bool before_exactly(const Mesh& mesh, std::uint32_t left, std::uint32_t right, const Ray& ray) {
  const ExactTime left_time = exact_time(mesh.corners(left), ray);
  const ExactTime right_time = exact_time(mesh.corners(right), ray);
  const WideInt left_side = left_time.numerator * right_time.denominator;
  const WideInt right_side = right_time.numerator * left_time.denominator;
  return left_side != right_side ? left_side < right_side : left < right;
}

}  // namespace triangle_filter

bool has_area(const SourceMesh::Corners& corners) {
  if (surely_has_area(corners)) return true;
  if (corners.a == corners.b || corners.b == corners.c || corners.c == corners.a) return false;
  const BigVec a = in_big_units(corners.a);
  const BigVec b = in_big_units(corners.b);
  const BigVec c = in_big_units(corners.c);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if ((b[i] - a[i]) * (c[j] - a[j]) != (b[j] - a[j]) * (c[i] - a[i])) return true;
  }
  return false;
}

std::optional<PlanePoint> plane_point(const Mesh::Corners& corners, const Ray& ray) {
  const Passage passage(corners, ray);
  const WideInt determinant = passage.determinant();
  if (determinant == 0) return std::nullopt;
  const auto over_determinant = [&](const WideInt& x) {
    const bool negative = (x < 0) != (determinant < 0);
    const double size = enclose_quotient({abs(x), abs(determinant)}).low;
    return negative && size > 0 ? -size : size;
  };
  PlanePoint point{.t = over_determinant(passage.height()), .weights = {}};
  for (std::size_t i = 0; i < 3; ++i) point.weights[i] = over_determinant(passage.edges[i]);
  return point;
}

float cull_length(const Hit& hit) {
  if (!(hit.t_high <= std::numeric_limits<float>::max())) {
    return std::numeric_limits<float>::infinity();
  }
  const auto nearest = static_cast<float>(hit.t_high);
  if (nearest >= hit.t_high) {
    return nearest;
  }
  // As t >= 0, this is the next larger binary32.
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1U);
}

bool has_area(const Mesh::Corners& corners) {
  if (surely_has_area({corners.a, corners.b, corners.c})) return true;
  const WideVec a = in_units(corners.a);
  const WideVec normal = cross(difference(in_units(corners.b), a), difference(in_units(corners.c), a));
  return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
}

}  // namespace hitpipe::ref
