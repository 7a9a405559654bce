#include "rtl_gen/core/c_ray.hpp"

#include <cstdint>
#include <string_view>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

constexpr std::string_view text_of_checks = R"(
static inline float core_size(float value) {
  return value < 0 ? -value : value;
}

/* The axis of the largest component; of equal ones the first. */
static inline int core_major_axis(const float direction[3]) {
  int major = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (core_size(direction[axis]) > core_size(direction[major])) major = axis;
  return major;
}

/* Neither infinite nor NaN. */
static inline bool core_is_finite(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return (bits >> 23 & 255) != 255;
}

static inline bool core_is_ray(const float origin[3], const float direction[3], float length) {
  bool is = length >= 0;
  for (int axis = 0; axis < 3; ++axis)
    is = is && core_size(origin[axis]) <= 1 && core_is_finite(direction[axis]);
  return is && core_size(direction[core_major_axis(direction)]) > 0;
}
)";

constexpr std::string_view text_of_integers = R"(
/* |value| is mantissa 2^exponent. */
static inline uint64_t core_mantissa(float value, int* exponent) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  const int biased = (int)(bits >> 23 & 255);
  *exponent = (biased ? biased : 1) - 150;
  return (bits & 0x7fffff) | (biased ? 0x800000 : 0);
}

/* The nearest point of the origin's grid, ties up. */
static inline int64_t core_point(float value) {
  int exponent;
  const uint64_t mantissa = core_mantissa(value, &exponent);
  if (exponent < -60) return 0;
  const int64_t twice = (int64_t)(mantissa * (CORE_GRID << (CORE_FINER_BITS + 1)));
  return ((value < 0 ? -twice : twice) + ((int64_t)1 << -exponent)) >> (1 - exponent);
}

/* The nearest integer to 2^S |other / major|, ties up. */
static inline uint64_t core_slope(float other, float major) {
  int other_exponent, major_exponent;
  const uint64_t above = core_mantissa(other, &other_exponent), below = core_mantissa(major, &major_exponent);
  const int down = major_exponent - other_exponent - CORE_SLOPE_BITS;
  if (down > 25) return 0;
  if (down <= 0) return ((above << (1 - down)) + below) / (2 * below);
  return (2 * above + (below << down)) / (below << (down + 1));
}

/* Bounds of 2^S / slope: mantissas of P bits, times 2^exponent. */
static inline void core_bounds(uint64_t slope, uint64_t* low, uint64_t* high, uint64_t* exponent) {
  const uint64_t one = (uint64_t)1 << (CORE_MANTISSA_BITS - 1), largest = 2 * one - 1;
  uint64_t below = slope, rest = (uint64_t)1 << CORE_SLOPE_BITS, quotient = 0;
  int raised = 0;
  *low = *high = slope == 0 ? one : largest;
  *exponent = CORE_LARGEST_EXPONENT;
  if (slope == 0) return;
  for (; below < rest; below *= 2) ++raised;
  if (below > rest) {
    --raised;
    rest *= 2;
  }
  if (raised > CORE_LARGEST_EXPONENT) return;
  for (int i = 0; i < CORE_MANTISSA_BITS; ++i) {
    const bool one_more = rest >= below;
    quotient = 2 * quotient + one_more;
    rest = 2 * (one_more ? rest - below : rest);
  }
  if (rest > 0 && quotient == largest) {
    if (raised == CORE_LARGEST_EXPONENT) return;
    ++raised;
    quotient /= 2;
  }
  *low = quotient;
  *high = quotient + (rest > 0);
  *exponent = (uint64_t)raised;
}

/* The ray's end in units of T, rounded down. */
static inline uint64_t core_length(float length, float major) {
  if (!core_is_finite(length)) return CORE_LARGEST_T;
  int exponent, major_exponent;
  const uint64_t a = core_mantissa(length, &exponent), b = core_mantissa(major, &major_exponent);
  exponent += major_exponent + CORE_FINER_BITS + CORE_T_BITS;
  exponent += 24;
  if (exponent > 0) return CORE_LARGEST_T; /* both mantissas have their 24 bits, so the end is far away */
  if (exponent <= -64) return 0;
  const uint64_t high = CORE_GRID * (a * b >> 24) + (CORE_GRID * (a * b & 0xffffff) >> 24); /* G a b / 2^24 */
  const uint64_t t = high >> -exponent;
  return t < CORE_LARGEST_T ? t : CORE_LARGEST_T;
}
)";

/// Before a function's body.
constexpr std::string_view text_of_head = R"(
/* A ray for the nearest hit, in the image's cube, [-1, 1]. `length` counts directions, and may be infinite. Set
   ray->any afterwards for any hit. false: that is no ray, and the core would answer that it has failed. */
static inline bool core_make_ray(struct core_ray* ray, const float origin[3], const float direction[3],
                                 float length) {
  const bool is_ray = core_is_ray(origin, direction, length);
  memset(ray, 0, sizeof *ray);
)";

constexpr std::string_view text_of_integer_ray = R"(  ray->error = !is_ray;
  if (!is_ray) return false;
  const int m = core_major_axis(direction), a = m == 1 ? 0 : 1, b = m == 2 ? 0 : 2;
  ray->major_y = m == 1;
  ray->major_z = m == 2;
  ray->back_m = direction[m] < 0;
  ray->back_a = direction[a] < 0;
  ray->back_b = direction[b] < 0;
  ray->origin_m = core_point(origin[m]);
  ray->origin_a = core_point(origin[a]);
  ray->origin_b = core_point(origin[b]);
  ray->s_a = core_slope(direction[a], direction[m]);
  ray->s_b = core_slope(direction[b], direction[m]);
  core_bounds(ray->s_a, &ray->floor_a, &ray->ceil_a, &ray->exp_a);
  core_bounds(ray->s_b, &ray->floor_b, &ray->ceil_b, &ray->exp_b);
  ray->length = core_length(length, direction[m]);
  return true;
}
)";

constexpr std::string_view text_of_float_ray =
    R"(  ray->ox = origin[0], ray->oy = origin[1], ray->oz = origin[2];
  ray->dx = direction[0], ray->dy = direction[1], ray->dz = direction[2];
  ray->len = length;
  return is_ray;
}
)";

constexpr std::string_view text_of_distance = R"(
/* The place of a hit in the cube: origin + distance direction. */
static inline double core_distance(const struct core_hit* hit, const float direction[3]) {
  return (double)hit->t / CORE_T_ONE / core_size(direction[core_major_axis(direction)]);
}
)";

std::string text_of_constants(const hls::RayBits& bits) {
  return fmt::format(R"(
/* The format of an integer ray, {}: [-1, 1] is -G..G for a corner, and a ray's origin has a finer grid. */
#define CORE_GRID ((uint64_t){})
#define CORE_FINER_BITS {}
#define CORE_SLOPE_BITS {}
#define CORE_MANTISSA_BITS {}
#define CORE_LARGEST_EXPONENT {}
#define CORE_T_BITS {} /* of T below the unit of the origin's grid */
#define CORE_LARGEST_T ((uint64_t){})
)",
                     to_string(Format(bits)), (std::int64_t{1} << (bits.coord - 2)) - 1, bits.finer,
                     bits.slope, bits.mantissa, bits.boxes().largest_exponent(), bits.fraction,
                     bits.world().largest_distance());
}

}  // namespace

std::string c_ray(const Core& core) {
  const bool takes_floats = core.options.float_door;
  std::string text(text_of_checks);
  if (!takes_floats) text += text_of_constants(core.options.bits) + std::string(text_of_integers);
  return text.append(text_of_head)
      .append(takes_floats ? text_of_float_ray : text_of_integer_ray)
      .append(text_of_distance);
}

}  // namespace hitpipe::rtl
