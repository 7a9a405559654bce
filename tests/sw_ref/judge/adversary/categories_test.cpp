// Each category does what its name says, the referee accepts it, and the same seed gives the same cases.
#include "sw_ref/judge/adversary/categories.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::adversary::categories_test {
namespace {

constexpr std::uint64_t seed = 20071;
constexpr int cases_per_category = 3'000;

int count_axes(const std::function<bool(int)>& holds) {
  return static_cast<int>(holds(0)) + static_cast<int>(holds(1)) + static_cast<int>(holds(2));
}
int zero_components_of(const Case& c) {
  return count_axes([&](int axis) { return c.ray.direction[axis] == 0; });
}
int axes_without_extent(const Case& c) {
  return count_axes([&](int axis) { return c.box.min[axis] == c.box.max[axis]; });
}
bool within_an_ulp(float a, float b) {
  return std::nextafter(a, b) == b;
}
/// Axes on which the ray starts on a face, within an ulp.
int faces_at_origin(const Case& c) {
  return count_axes([&](int axis) {
    const float o = c.ray.origin[axis];
    return within_an_ulp(o, c.box.min[axis]) || within_an_ulp(o, c.box.max[axis]);
  });
}
bool is_subnormal(float x) {
  return x != 0 && std::abs(x) < 0x1p-126F;
}
bool any_axis(const std::function<bool(int)>& holds) {
  return count_axes(holds) > 0;
}

/// An odd multiple of 2^-1 .. 2^-4: halfway between points of a grid that is finer by 0 .. 3 bits.
bool is_a_tie(float x) {
  for (int bits = 1; bits <= 4; ++bits) {
    const float steps = std::ldexp(x, bits);
    if (steps == std::floor(steps)) return std::fmod(steps, 2.0F) != 0;
  }
  return false;
}
/// |D_M| / |D_k| of the other axes, the larger ratio last; infinite for a zero.
std::array<double, 2> ratios_of(const Case& c) {
  std::array<double, 3> size{std::abs(c.ray.direction.x), std::abs(c.ray.direction.y),
                             std::abs(c.ray.direction.z)};
  std::sort(size.begin(), size.end());
  return {size[2] / size[1], size[2] / size[0]};
}

/// What is true of every case of a category.
const std::map<std::string_view, bool (*)(const Case&)> always{
    {"flat_box", [](const Case& c) { return axes_without_extent(c) >= 1; }},
    {"line_box", [](const Case& c) { return axes_without_extent(c) >= 2; }},
    {"point_box", [](const Case& c) { return axes_without_extent(c) == 3; }},
    {"axis_parallel", [](const Case& c) { return zero_components_of(c) == 2; }},
    {"in_face_plane", [](const Case& c) { return zero_components_of(c) >= 1 && faces_at_origin(c) >= 1; }},
    {"zero_components", [](const Case& c) { return zero_components_of(c) >= 1; }},
    {"touching_origin",
     [](const Case& c) { return any_axis([&](int i) { return c.box.min[i] == 0 || c.box.max[i] == 0; }); }},
    {"origin_inside",
     [](const Case& c) {
       return ray_meets_box_exact({c.ray.origin, {1, 0, 0}, 0.0F}, c.box);
     }},
    {"origin_on_face", [](const Case& c) { return faces_at_origin(c) >= 1; }},
    {"origin_on_edge", [](const Case& c) { return faces_at_origin(c) >= 2; }},
    {"origin_on_corner", [](const Case& c) { return faces_at_origin(c) == 3; }},
    {"length_at_entry", [](const Case& c) { return !c.ray.is_infinite(); }},
    {"length_at_exit", [](const Case& c) { return !c.ray.is_infinite(); }},
    {"length_zero", [](const Case& c) { return c.ray.length == 0; }},
    {"length_subnormal", [](const Case& c) { return is_subnormal(c.ray.length); }},
    {"length_huge", [](const Case& c) { return c.ray.length >= 0x1p20F && !c.ray.is_infinite(); }},
    {"subnormal_coordinates",
     [](const Case& c) {
       return any_axis([&](int i) {
         return is_subnormal(c.ray.origin[i]) || is_subnormal(c.box.min[i]) || is_subnormal(c.box.max[i]);
       });
     }},
    {"fine_ties",
     [](const Case& c) {
       return count_axes([&](int i) {
                const float o = c.ray.origin[i];
                return is_a_tie(o) || is_a_tie(std::nextafter(o, 2.0F)) || is_a_tie(std::nextafter(o, -2.0F));
              }) >= 2;
     }},
    {"equal_components",
     [](const Case& c) { return ratios_of(c)[0] < 1 + 0x1p-20 || zero_components_of(c) == 2; }},
    {"exponent_cap", [](const Case& c) { return ratios_of(c)[0] >= 0x1p2; }},
    {"mantissa_ends",
     [](const Case& c) {
       // The other two are powers of two or zero, so the quotient is the mantissa of the largest.
       return count_axes([&](int i) {
                int exponent = 0;
                const float size = std::abs(c.ray.direction[i]);
                return size == 0 || std::frexp(size, &exponent) == 0.5F;
              }) >= 2;
     }},
};

TEST(Adversary, HasEveryCategoryUnderOneName) {
  std::set<std::string_view> names;
  for (const Category& category : every_category()) {
    EXPECT_TRUE(names.insert(category.name).second) << category.name;
    EXPECT_FALSE(category.what.empty()) << category.name;
    EXPECT_EQ(category.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
  }
  EXPECT_EQ(names.size(), 27U + 5U + 6U);
  for (const auto& [name, holds] : always) EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Adversary, EveryCaseIsAcceptableAndOfItsCategory) {
  Random random(seed);
  for (const Category& category : every_category()) {
    const auto property = always.find(category.name);
    for (int i = 0; i < 3 * cases_per_category; ++i) {
      const Case c = category.make(random);
      ASSERT_TRUE(acceptable(c.ray) && acceptable(c.box)) << category.name << ": " << to_text(c);
      ASSERT_TRUE(property == always.end() || property->second(c)) << category.name << ": " << to_text(c);
    }
  }
}

/// A category whose cases all hit, or all miss, would test nothing. Rays aimed at a corner or an end need
/// exact arithmetic.
TEST(Adversary, EveryCategoryHitsAndMisses) {
  const std::set<std::string_view> aimed{"corner", "edge", "point_box", "line_box", "length_at_entry"};
  Random random(seed + 2);
  for (const Category& category : every_category()) {
    SCOPED_TRACE(category.name);
    int hits = 0;
    int doubtful = 0;
    int finite = 0;
    for (int i = 0; i < cases_per_category; ++i) {
      const Case c = category.make(random);
      hits += ray_meets_box(c.ray, c.box) ? 1 : 0;
      doubtful += ray_meets_box_filtered(c.ray, c.box) ? 0 : 1;
      finite += c.ray.is_infinite() ? 0 : 1;
    }
    const bool inside = category.name == "origin_inside";
    EXPECT_GT(hits, cases_per_category / 25);
    EXPECT_TRUE(inside ? hits == cases_per_category : hits < cases_per_category - cases_per_category / 25);
    EXPECT_GT(finite, cases_per_category / 10);
    EXPECT_TRUE(!aimed.contains(category.name) || doubtful > cases_per_category / 50) << doubtful;
  }
}

TEST(Adversary, SameSeedGivesTheSameCases) {
  for (const Category& category : every_category()) {
    Random one(seed);
    Random same(seed);
    Random other(seed + 1);
    int different = 0;
    for (int i = 0; i < 100; ++i) {
      const std::string text = to_text(category.make(one));
      EXPECT_EQ(text, to_text(category.make(same))) << category.name;
      different += text != to_text(category.make(other)) ? 1 : 0;
    }
    EXPECT_GT(different, 90) << category.name;
  }
}

/// Calls visit() with 20,000 cases of one category.
template <class Visit>
void each_case_of(std::string_view name, const Visit& visit) {
  const std::vector<Category> all = every_category();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Category& c) { return c.name == name; });
  ASSERT_NE(found, all.end()) << name;
  Random random(seed + 4);
  for (int i = 0; i < 20'000; ++i) visit(found->make(random));
}

TEST(Adversary, StiffRatiosReachFromNothingTo149InEveryOrder) {
  std::set<int> ratios;
  std::set<std::string> orders;
  each_case_of("stiff", [&](const Case& c) {
    const glm::vec3 d = glm::abs(c.ray.direction);
    std::string order = "012";
    std::sort(order.begin(), order.end(), [&](char a, char b) { return d[a - '0'] < d[b - '0']; });
    orders.insert(order);
    ratios.insert(std::ilogb(std::max({d.x, d.y, d.z})) - std::ilogb(std::min({d.x, d.y, d.z})));
  });
  EXPECT_EQ(orders.size(), 6U);
  EXPECT_GE(ratios.size(), 150U);
  EXPECT_LE(*ratios.begin(), 0);
  EXPECT_GE(*ratios.rbegin(), 149);
}

/// Zero components whose slab ends at a tie: where the distance 0 of a plane would be a miss.
TEST(MajorCategories, TiesOfEveryFineGridMeetFacesAtZeroComponents) {
  std::map<float, int> upper;
  each_case_of("fine_ties", [&](const Case& c) {
    for (int axis = 0; axis < 3; ++axis) {
      const float o = c.ray.origin[axis];
      if (c.ray.direction[axis] == 0 && is_a_tie(o) && c.box.max[axis] == o) ++upper[o];
    }
  });
  for (const float x : {0.5F, 0.25F, 0.125F, 0.0625F}) {
    EXPECT_GT(upper[x], 20) << x;
    EXPECT_GT(upper[x - 1.0F], 20) << x;
  }
}

TEST(MajorCategories, EqualComponentsAreEqualOnTwoAndOnThreeAxesInEveryOrderOfSigns) {
  std::array<int, 4> how_many{};
  std::set<std::string> signs;
  each_case_of("equal_components", [&](const Case& c) {
    const glm::vec3 d = c.ray.direction;
    const float most = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const int largest = count_axes([&](int axis) { return std::abs(d[axis]) == most; });
    ++how_many[static_cast<std::size_t>(largest)];
    if (largest == 3) signs.insert({d.x < 0 ? '-' : '+', d.y < 0 ? '-' : '+', d.z < 0 ? '-' : '+'});
  });
  EXPECT_GT(how_many[2], 2'000);
  EXPECT_GT(how_many[3], 2'000);
  EXPECT_EQ(signs.size(), 8U);
}

/// Ratios from a quarter of the largest quotient to four times that, for every width of an origin.
TEST(MajorCategories, RatiosPassTheLargestExponentOfEveryFormat) {
  std::map<int, int> exponents;
  int zeros = 0;
  each_case_of("exponent_cap", [&](const Case& c) {
    const double ratio = ratios_of(c)[1];
    zeros += std::isinf(ratio) ? 1 : 0;
    if (!std::isinf(ratio)) ++exponents[std::ilogb(ratio)];
  });
  EXPECT_GT(zeros, 1'000);
  for (int bits = 6; bits <= 35; ++bits) EXPECT_GT(exponents[bits - 1], 50) << bits;
}

/// The upper bound of a mantissa is 2 where the quotient lies above the last step before 2.
TEST(MajorCategories, MantissasEndAtTheLastStepOfEveryWidth) {
  std::map<int, int> above_last;
  each_case_of("mantissa_ends", [&](const Case& c) {
    const double ratio = ratios_of(c)[0];
    if (std::isinf(ratio)) return;
    const double mantissa = std::ldexp(ratio, -std::ilogb(ratio));
    for (int p = 4; p <= 16; ++p) above_last[p] += mantissa > 2.0 - std::ldexp(1.0, 1 - p) ? 1 : 0;
  });
  for (int p = 4; p <= 16; ++p) EXPECT_GT(above_last[p], 50) << p;
}

/// A difference times its quotient lies within a factor of 2 of the largest word of many formats, on both
/// sides of the origin.
TEST(MajorCategories, DifferencesSaturateOnBothSides) {
  int ahead = 0;
  int behind = 0;
  each_case_of("saturation", [&](const Case& c) {
    const double most =
        std::max({std::abs(c.ray.direction.x), std::abs(c.ray.direction.y), std::abs(c.ray.direction.z)});
    for (int axis = 0; axis < 3; ++axis) {
      const double direction = c.ray.direction[axis];
      if (direction == 0 || std::abs(direction) == most) continue;
      for (const float plane : {c.box.min[axis], c.box.max[axis]}) {
        // In units of the cube's half: 2 is the largest word.
        const double along = (static_cast<double>(plane) - c.ray.origin[axis]) / direction * most;
        ahead += along > 1.0 && along < 4.0 ? 1 : 0;
        behind += along < -1.0 && along > -4.0 ? 1 : 0;
      }
    }
  });
  EXPECT_GT(ahead, 5'000);
  EXPECT_GT(behind, 1'000);
}

TEST(Adversary, TextIsExact) {
  const Case c{.ray = {{0.1F, -0.0F, 1.0F}, {0x1p-149F, 2.0F, -3.0F}, Ray::infinite},
               .box = {{-1.0F, 0.25F, 0.0F}, {1.0F, 0.5F, 0.0F}}};
  EXPECT_EQ(to_text(c),
            "origin 0x1.99999ap-4 -0x0p+0 0x1p+0 direction 0x1p-149 0x1p+1 -0x1.8p+1 length inf box -0x1p+0 "
            "0x1p-2 0x0p+0 to 0x1p+0 0x1p-1 0x0p+0");
}

}  // namespace
}  // namespace hitpipe::ref::adversary::categories_test
