// The C of a core's header makes the rays that the reference makes, bit for bit.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "sim/core/core_bench.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::sim::c_ray_test {
namespace {

using Fields = std::array<std::uint32_t, 7>;  ///< patterns: origin, direction, length

/// Prints what is sent to the core, or "none".
constexpr const char* program = R"(#include "core.h"
#include <stdio.h>
int main(void) {
  uint32_t bits[7];
  while (scanf("%x %x %x %x %x %x %x", bits, bits + 1, bits + 2, bits + 3, bits + 4, bits + 5, bits + 6) == 7) {
    float values[7];
    memcpy(values, bits, sizeof values);
    struct core_ray ray;
    uint8_t bytes[CORE_RAY_BYTES];
    const bool is_ray = core_make_ray(&ray, values, values + 3, values[6]);
    core_pack_ray(bytes, &ray);
    for (int i = 0; is_ray && i < CORE_RAY_BYTES; ++i) printf("%02x", bytes[i]);
    printf(is_ray ? "\n" : "none\n");
  }
  return 0;
}
)";

/// Numbers that rounding goes wrong at: of any size, near powers of two, on the grid and beside it, equal.
float number(ref::adversary::Random& random, float largest) {
  const auto up_to_largest = [&](float x) { return std::isfinite(x) ? std::fmod(x, largest) : x; };
  switch (random.between(0, 7)) {
    case 0:
      return up_to_largest(std::bit_cast<float>(static_cast<std::uint32_t>(random.bits())));
    case 1:
      return std::ldexp(largest, -random.between(0, 40));
    case 2:
      return -std::ldexp(std::nextafter(largest, 0.0F), -random.between(0, 30));
    case 3:
      return largest;
    case 4:
      return random.between(0, 1) == 0 ? 0.0F : -0.0F;
    case 5:
      return largest * static_cast<float>(random.between(-4096, 4096)) / 8192;
    default:
      return largest * static_cast<float>(random.between(-1'000'000, 1'000'000)) * 1e-6F;
  }
}

std::vector<Fields> rays(int count) {
  ref::adversary::Random random(3);
  std::vector<Fields> made;
  for (int i = 0; i < count; ++i) {
    Fields ray{};
    const float longest = std::ldexp(1.0F, random.between(-149, 127));
    const float length = std::ldexp(1.0F, random.between(-30, 30)) / longest;
    for (std::size_t field = 0; field < 7; ++field)
      ray[field] = std::bit_cast<std::uint32_t>(field < 3   ? number(random, 1)
                                                : field < 6 ? number(random, longest)
                                                            : std::abs(number(random, length)));
    if (random.between(0, 9) == 0) ray[6] = 0x7F800000;                  // without an end
    if (random.between(0, 99) == 0) ray[random.below(7)] |= 0x7F800000;  // infinite or NaN
    if (random.between(0, 99) == 0) ray[6] |= 0x80000000;                // negative
    if (random.between(0, 99) == 0) ray[random.below(3)] += 0x800000;    // outside the cube
    made.push_back(ray);
  }
  return made;
}

/// Lines as the program prints them.
std::string expected(const rtl::Core& core, const std::vector<Fields>& rays) {
  const std::vector<rtl::Port> ports = rtl::records_of(core).ray.ports;
  std::string text;
  for (const Fields& ray : rays) {
    const auto at = [&](std::size_t i) { return std::bit_cast<float>(ray[i]); };
    CoreJob job;
    job.ray = {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6)};
    try {
      const std::vector<rtl::Word> words = ray_fields(core, job);
      for (std::size_t i = 0; i < words.size(); ++i) {
        // A field has whole bytes, and a negative number fills them.
        rtl::Word word = words[i];
        if (ports[i].is_signed && (word >> (ports[i].width - 1) & 1U) != 0)
          word |= ~rtl::ones_below(ports[i].width);
        for (int bit = 0; bit < ports[i].width; bit += 8)
          text += fmt::format("{:02x}", static_cast<unsigned>(word >> bit & 0xFFU));
      }
      text += "\n";
    } catch (const std::logic_error&) {
      text += "none\n";
    }
  }
  return text;
}

/// What the program prints with that header.
std::string printed(const std::string& header, const std::vector<Fields>& rays, const std::string& warnings) {
  const host::ScratchFolder folder("c-ray");
  std::string patterns;
  for (const Fields& ray : rays) patterns += fmt::format("{:x}\n", fmt::join(ray, " "));
  host::write_files(folder.path(), {{"core.h", header}, {"main.c", program}, {"rays", patterns}});
  const rtl::ToolResult built =
      rtl::run_tool(folder.path(), "gcc", "cc", "-std=c99 -O1 " + warnings + " main.c -o main");
  EXPECT_EQ(built.status, 0) << built.output;
  return rtl::run_tool(folder.path(), "sh", "sh", "-c './main < rays'").output;
}

rtl::Core core_of(const hls::RayBits& bits) {
  return rtl::make_core({.bits = bits}, rtl::library_called(rtl::default_library), "core");
}

class CRay : public testing::TestWithParam<hls::RayBits> {};

TEST_P(CRay, IsTheReferencesBitForBit) {
  const rtl::Core core = core_of(GetParam());
  const std::vector<Fields> tried = rays(20'000);
  const std::string right = expected(core, tried);
  std::istringstream lines(printed(rtl::c_header(core), tried,
                                   "-Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Werror")),
      right_lines(right);
  for (const Fields& ray : tried) {
    std::string line, right_line;
    std::getline(lines, line), std::getline(right_lines, right_line);
    ASSERT_EQ(line, right_line) << fmt::format("{:08x}", fmt::join(ray, " "));
  }
  const int none = rtl::times(right, "none");
  EXPECT_GT(none, 300);
  EXPECT_LT(none, 10'000);
}

INSTANTIATE_TEST_SUITE_P(Formats, CRay,
                         testing::Values(hls::RayBits{8, 0, 4, 0, 8, 0}, hls::RayBits{16, 1, 9, 0, 16, 0},
                                         hls::RayBits{20, 1, 11, 0, 20, 0}, hls::RayBits{20, 1, 32, 2, 13, 5},
                                         hls::RayBits{24, 3, 32, 3, 32, 8}),
                         [](const auto& each) { return Format(each.param).identifier(); });

TEST(CRayFaults, AreSeen) {
  const rtl::Core core = core_of({12, 3, 5, 0, 24, 8});
  const std::string header = rtl::c_header(core);
  const std::vector<Fields> tried = rays(20'000);
  const std::string right = expected(core, tried);
  for (const auto& [good, bad] : std::vector<std::pair<const char*, const char*>>{
           {"length >= 0", "length > 0"},
           {"core_size(origin[axis]) <= 1", "core_size(origin[axis]) < 1"},
           {"!= 255", "!= 254"},
           {") > core_size(direction[major])", ") >= core_size(direction[major])"},
           {"(biased ? biased : 1) - 150", "biased - 150"},
           {"(biased ? 0x800000 : 0)", "0x800000"},
           {"exponent < -60) return 0", "exponent < -30) return 0"},
           {"(value < 0 ? -twice : twice) + ((int64_t)1 << -exponent)",
            "(value < 0 ? -twice : twice) + ((int64_t)1 << -exponent) - 1"},
           {"down > 25) return 0", "down > 0) return 0"},
           {"+ below) / (2 * below)", "+ below - 1) / (2 * below)"},
           {"+ (below << down)) /", ") /"},
           {"slope == 0 ? one : largest", "one"},
           {"if (below > rest) {", "if (below >= rest) {"},
           {"if (raised > CORE_LARGEST_EXPONENT) return", "if (raised >= CORE_LARGEST_EXPONENT) return"},
           {"const bool one_more = rest >= below", "const bool one_more = rest > below"},
           {"rest > 0 && quotient == largest", "quotient > largest"},
           {"quotient + (rest > 0)", "quotient + 1"},
           {"if (!core_is_finite(length)) return CORE_LARGEST_T;", ""},
           {"+ (CORE_GRID * (a * b & 0xffffff) >> 24)", ""},
           {"if (exponent > 0) return CORE_LARGEST_T", "if (exponent > -30) return CORE_LARGEST_T"},
           {"if (exponent <= -64) return 0", "if (exponent <= -20) return 0"},
           {"t < CORE_LARGEST_T ? t", "high < CORE_LARGEST_T ? t"},
           {"a = m == 1 ? 0 : 1", "a = m == 2 ? 0 : 1"},
           {"ray->back_b = direction[b] < 0", "ray->back_b = direction[b] <= 0"}})
    EXPECT_TRUE(printed(rtl::replaced(header, good, bad), tried, "-w") != right) << good << " is " << bad;
}

/// A ray in the mesh's own units, and its hit: as in the cube, where the same lengths have other numbers.
TEST(CMeshRay, TakesTheMeshsOwnUnits) {
  constexpr const char* compares = R"(#include "core.h"
#include <math.h>
#include <stdio.h>
static bool same(const struct core_ray* a, const struct core_ray* b) {
  uint8_t bytes_a[CORE_RAY_BYTES], bytes_b[CORE_RAY_BYTES];
  core_pack_ray(bytes_a, a);
  core_pack_ray(bytes_b, b);
  return memcmp(bytes_a, bytes_b, CORE_RAY_BYTES) == 0;
}
int main(void) {
  struct core_image image = {0};
  image.offset[0] = 10, image.offset[1] = -20, image.offset[2] = 30.5, image.scale = 0.125;
  const double own[3] = {12, -26, 30};
  const float cube[3] = {0.25f, -0.75f, -0.0625f}, direction[3] = {0.6f, -0.8f, 0.1f};
  struct core_ray mesh_ray, cube_ray;
  if (!core_make_mesh_ray(&mesh_ray, &image, own, direction, 8) || !core_make_ray(&cube_ray, cube, direction, 1))
    return 1;
  if (!same(&mesh_ray, &cube_ray)) return 2;
  if (!core_make_mesh_ray(&mesh_ray, &image, own, direction, INFINITY) ||
      !core_make_ray(&cube_ray, cube, direction, INFINITY) || !same(&mesh_ray, &cube_ray))
    return 3;
  const double outside[3] = {12, -29, 30};
  if (core_make_mesh_ray(&mesh_ray, &image, outside, direction, 8)) return 4;
  struct core_hit hit = {0};
  hit.t = CORE_T_ONE / 2;
  if (core_mesh_distance(&hit, &image, direction) != 8 * core_distance(&hit, direction)) return 5;
  if (fabs(core_mesh_distance(&hit, &image, direction) - 4 / 0.8) > 1e-4) return 6;
  for (hit.failed = 0; hit.failed < 7; ++hit.failed) printf("%s\n", core_why(&hit));
  return 0;
}
)";
  for (const bool floats : {false, true}) {
    const rtl::Core core = rtl::make_core({.bits = {16, 1, 9, 0, 16, 0}, .float_door = floats},
                                          rtl::library_called(rtl::default_library), "core");
    const host::ScratchFolder folder("c-mesh-ray");
    host::write_files(folder.path(), {{"core.h", rtl::c_header(core)}, {"main.c", compares}});
    const rtl::ToolResult built = rtl::run_tool(
        folder.path(), "gcc", "cc", "-std=c99 -Wall -Wextra -Wpedantic -Werror main.c -o main -lm");
    ASSERT_EQ(built.status, 0) << built.output;
    const rtl::ToolResult ran = rtl::run_tool(folder.path(), "main", "./main", "");
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(ran.output, fmt::format("{}\nit is no answer\n", fmt::join(hls::failure_texts, "\n")));
  }
}

}  // namespace
}  // namespace hitpipe::sim::c_ray_test
