#include "rays/exact/exact_triangle.hpp"

#include <array>
#include <bit>
#include <cstddef>

#include <boost/multiprecision/cpp_int.hpp>

#include "rays/exact/floor_quotient.hpp"
#include "rays/exact/passage.hpp"
#include "rays/exact/quick_passage.hpp"
#include "rays/exact/wide_int.hpp"

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

double with_sign(double size, bool negative) {
  return negative && size > 0 ? -size : size;
}
double towards_zero(const WideInt& x, const WideInt& determinant) {
  return with_sign(enclose_quotient({abs(x), abs(determinant)}).low, (x < 0) != (determinant < 0));
}
Uint128 size_of(QuickPassage::Number x) {
  return static_cast<Uint128>(x < 0 ? -x : x);
}
double towards_zero(QuickPassage::Number x, QuickPassage::Number determinant) {
  return with_sign(floor_quotient(size_of(x), size_of(determinant)), (x < 0) != (determinant < 0));
}

double wide_time(const Passage& passage) {
  return towards_zero(passage.height(), passage.determinant());
}
/// The quotient is 0 or in [2^-122, 2^121], and the exponent in -254..254: nothing is rounded.
double quick_time(const QuickPassage& passage) {
  return std::ldexp(towards_zero(passage.height, passage.determinant()), passage.time_exponent);
}

struct WideProduct {
  Uint128 high, low;

  WideProduct(Uint128 a, Uint128 b) {
    const auto upper = [](Uint128 x) { return static_cast<std::uint64_t>(x >> 64U); };
    const auto lower = [](Uint128 x) { return static_cast<std::uint64_t>(x); };
    const Uint128 least = static_cast<Uint128>(lower(a)) * lower(b);
    const Uint128 one = static_cast<Uint128>(upper(a)) * lower(b) + upper(least);
    const Uint128 other = static_cast<Uint128>(lower(a)) * upper(b) + lower(one);
    high = static_cast<Uint128>(upper(a)) * upper(b) + upper(one) + upper(other);
    low = (other << 64U) | lower(least);
  }
  [[nodiscard]] int compared_with(const WideProduct& that) const {
    if (high != that.high) return high < that.high ? -1 : 1;
    return low == that.low ? 0 : low < that.low ? -1 : 1;
  }
};

/// The sign of the difference of two t, both >= 0. Nothing if 128 bits do not say it.
std::optional<int> quick_order(const Mesh::Corners& left, const Mesh::Corners& right, const Ray& ray) {
  const auto one = QuickPassage::of(left, ray);
  const auto other = QuickPassage::of(right, ray);
  if (!one || !other) return std::nullopt;
  // A height has 121 bits.
  constexpr int most_shift = 6;
  const int shift = one->time_exponent - other->time_exponent;
  if (shift > most_shift || shift < -most_shift) return std::nullopt;
  const Uint128 height = size_of(one->height) << (shift > 0 ? shift : 0);
  const Uint128 other_height = size_of(other->height) << (shift < 0 ? -shift : 0);
  return WideProduct(height, size_of(other->determinant()))
      .compared_with(WideProduct(other_height, size_of(one->determinant())));
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
  if (const auto order = quick_order(mesh.corners(left), mesh.corners(right), ray))
    return *order != 0 ? *order < 0 : left < right;
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
  const auto point = [](const auto& passage, const auto& t) -> std::optional<PlanePoint> {
    const auto determinant = passage.determinant();
    if (determinant == 0) return std::nullopt;
    PlanePoint made{.t = t(passage), .weights = {}};
    for (std::size_t i = 0; i < 3; ++i) made.weights[i] = towards_zero(passage.edges[i], determinant);
    return made;
  };
  if (const auto quick = QuickPassage::of(corners, ray)) return point(*quick, quick_time);
  return point(Passage(corners, ray), wide_time);
}

std::optional<double> plane_distance(const Mesh::Corners& corners, const Ray& ray) {
  const auto distance = [](const auto& passage, const auto& t) {
    return passage.determinant() == 0 ? std::nullopt : std::optional<double>(t(passage));
  };
  if (const auto quick = QuickPassage::of(corners, ray)) return distance(*quick, quick_time);
  return distance(Passage(corners, ray), wide_time);
}

float cull_length(const Hit& hit) {
  if (!(hit.t_high <= std::numeric_limits<float>::max())) {
    return std::numeric_limits<float>::infinity();
  }
  return rounded_up(hit.t_high);
}

bool has_area(const Mesh::Corners& corners) {
  if (surely_has_area({corners.a, corners.b, corners.c})) return true;
  const WideVec a = in_units(corners.a);
  const WideVec normal = cross(difference(in_units(corners.b), a), difference(in_units(corners.c), a));
  return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
}

}  // namespace hitpipe::ref
