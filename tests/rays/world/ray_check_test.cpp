// Rays and formats that no set-up takes, each with its message.
#include "rays/world/ray_check.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "rays/world/int_major_ray.hpp"
#include "sw_ref/quantise/float_ray.hpp"
#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref::ray_check_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = Ray::infinite;

struct Named {
  std::string name;
  void (*make)(const Ray&);
};
const std::array set_ups{
    Named{"IntSlabsRaySetup",
          [](const Ray& ray) {
            IntSlabsRaySetup(ray, {16, 16});
          }},
    Named{"IntPluckerRaySetup",
          [](const Ray& ray) {
            IntPluckerRaySetup(ray, {16, 16});
          }},
    Named{"IntMajorRaySetup", [](const Ray& ray) { (void)IntMajorRaySetup(ray, {}).length(ray.length); }},
    Named{"FpSlabsSafeRaySetup", [](const Ray& ray) {
            (void)FpSlabsSafeRaySetup(ray, {8, 23}).end(ray.length);
          }}};

TEST(RaySetup, UnacceptableRaysAreRejected) {
  const float above = std::nextafter(1.0F, 2.0F);
  for (const Named& set_up : set_ups) {
    const auto refusal = [&]<class Error>(const Error&, const Ray& ray) {
      return message_of<Error>([&] { set_up.make(ray); });
    };
    const std::out_of_range range("");
    const std::invalid_argument argument("");
    EXPECT_EQ(refusal(argument, {{}, {1, 1, 1}, 1}), "no exception");
    EXPECT_EQ(refusal(range, {{0, above, 0}, {1, 0, 0}, 1}),
              set_up.name + ": origin.y = 1.0000001 is outside the cube; allowed is [-1, 1]");
    EXPECT_EQ(refusal(range, {{0, 0, nan}, {1, 0, 0}, 1}),
              set_up.name + ": origin.z = nan is outside the cube; allowed is [-1, 1]");
    EXPECT_EQ(refusal(argument, {{}, {0.0F, -0.0F, 0.0F}, 1}),
              set_up.name + ": direction is (0, 0, 0); one component must differ from 0");
    EXPECT_EQ(refusal(argument, {{}, {0, 0, -inf}, 1}),
              set_up.name + ": direction.z = -inf; components must be finite");
    EXPECT_EQ(refusal(argument, {{}, {1, 1, 1}, -0.5F}),
              set_up.name + ": length = -0.5; it must be >= 0 or infinite");
    EXPECT_EQ(refusal(argument, {{}, {1, 1, 1}, nan}),
              set_up.name + ": length = nan; it must be >= 0 or infinite");
  }
  EXPECT_EQ(message_of<std::invalid_argument>([] {
              (void)float_endpoint({{}, {1, 0, 0}, 1}, -1.0F);
            }),
            "float_endpoint: length = -1; it must be >= 0 or infinite");
}

TEST(RaySetup, IntegerFormatsOutsideTheRangeAreRejected) {
  const Ray ray{{}, {1, 1, 1}, 1};
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              IntSlabsRaySetup(ray, {33, 24});
            }),
            "IntSlabsRaySetup: format 33/24; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              IntSlabsRaySetup(ray, {6, 12});
            }),
            "IntSlabsRaySetup: format 6/12; n must be 6 to 32 and t 6 to 2n-1");
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              IntPluckerRaySetup(ray, {33, 24});
            }),
            "IntPluckerRaySetup: format 33/24; n must be 6 to 32 and t 6 to 2n-1");
}

TEST(RaySetup, MajorFormatsOutsideTheRangeAreRejected) {
  struct Row {
    hls::MajorBits bits;
    const char* name;
  };
  const auto refusal = [](hls::MajorBits bits) {
    return message_of<std::invalid_argument>([&] { IntMajorRaySetup({{}, {1, 1, 1}, 1}, bits); });
  };
  for (const Row& row :
       {Row{{33, 0, 12}, "33+0/12f0"}, Row{{3, 0, 12}, "3+0/12f0"}, Row{{20, 4, 12}, "20+4/12f0"},
        Row{{20, -1, 12}, "20+-1/12f0"}, Row{{20, 1, 2}, "20+1/2f0"}, Row{{20, 1, 33}, "20+1/33f0"},
        Row{{20, 1, 12, -3}, "20+1/12f-3"}, Row{{20, 1, 12, 4}, "20+1/12f4"}, Row{{32, 3, 29}, "32+3/29f0"},
        Row{{4, 0, 3, 3}, "4+0/3f3"}})
    EXPECT_EQ(refusal(row.bits), std::string("IntMajorRaySetup: there is no format ") + row.name);
  EXPECT_EQ(refusal({4, 0, 3, 2}), "no exception");
}

}  // namespace
}  // namespace hitpipe::ref::ray_check_test
