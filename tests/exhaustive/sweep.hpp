// Every ray and box of a small world, for widths so narrow that the half units of rounding are large:
//   directions  all of a float format of 1 sign, 2 exponent and 1 or 2 significand bits, subnormals included
//   boxes       all whose corners lie on a sub-grid, flat boxes included
//   origins     grid ties: +-1/2 times the odd G = 2^(n-2) - 1 rounds up by half a unit, the binary32 below
//               1/2 down by almost as much; the sub-grid has ties too, where a box is rounded by nothing
#pragma once

#include <cmath>
#include <vector>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref::exhaustive {

/// Counts exponent and significand fields up: 4088 directions with one significand bit, 13816 with two.
inline const std::vector<float> one_bit{0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 6.0F, 8.0F, 12.0F};
inline const std::vector<float> two_bits{0.0F, 1.0F, 2.0F, 3.0F,  4.0F,  5.0F,
                                         6.0F, 7.0F, 8.0F, 10.0F, 12.0F, 14.0F};

/// Both signs, zeros too; without the eight directions that are zero on every axis.
inline std::vector<glm::vec3> directions(const std::vector<float>& magnitudes) {
  std::vector<float> components;
  for (const float magnitude : magnitudes) {
    components.push_back(magnitude);
    components.push_back(-magnitude);
  }
  std::vector<glm::vec3> all;
  for (const float x : components) {
    for (const float y : components) {
      for (const float z : components) {
        if (glm::vec3 d(x, y, z); d != glm::vec3(0)) all.push_back(d);
      }
    }
  }
  return all;
}

/// All points with these coordinates.
inline std::vector<glm::vec3> points(const std::vector<float>& coordinates) {
  std::vector<glm::vec3> all;
  for (const float x : coordinates) {
    for (const float y : coordinates) {
      for (const float z : coordinates) all.emplace_back(x, y, z);
    }
  }
  return all;
}

/// All boxes with corners at such points: (m (m + 1) / 2)^3 boxes for m ascending coordinates.
inline std::vector<Aabb> boxes(const std::vector<float>& coordinates) {
  std::vector<Aabb> all;
  for (const glm::vec3& min : points(coordinates)) {
    for (const glm::vec3& max : points(coordinates)) {
      if (min.x <= max.x && min.y <= max.y && min.z <= max.z) all.push_back({min, max});
    }
  }
  return all;
}

/// One sweep: every direction with every origin, length and box.
struct Sweep {
  std::vector<float> magnitudes;
  std::vector<float> corners;
  std::vector<float> origins;
  std::vector<float> lengths;

  [[nodiscard]] std::vector<Ray> rays() const {
    std::vector<Ray> all;
    for (const glm::vec3& direction : directions(magnitudes)) {
      for (const glm::vec3& origin : points(origins)) {
        for (const float length : lengths) all.push_back({origin, direction, length});
      }
    }
    return all;
  }
};

inline const float below_half = std::nextafter(0.5F, 0.0F);

/// Rays without an end: 4088 directions, 8 origins, 1000 boxes.
inline const Sweep endless{one_bit, {-1.0F, -0.5F, 0.5F, 1.0F}, {-0.5F, below_half}, {Ray::infinite}};

/// Rays that end on multiples of 1/16, ties and faces among them: 4088 directions, 1 origin, 3 lengths, 1000
/// boxes.
inline const Sweep ended{one_bit, {-1.0F, -0.5F, 0.5F, 1.0F}, {-0.5F}, {0.0F, 0x1p-4F, 0x1p-2F}};

/// Away from the border, so coarser axes stay on the grid: 4088 directions, 8 origins, 2 lengths, 216 boxes.
inline const Sweep inner{one_bit, {-0.5F, 0.5F, 0.75F}, {-0.5F, below_half}, {0x1p-3F, Ray::infinite}};

/// Rays whose direction rounds by half a unit, as 7 * 1/14 and 15 * 3/10 do. They go from the end of the cube
/// to boxes beside ties far away, where side relations reach down to EBND. 13816 directions, 8 origins, 216
/// boxes.
inline const Sweep leaning_4{
    two_bits, {-0x1.aaaaa8p-1F, 0x1.555554p-3F, 0.5F}, {-1.0F, 0x1.555558p-3F}, {Ray::infinite}};
inline const Sweep leaning_5{
    two_bits, {-0x1.924926p-1F, -0x1.492494p-1F, -0x1.6db6dcp-2F}, {-0x1.db6db4p-1F, 1.0F}, {Ray::infinite}};

/// Components whose ratios reach over the largest exponents of 3 to 5, and origins at ties of grids that are
/// finer by 0 and 1 bits, with faces there. 4088 directions, 27 origins, 216 boxes.
inline const Sweep tied{{0.0F, 1.0F, 2.0F, 3.0F, 7.0F, 15.0F, 16.0F, 31.0F},
                        {-0.5F, 0.25F, 0.75F},
                        {-0.5F, 0.25F, 0.75F},
                        {Ray::infinite}};

}  // namespace hitpipe::ref::exhaustive
