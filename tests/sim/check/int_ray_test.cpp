// The unit that makes integer rays gives what ref::int_ray and ref::major_ray give, for rays of all
// exponents, and says of all other operands that there is no such ray.
#include "hls/pipelines/int_ray.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "rays/world/int_ray.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "sim/vectors/design_vectors.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::sim::int_ray_test {
namespace {

using hls::RayBits;
using Numbers = std::vector<std::int64_t>;

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class Draw {
 public:
  explicit Draw(const RayBits& bits, std::uint64_t seed) : bits_(bits), rng_(seed) {}

  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(rng_);
  }
  bool one_in(int n) { return integer(1, n) == 1; }
  float sign() { return one_in(2) ? -1.0F : 1.0F; }

  float pattern() { return std::bit_cast<float>(static_cast<std::uint32_t>(integer(0, 0xFFFFFFFF))); }
  float subnormal() { return sign() * std::ldexp(static_cast<float>(integer(0, 0x800001)), -149); }
  float power() { return sign() * std::ldexp(1.0F, static_cast<int>(integer(-149, 127))); }
  /// Few bits: ties of slopes, and of origins where it is a multiple of 2^-(g+1).
  float round_number() {
    return sign() *
           std::ldexp(static_cast<float>(integer(0, 9)), -static_cast<int>(integer(0, bits_.slope + 4)));
  }
  float in_cube() { return std::ldexp(static_cast<float>(integer(-(1 << 24), 1 << 24)), -24); }

  float component() {
    switch (integer(0, 8)) {
      case 0:
        return pattern();
      case 1:
        return subnormal();
      case 2:
        return power();
      case 3:
        return sign() * 0.0F;
      case 4:
      case 5:
        return round_number();
      default:
        return std::ldexp(in_cube(), -static_cast<int>(integer(0, 40)));
    }
  }
  float origin() {
    const float drawn = one_in(2) ? component() : in_cube();
    return std::abs(drawn) <= 1.0F ? drawn : sign() * 1.0F;
  }
  /// Some end where the length is the largest, or one more or less.
  float length(float major) {
    if (one_in(8)) return infinite;
    if (one_in(4)) {
      const double largest = std::ldexp(1.0, bits_.distance()) + static_cast<double>(integer(-3, 1));
      const double unit =
          std::ldexp(static_cast<double>(bits_.world().largest_corner()), bits_.finer + bits_.fraction);
      return static_cast<float>(largest / unit / static_cast<double>(std::abs(major)));
    }
    const float drawn = one_in(3) ? pattern() : component();
    return std::isnan(drawn) ? 1.0F : std::abs(drawn);
  }
  ref::Ray ray() {
    ref::Ray made;
    for (int axis = 0; axis < 3; ++axis) {
      made.origin[axis] = origin();
      made.direction[axis] = component();
      if (axis > 0 && one_in(6)) made.direction[axis] = sign() * made.direction[axis - 1];
      // Another mantissa of a near exponent.
      if (axis > 0 && one_in(4)) made.direction[axis] = made.direction[0] * (0.5F + in_cube());
    }
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(made.direction[axis])) made.direction[axis] = power();
    if (made.direction == glm::vec3(0)) made.direction[static_cast<int>(integer(0, 2))] = subnormal_above_0();
    made.length = length(
        std::max({std::abs(made.direction.x), std::abs(made.direction.y), std::abs(made.direction.z)}));
    if (!(made.length >= 0.0F)) made.length = -0.0F;
    return made;
  }

 private:
  float subnormal_above_0() { return std::ldexp(static_cast<float>(integer(1, 9)), -149); }

  RayBits bits_;
  std::mt19937_64 rng_;
};

Numbers operands_of(const ref::Ray& ray) {
  Numbers operands;
  for (int axis = 0; axis < 3; ++axis) operands.push_back(std::bit_cast<std::uint32_t>(ray.origin[axis]));
  for (int axis = 0; axis < 3; ++axis) operands.push_back(std::bit_cast<std::uint32_t>(ray.direction[axis]));
  operands.push_back(std::bit_cast<std::uint32_t>(ray.length));
  return operands;
}

/// In the order of the unit's results.
Numbers wanted(const ref::Ray& from, const RayBits& bits) {
  const ref::IntRay ray = ref::int_ray(from, bits.world());
  const ref::IntMajorRay major = ref::major_ray(ray, bits.boxes());
  const auto by_axis = [&](std::size_t ray_axis) { return static_cast<std::size_t>(major.axes[ray_axis]); };
  Numbers all{0, ray.major == 1, ray.major == 2};
  for (const bool back : major.backward) all.push_back(back);
  for (std::size_t i = 0; i < 3; ++i) all.push_back(ray.origin[by_axis(i)]);
  for (std::size_t i = 1; i < 3; ++i) all.push_back(std::abs(ray.direction[by_axis(i)]));
  for (const ref::MajorQuotient& quotient : major.quotient) {
    all.push_back(quotient.mantissa_low);
    all.push_back(quotient.mantissa_high);
    all.push_back(quotient.exponent);
  }
  all.push_back(ray.length);
  return all;
}

Numbers results_of(const rtl::Evaluate& unit, const ref::Ray& ray) {
  Numbers results(unit.result_count());
  unit(operands_of(ray).data(), results.data());
  return results;
}

std::string text_of(const ref::Ray& ray) {
  return fmt::format("origin {:a} {:a} {:a}, direction {:a} {:a} {:a}, length {:a}", ray.origin.x,
                     ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
                     ray.length);
}

const rtl::Design& design() {
  return rtl::find_design("int_ray");
}

class IntRayUnit : public testing::TestWithParam<const char*> {
 protected:
  const Format format_ = design().parse_format(GetParam());
  const RayBits bits_ = format_.as<RayBits>();
  const rtl::Evaluate unit_ = design().evaluate(format_);
};

TEST_P(IntRayUnit, GivesTheSoftwaresRay) {
  Draw draw(bits_, 41011);
  int subnormal = 0, cut = 0, zero_slopes = 0;
  for (int i = 0; i < 200'000; ++i) {
    const ref::Ray ray = draw.ray();
    const Numbers expected = wanted(ray, bits_);
    ASSERT_EQ(results_of(unit_, ray), expected) << text_of(ray);
    subnormal += std::abs(ray.direction.x) < 0x1p-126F ? 1 : 0;
    cut += expected.back() < bits_.world().largest_distance() && expected.back() > 0 ? 1 : 0;
    zero_slopes += expected[9] == 0 ? 1 : 0;
  }
  EXPECT_GT(subnormal, 10'000);
  EXPECT_GT(cut, 10'000);
  EXPECT_GT(zero_slopes, 10'000);
}

TEST_P(IntRayUnit, HasAnErrorWhereTheSoftwareThrows) {
  Draw draw(bits_, 41012);
  const auto has_error = [&](const ref::Ray& ray) { return results_of(unit_, ray).front() != 0; };
  const auto throws = [&](const ref::Ray& ray) {
    try {
      static_cast<void>(ref::int_ray(ray, bits_.world()));
    } catch (const std::logic_error&) {
      return true;
    }
    return false;
  };
  for (int i = 0; i < 300; ++i) {
    const ref::Ray right = draw.ray();
    ASSERT_FALSE(has_error(right)) << text_of(right);
    std::vector<ref::Ray> wrong;
    for (int axis = 0; axis < 3; ++axis) {
      for (const float origin :
           {std::nextafter(1.0F, 2.0F), -std::nextafter(1.0F, 2.0F), 2.0F, -infinite, nan, -nan}) {
        wrong.push_back(right);
        wrong.back().origin[axis] = origin;
      }
      for (const float direction : {infinite, -infinite, nan, -nan}) {
        wrong.push_back(right);
        wrong.back().direction[axis] = direction;
      }
    }
    for (const float length : {-0x1p-149F, -1.0F, -infinite, nan, -nan}) {
      wrong.push_back(right);
      wrong.back().length = length;
    }
    wrong.push_back(right);
    wrong.back().direction = glm::vec3(0.0F, -0.0F, 0.0F);
    for (const ref::Ray& ray : wrong) {
      ASSERT_TRUE(throws(ray)) << text_of(ray);
      ASSERT_TRUE(has_error(ray)) << text_of(ray);
    }
  }
  // Any patterns.
  for (int i = 0; i < 20'000; ++i) {
    ref::Ray ray = draw.ray();
    (draw.one_in(2) ? ray.direction : ray.origin)[static_cast<int>(draw.integer(0, 2))] = draw.pattern();
    if (draw.one_in(4)) ray.length = draw.pattern();
    ASSERT_EQ(has_error(ray), throws(ray)) << text_of(ray);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, IntRayUnit,
                         testing::Values("8+0/4s8", "16+1/11s16", "20+1/11s20t2", "24+3/13f3s32t8"),
                         [](const auto& format) { return design().parse_format(format.param).identifier(); });

/// With widths known when the code is compiled, as a synthesiser reads it.
TEST(IntRayWithKnownWidths, GivesTheSoftwaresRay) {
  using Format = hls::RayFormat<20, 1, 11, 0, 20, 2>;
  Draw draw(Format::bits, 41013);
  for (int i = 0; i < 200'000; ++i) {
    const ref::Ray ray = draw.ray();
    const Numbers operands = operands_of(ray);
    hls::IntRayOperands<hls::Native, Format> in;
    auto next = operands.begin();
    in.for_each(Format::bits, in, [&](const hls::Operand&, auto& field) { field.bits = *next++; });
    const auto out = hls::IntRay::test<hls::Native>(Format(), in);
    Numbers results;
    out.for_each(Format::bits, out,
                 [&](const hls::Result&, const auto& field) { results.push_back(field.to_int64()); });
    ASSERT_EQ(results, wanted(ray, Format::bits)) << text_of(ray);
  }
}

TEST(IntRayDesign, HasNoHit) {
  const std::vector<hls::Result> results = design().results(design().default_format);
  EXPECT_THROW(static_cast<void>(rtl::place_of_hit(results)), std::invalid_argument);
  EXPECT_EQ(rtl::verdict_of(results).place, 0U);
  const rtl::Evaluate unit = design().evaluate(design().default_format);
  const Numbers operands(7, 0);  // no direction
  EXPECT_EQ(message_of<std::logic_error>([&] { static_cast<void>(unit(operands.data())); }),
            "a design without HIT was asked for it");
  EXPECT_FALSE(unit.yes(results_of(unit, ref::Ray{}).data()));
  EXPECT_TRUE(unit.yes(results_of(unit, {{}, {1, 0, 0}}).data()));
}

TEST(IntRayDesign, HasVectorsOfWhichAThirdAreRays) {
  constexpr std::size_t count = 600;
  const Format format = design().default_format;
  const rtl::VectorSet set = design_vectors(design(), format, count, 5);
  const std::size_t rays = rtl::hits(set.all(), design().results(format));
  EXPECT_GT(rays, count / 4);
  EXPECT_LT(rays, count * 3 / 4);
  EXPECT_NE(rtl::vector_summary("int_ray", set, design().results(format)).find("have no error"),
            std::string::npos);
}

TEST(IntRayDesign, RefusesFormatsThatItsBoxesDoNotHave) {
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(design().parse_format("20+1/11f3s20")); }),
            "bits 20+1/11f3s20: no format of int_ray; allowed is n+g/psS or n+g/pfBsStF with n in 8..24, g "
            "in 0..3, "
            "p in 4..32, B in -2..3, S in 8..32, F in 1..8 and B at most g+F, for example 20+1/11s20");
  EXPECT_EQ(to_string(design().parse_format("20+1/11f3s20t2")), "20+1/11f3s20t2");
}

}  // namespace
}  // namespace hitpipe::sim::int_ray_test
