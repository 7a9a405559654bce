// The float unit that never misses, in e3m2: every origin, box and direction of one axis, and triples of axes
// by chance. The numbers are all numbers of the format, all halfway between two of them, and their
// neighbours.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "hls/box/format.hpp"
#include "hls/box/fp_format.hpp"
#include "hls/pipelines/fp_slabs_safe.hpp"
#include "rays/exact/box_referee.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"
#include "sw_ref/trace/fp_slabs_safe.hpp"

namespace hitpipe::ref::exhaustive {
namespace {

using hls::FpBits;

/// The same datapath with an instance of its own, which is fast.
struct NarrowSafe : hls::FpSlabsSafe {
  using BuiltIn = hls::FormatList<hls::FpFormat<3, 2>>;
};

constexpr FpBits bits{3, 2};

/// The numbers up to 1 with a fraction bit more than the format, and their neighbours in binary32.
std::vector<float> magnitudes(bool neighbours) {
  std::vector<float> all{0.0F};
  for (int eighths = 1; eighths < 8; ++eighths) all.push_back(static_cast<float>(eighths) * 0x1p-5F);
  for (int power = -2; power < 0; ++power)
    for (int eighths = 8; eighths < 16; ++eighths)
      all.push_back(std::ldexp(static_cast<float>(eighths), power - 3));
  all.push_back(1.0F);
  const std::size_t exact = all.size();
  for (std::size_t i = 1; neighbours && i < exact; ++i) {
    all.push_back(std::nextafter(all[i], 0.0F));
    if (all[i] < 1.0F) all.push_back(std::nextafter(all[i], 1.0F));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<float> with_signs(const std::vector<float>& magnitudes) {
  std::vector<float> all;
  for (const float x : magnitudes) all.insert(all.end(), {x, -x});
  return all;
}

/// A box, and its six planes as operands.
struct RoundedBox {
  explicit RoundedBox(const Aabb& box) : exact(box), rounded(round_box(box, bits)) {
    auto* out = planes.data();
    for (int axis = 0; axis < 3; ++axis) {
      *out++ = fp_pattern(rounded.min[axis], bits);
      *out++ = fp_pattern(rounded.max[axis], bits);
    }
  }
  Aabb exact, rounded;
  std::array<std::int64_t, 6> planes{};
};

class Judge {
 public:
  void start(const Ray& ray) {
    ray_ = ray;
    referee_.emplace(ray);
    const FpSlabsSafeRaySetup set_up(ray, bits);
    const FpSlabsSafeRay& r = set_up.ray();
    const FpSlabsSafeEnd end = set_up.end(ray.length);
    auto* out = operands_.data();
    for (const bool back : r.back) *out++ = back ? 1 : 0;
    for (const float x : r.origin_low) *out++ = fp_pattern(x, bits);
    for (const float x : r.origin_high) *out++ = fp_pattern(x, bits);
    *out++ = end.length;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *out++ = r.inverse_low[axis];
      *out++ = r.inverse_high[axis];
    }
    *out++ = end.endless ? 1 : 0;
    ASSERT_EQ(out + 6, operands_.data() + operands_.size());
  }
  /// Returns what the unit answers.
  bool judge(const RoundedBox& box) {
    std::copy(box.planes.begin(), box.planes.end(), operands_.end() - 6);
    const bool hit = evaluate_(operands_.data());
    const bool meets = referee_->meets(box.exact);
    ++tests;
    hits += meets ? 1 : 0;
    false_hits += hit && !meets ? 1 : 0;
    if (meets && !hit && false_misses++ == 0)
      ADD_FAILURE() << "missed: " << adversary::to_text(adversary::Case{ray_, box.exact});
    return hit;
  }

  std::uint64_t tests = 0, hits = 0, false_hits = 0, false_misses = 0;

 private:
  rtl::Evaluate evaluate_ = rtl::design_of<NarrowSafe>().evaluate(bits);
  Ray ray_;
  std::optional<BoxReferee> referee_;
  std::array<std::int64_t, 23> operands_{};
};

void print(const Judge& judge) {
  std::printf("%llu tests, %llu hits, %llu false hits\n", static_cast<unsigned long long>(judge.tests),
              static_cast<unsigned long long>(judge.hits), static_cast<unsigned long long>(judge.false_hits));
}

/// The ray crosses, touches or leaves out the slab of one axis. The slabs of the other axes hold it, and its
/// components there are 0, or 1 and so decide which inverses the axis has.
TEST(NarrowFloatUnit, NeverMissesOnOneAxis) {
  const std::vector<float> places = with_signs(magnitudes(false));
  std::vector<RoundedBox> boxes;
  for (const float min : places)
    for (const float max : places)
      if (min <= max) boxes.emplace_back(Aabb{{min, -1.0F, -0.5F}, {max, 1.0F, 1.0F}});
  Judge judge;
  for (const float origin : places) {
    for (const float component : places) {
      for (const float other : {0.0F, 1.0F}) {
        if (component == 0.0F && other == 0.0F) continue;
        for (const float length : {0.0F, 0.125F, 1.0F, Ray::infinite}) {
          judge.start({{origin, 0.0F, -0.5F}, {component, other, 0.0F}, length});
          for (const RoundedBox& box : boxes) (void)judge.judge(box);
        }
      }
    }
  }
  print(judge);
  EXPECT_EQ(judge.false_misses, 0U);
  EXPECT_GT(judge.hits, judge.tests / 10);
  EXPECT_LT(judge.false_hits, judge.tests / 3);
}

TEST(NarrowFloatUnit, NeverMissesOnTriplesOfAxes) {
  const std::vector<float> places = with_signs(magnitudes(true));
  adversary::Random random(18);
  const auto any = [&] { return places[random.below(places.size())]; };
  const auto point = [&] { return glm::vec3(any(), any(), any()); };
  Judge judge;
  for (int i = 0; i < 100'000; ++i) {
    glm::vec3 direction = point();
    if (direction == glm::vec3(0)) direction.x = 1.0F;
    // Small components have inverses up to the largest number, 14, and beyond.
    for (int axis = 0; axis < 3; ++axis) direction[axis] = std::ldexp(direction[axis], -random.between(0, 4));
    const float length = random.coin() ? Ray::infinite : std::abs(any()) * 4.0F;
    const Ray ray{point(), direction, length};
    judge.start(ray);
    const FpSlabsSafeTest software(ray, bits);
    for (int drawn_boxes = 0; drawn_boxes < 20; ++drawn_boxes) {
      Aabb drawn;
      drawn.grow(point());
      drawn.grow(point());
      const RoundedBox box(drawn);
      ASSERT_EQ(judge.judge(box), software(box.rounded)) << adversary::to_text(adversary::Case{ray, drawn});
    }
  }
  print(judge);
  EXPECT_EQ(judge.false_misses, 0U);
  EXPECT_GT(judge.hits, judge.tests / 20);
  EXPECT_LT(judge.false_hits, judge.tests / 3);
}

}  // namespace
}  // namespace hitpipe::ref::exhaustive
