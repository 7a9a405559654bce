// Operands are what ray set-up and quantisation say (section 6.2.1), each at its own port.
#include "sim/feed.hpp"

#include <map>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_ray.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim {
namespace {

/// Operands by the names of the Verilog's ports.
std::map<std::string, std::int64_t> by_port(hls::IntBits bits, const std::vector<std::int64_t>& operands) {
  std::map<std::string, std::int64_t> named;
  const auto ports = rtl::input_ports(int_slabs().trace(bits));
  EXPECT_EQ(ports.size(), operands.size());
  for (std::size_t i = 0; i < ports.size(); ++i) named[ports[i].name] = operands[i];
  return named;
}

std::map<std::string, std::int64_t> expected(hls::IntBits bits, const ref::Ray& ray, float length,
                                             const ref::Aabb& box) {
  const ref::IntRaySetup setup(ray, bits);
  const ref::IntRay& r = setup.ray();
  const ref::IntBox b = ref::quantise_box(box, bits.coord);
  return {{"irx", r.origin[0]},
          {"iry", r.origin[1]},
          {"irz", r.origin[2]},
          {"irlen", setup.length(length)},
          {"rinf", std::isinf(length) ? 1 : 0},
          {"iri_floor", r.irdvc_floor[0]},
          {"irj_floor", r.irdvc_floor[1]},
          {"irk_floor", r.irdvc_floor[2]},
          {"iri_ceil", r.irdvc_ceil[0]},
          {"irj_ceil", r.irdvc_ceil[1]},
          {"irk_ceil", r.irdvc_ceil[2]},
          {"ixmin", b.min[0]},
          {"iymin", b.min[1]},
          {"izmin", b.min[2]},
          {"ixmax", b.max[0]},
          {"iymax", b.max[1]},
          {"izmax", b.max[2]}};
}

class Feed : public testing::TestWithParam<hls::IntBits> {};

TEST_P(Feed, GivesEachPortItsOperand) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  constexpr std::size_t slots = 3;
  const auto feed = make_feed(int_slabs(), GetParam(), bvh);
  const auto rays = feed->unit(slots);
  std::mt19937 random(6);
  std::uniform_real_distribution<float> coordinate(-1.0F, 1.0F);
  std::vector<ref::Ray> set_up(slots);
  std::vector<std::int64_t> operands(17);
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const std::size_t slot = random() % slots;
    if (i < 3 || random() % 4 == 0) {
      const std::size_t fresh = i < 3 ? static_cast<std::size_t>(i) : slot;
      set_up[fresh] = {{coordinate(random), coordinate(random), coordinate(random)},
                       {coordinate(random), coordinate(random), coordinate(random)},
                       random() % 2 == 0 ? ref::Ray::infinite : 2.0F * std::abs(coordinate(random))};
      rays->start(fresh, set_up[fresh]);
    }
    if (i < 3) continue;
    // First the ray's own length, then shorter ones, as closer hits are found; the same one twice in a row.
    const float share = static_cast<float>(random() % 3) / 2.0F;
    const float length = share == 1.0F ? set_up[slot].length : share;
    const auto node = static_cast<std::uint32_t>(random() % bvh.nodes.size());
    for (int again = 0; again < 2; ++again) {
      rays->operands(slot, node, length, operands.data());
      EXPECT_EQ(by_port(GetParam(), operands),
                expected(GetParam(), set_up[slot], length, bvh.nodes[node].box));
      ++checked;
    }
  }
  EXPECT_EQ(checked, 594);
}

INSTANTIATE_TEST_SUITE_P(Formats, Feed, testing::ValuesIn(formats),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST(FeedOfAnotherDesign, Rejected) {
  rtl::Design unknown = int_slabs();
  unknown.name = "other";
  try {
    (void)make_feed(unknown, {20, 24}, {});
    ADD_FAILURE() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "design other: there is no set-up of rays and boxes for its operands");
  }
}

TEST(FeedOfABoxOutsideTheCube, Rejected) {
  ref::Bvh bvh;
  bvh.nodes.push_back({{glm::vec3(-0.5F), {0.5F, 1.5F, 0.5F}}, 1, 0});
  try {
    (void)make_feed(int_slabs(), {20, 24}, bvh);
    ADD_FAILURE() << "no error";
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(),
                 "quantise_box: max.y = 1.5 leaves the 20-bit grid; boxes must lie within [-1, 1]");
  }
}

}  // namespace
}  // namespace hitpipe::sim
