// A feed gives each slot the operands of its own ray and length, and of the box that is asked for.
#include "sim/software/feed.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hls/pipelines/int_slabs.hpp"
#include "rays/world/int_box.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sim/software/box_software.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::sim::feed_test {
namespace {

using ref::adversary::to_text;

using Operands = std::map<std::string, std::int64_t>;

/// Operands by the names of the Verilog's ports.
Operands by_port(const std::vector<rtl::Port>& ports, const std::vector<std::int64_t>& operands) {
  Operands named;
  EXPECT_EQ(ports.size(), operands.size());
  for (std::size_t i = 0; i < ports.size(); ++i) named[ports[i].name] = operands[i];
  return named;
}

/// What the set-up of this ray, box and length alone gives. The check of a design judges these.
Operands expected(const TestedUnit& unit, const ref::Ray& ray, float length, const ref::Aabb& box) {
  const auto test = make_box_test(unit.design(), unit.format);
  test->start({ray.origin, ray.direction, length});
  (void)test->hit(box);
  return by_port(unit.ports(), {test->operands().begin(), test->operands().end()});
}

class Feed : public testing::TestWithParam<TestedUnit> {};

TEST_P(Feed, GivesEachPortItsOperand) {
  const TestedUnit& unit = GetParam();
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  constexpr std::size_t slots = 3;
  const auto feed = make_feed(unit.design(), unit.format, bvh);
  const auto rays = feed->unit(slots);
  ref::adversary::Random random(6);
  const auto categories = ref::adversary::categories();
  std::vector<ref::Ray> set_up(slots);
  const std::vector<rtl::Port> ports = unit.ports();
  std::vector<std::int64_t> operands(ports.size());
  int checked = 0;
  for (int i = 0; i < 3'000; ++i) {
    const std::size_t slot = random.below(slots);
    if (i < 3 || random.below(4) == 0) {
      const std::size_t fresh = i < 3 ? static_cast<std::size_t>(i) : slot;
      set_up[fresh] = categories[random.below(categories.size())].make(random).ray;
      rays->start(fresh, set_up[fresh]);
    }
    if (i < 3) continue;
    // The ray's own length, then shorter lengths as closer hits are found, and the same length twice in a
    // row.
    float length = set_up[slot].length;
    if (random.coin()) length = random.coin() ? 0.0F : std::min(length, std::abs(random.signed_unit()));
    const auto node = static_cast<std::uint32_t>(random.below(bvh.nodes.size()));
    for (int again = 0; again < 2; ++again) {
      rays->operands(slot, {node, length}, operands.data());
      ASSERT_EQ(by_port(ports, operands), expected(unit, set_up[slot], length, bvh.nodes[node].box))
          << to_text(set_up[slot]);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 2 * 2'997);
}

INSTANTIATE_TEST_SUITE_P(Units, Feed, testing::ValuesIn(units_of_one_box()),
                         [](const auto& parameter) { return test_name(parameter.param); });

class CoarseFeed : public testing::TestWithParam<TestedUnit> {};

TEST_P(CoarseFeed, MovesOriginAndBoxAndNothingElse) {
  const TestedUnit& unit = GetParam();
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const ref::CoarseAxes coarse{{1, 2, 0}};
  const auto feed = make_feed(unit.design(), unit.format, bvh);
  const auto coarse_feed = make_feed(unit.design(), unit.format, bvh, coarse);
  const auto rays = feed->unit(1);
  const auto coarse_rays = coarse_feed->unit(1);
  const std::vector<rtl::Port> ports = unit.ports();
  const int n = unit.format.as<hls::IntBits>().coord;
  ref::adversary::Random random(8);
  const auto categories = ref::adversary::categories();
  std::vector<std::int64_t> operands(ports.size());
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    const ref::Ray ray = ref::adversary::halved(categories[random.below(categories.size())].make(random)).ray;
    rays->start(0, ray);
    coarse_rays->start(0, ray);
    for (std::uint32_t node = 0; node < bvh.nodes.size(); node += 7) {
      rays->operands(0, {node, ray.length}, operands.data());
      Operands expected = by_port(ports, operands);
      const auto at = [&](const char* port) { return static_cast<std::int32_t>(expected.at(port)); };
      const ref::IntOrigin origin = ref::coarse_origin({at("irx"), at("iry"), at("irz")}, coarse, n);
      const ref::IntBox box = ref::coarse_box(
          {{at("ixmin"), at("iymin"), at("izmin")}, {at("ixmax"), at("iymax"), at("izmax")}}, coarse, n);
      expected["irx"] = origin[0];
      expected["iry"] = origin[1];
      expected["ixmin"] = box.min[0];
      expected["iymin"] = box.min[1];
      expected["ixmax"] = box.max[0];
      expected["iymax"] = box.max[1];
      coarse_rays->operands(0, {node, ray.length}, operands.data());
      ASSERT_EQ(by_port(ports, operands), expected) << to_text(ray);
      ++checked;
    }
  }
  EXPECT_GT(checked, 5'000);
}

INSTANTIATE_TEST_SUITE_P(IntegerUnits, CoarseFeed,
                         testing::Values(TestedUnit{"int_slabs", hls::IntBits{12, 12}},
                                         TestedUnit{"int_plucker", hls::IntBits{20, 24}}),
                         [](const auto& parameter) { return test_name(parameter.param); });

/// One inner node, whose box has these corners.
ref::Bvh one_box(const glm::vec3& min, const glm::vec3& max) {
  ref::Bvh bvh;
  bvh.nodes.push_back({{min, max}, 1, 0});
  return bvh;
}

TEST(FeedThatCannotBe, IsRefused) {
  const Format bits = hls::IntBits{20, 24};
  EXPECT_EQ(message_of<std::invalid_argument>([] {
              (void)make_feed(rtl::find_design("fp_slabs"), Format(hls::Binary32{}), {}, {{1, 0, 0}});
            }),
            "coarse axes: origin or box is not an integer; take an integer design");
  const ref::Bvh whole_cube = one_box(glm::vec3(-1.0F), glm::vec3(1.0F));
  std::vector<std::int64_t> operands(int_slabs().ports(bits).size());
  EXPECT_EQ(message_of<std::out_of_range>([&] {
              make_feed(int_slabs(), bits, whole_cube, {{0, 3, 0}})
                  ->unit(1)
                  ->operands(0, {0, ref::Ray::infinite}, operands.data());
            }),
            "coarse axes: min.y = -262152 leaves the 20-bit grid; drop fewer than 3 low bits of y");
  rtl::Design unknown = int_slabs();
  unknown.name = "other";
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)make_feed(unknown, bits, {}); }),
            "design other: there is no set-up of rays and boxes for its operands");
  EXPECT_EQ(message_of<std::out_of_range>([&] {
              (void)make_feed(int_slabs(), bits, one_box(glm::vec3(-0.5F), {0.5F, 1.5F, 0.5F}));
            }),
            "quantise_box: max.y = 1.5 leaves the 20-bit grid; boxes must lie within [-1, 1]");
}

/// The operands of int_slabs, the planes of the box first.
template <class D, class F>
struct BoxFirstOperands : hls::IntSlabsOperands<D, F> {
  template <class Self, class Visit>
  static constexpr void for_each(const hls::IntBits& format, Self& self, Visit&& visit) {
    for (const bool planes : {true, false}) {
      hls::IntSlabsOperands<D, F>::for_each(format, self, [&](const hls::Operand& port, auto& field) {
        const bool plane = port.role == hls::Role::plane_low || port.role == hls::Role::plane_high;
        if (plane == planes) visit(port, field);
      });
    }
  }
};

struct BoxFirst : hls::int_slabs::IntSlabs {
  template <class D, class F>
  using Operands = BoxFirstOperands<D, F>;
};

class BoxFirstSetup {
 public:
  using Bits = hls::IntBits;
  using Operands = BoxFirstOperands<Words, Bits>;
  using Box = ref::IntBox;

  BoxFirstSetup(const ref::Ray& ray, const Format& format) : set_up_(ray, format.as<Bits>()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.as<Bits>().coord, out);
  }
  void fill(float length, Operands& in) const {
    const ref::IntSlabsRay& ray = set_up_.ray();
    put(ray.origin, in.irx, in.iry, in.irz);
    in.irlen = set_up_.length(length);
    put(ray.irdvc_floor, in.iri_floor, in.irj_floor, in.irk_floor);
    put(ray.irdvc_ceil, in.iri_ceil, in.irj_ceil, in.irk_ceil);
    in.rinf = std::isinf(length) ? 1 : 0;
  }

 private:
  ref::IntSlabsRaySetup set_up_;
};

TEST(ADesignThatListsTheBoxFirst, AnswersAsTheOneThatListsItLast) {
  const rtl::Design design = rtl::design_of<BoxFirst>();
  const Format format = hls::IntBits{12, 12};
  ASSERT_EQ(design.ports(format).front().role, hls::Role::plane_low);
  ASSERT_EQ(design.ports(format).back().role, hls::Role::endless);
  const ref::Bvh bvh = ref::build_bvh(hills().mesh);
  const auto last = make_feed(int_slabs(), format, bvh);
  const auto last_rays = last->unit(1);
  const auto first_scene = set_up_feed<BoxFirstSetup>(format, bvh);
  const auto first_rays = first_scene->unit(1);
  const auto first_test = set_up_test<BoxFirstSetup>(design, format);
  const auto last_test = make_box_test(int_slabs(), format);
  const rtl::Evaluate answers_first = design.evaluate(format);
  const rtl::Evaluate answers_last = int_slabs().evaluate(format);
  std::vector<std::int64_t> operands(design.ports(format).size());
  ref::adversary::Random random(29);
  int hits = 0;
  constexpr int tests = 2'000;
  for (int i = 0; i < tests; ++i) {
    const auto node = static_cast<std::uint32_t>(random.below(bvh.nodes.size()));
    const glm::vec3 from(random.signed_unit(), random.signed_unit(), random.signed_unit());
    const glm::vec3 to(random.signed_unit(), random.signed_unit(), random.signed_unit());
    const ref::Ray ray{from, (random.coin() ? to : bvh.nodes[node].box.max) - from,
                       random.coin() ? ref::Ray::infinite : 1.0F};
    last_test->start(ray);
    first_test->start(ray);
    const bool hit = last_test->hit(bvh.nodes[node].box);
    ASSERT_EQ(first_test->hit(bvh.nodes[node].box), hit) << to_text(ray);
    last_rays->start(0, ray);
    first_rays->start(0, ray);
    for (const float length : {ray.length, 0.5F}) {
      last_rays->operands(0, {node, length}, operands.data());
      const bool expected_hit = answers_last(operands.data());
      first_rays->operands(0, {node, length}, operands.data());
      ASSERT_EQ(answers_first(operands.data()), expected_hit) << to_text(ray);
    }
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, tests / 50);
  EXPECT_LT(hits, tests - tests / 50);
}

}  // namespace
}  // namespace hitpipe::sim::feed_test
