// Blocks of the core's memory: what is written is read again, and what is damaged is refused.
#include "sw_ref/core/core_image.hpp"

#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/small_scene.hpp"

namespace hitpipe::ref::core_image_test {
namespace {

using testing::HasSubstr;

IntScene hills_in(const hls::WorldBits& bits, int max_triangles) {
  return int_scene(sim::hills(), bits, {.build = {.builder = Builder::sah, .max_triangles = max_triangles}});
}

TEST(CoreBlock, ReadsWhatWasWritten) {
  std::mt19937 random(1);
  const auto within = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random);
  };
  constexpr int most = (1 << 22) - 1;
  for (int i = 0; i < 10'000; ++i) {
    CoreRecord record;
    CoreTriangle triangle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      record.boxes.planes.min[axis] = within(-most, most);
      record.boxes.planes.max[axis] = within(-most, most);
      for (auto& corner : triangle.triangle.corners) corner[axis] = within(-most, most);
    }
    record.boxes.owners = static_cast<std::uint8_t>(within(0, 63));
    record.pointer = static_cast<std::uint32_t>(random());
    for (auto& count : record.counts) count = within(PairChild::none, CoreRecord::most_in_leaf);
    triangle.number = static_cast<std::uint32_t>(random());
    ASSERT_EQ(record_of(to_block(record)), record);
    ASSERT_EQ(triangle_of(to_block(triangle)), triangle);
  }
}

/// docs/core.md has these places.
TEST(CoreBlock, HasItsFieldsInTheirPlaces) {
  CoreRecord record;
  record.boxes.planes.min = {1, 2, -1};
  record.boxes.planes.max = {4, 5, 6};
  record.boxes.owners = 0b100001;
  record.pointer = 0x89abcdef;
  record.counts = {PairChild::branch, 3};
  EXPECT_EQ(to_block(record),
            (CoreBlock{0xffff'0000'0200'0001, 0x0600'0005'0000'04ff, 0x89ab'cdef'0021'0000, 0x3ff}));
}

TEST(CoreImage, HoldsTheScene) {
  for (const int max_triangles : {1, 2, 6}) {
    const IntScene scene = hills_in({}, max_triangles);
    const CoreImage image = core_image(scene);
    EXPECT_EQ(image.triangles, scene.mesh.triangles.size());
    EXPECT_EQ(image.blocks.size(), image.records + image.triangles);
    EXPECT_EQ(image.bytes(), 32 * image.blocks.size());
    const CoreImage again = checked_image(image.blocks);
    EXPECT_EQ(again.records, image.records);
    EXPECT_EQ(again.triangles, image.triangles);
    EXPECT_EQ(again.levels, image.levels);
  }
}

TEST(CoreImage, OfAnEmptyMeshHasARecordWithoutChildren) {
  Scene empty = sim::hills();
  empty.mesh = {};
  const CoreImage image = core_image(int_scene(empty, {}));
  ASSERT_EQ(image.blocks.size(), 1U);
  EXPECT_EQ(checked_image(image.blocks).triangles, 0U);
}

/// All triangles in one leaf.
TEST(CoreImage, SplitsALeafThatDoesNotFitItsCount) {
  IntScene scene = hills_in({}, 6);
  Bvh& bvh = *scene.bvh;
  const auto all = static_cast<std::int32_t>(scene.mesh.triangles.size());
  ASSERT_GT(all, CoreRecord::most_in_leaf);
  bvh.nodes.resize(1);
  bvh.nodes[0].count = all;
  bvh.nodes[0].first = 0;
  const CoreImage image = core_image(scene);
  EXPECT_EQ(image.triangles, static_cast<std::uint32_t>(all));
  EXPECT_EQ(image.records, 2U) << "the root's own, and one whose children are the halves";
  EXPECT_EQ(checked_image(image.blocks).levels, 2);
}

struct Damage {
  const char* name;
  std::function<void(std::vector<CoreBlock>&)> change;
  const char* said;
};
void PrintTo(const Damage& damage, std::ostream* out) {
  *out << damage.name;
}

void change_record(std::vector<CoreBlock>& blocks, std::size_t at,
                   const std::function<void(CoreRecord&)>& change) {
  CoreRecord record = record_of(blocks[at]);
  change(record);
  blocks[at] = to_block(record);
}
std::size_t last_triangle(const std::vector<CoreBlock>& blocks) {
  return blocks.size() - 1;
}

class DamagedImage : public testing::TestWithParam<Damage> {};

TEST_P(DamagedImage, IsRefused) {
  std::vector<CoreBlock> blocks = core_image(hills_in({}, 2)).blocks;
  GetParam().change(blocks);
  try {
    (void)checked_image(std::move(blocks));
    FAIL() << "nothing was said";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().said));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Images, DamagedImage,
    testing::Values(
        Damage{"Empty", [](auto& b) { b.clear(); }, "the image is empty"},
        Damage{"Outside", [](auto& b) { change_record(b, 1, [](CoreRecord& r) { r.pointer = 1'000'000; }); },
               "a child lies outside the image"},
        Damage{"Cut", [](auto& b) { b.pop_back(); }, "a child lies outside the image"},
        Damage{"Loop", [](auto& b) { change_record(b, 1, [](CoreRecord& r) { r.pointer = 0; }); },
               "two records lead to it, or a loop"},
        Damage{"Unreached", [](auto& b) { b.push_back({}); }, "nothing leads to it"},
        Damage{"SecondRoot", [](auto& b) { change_record(b, 0, [](CoreRecord& r) { r.counts[1] = 1; }); },
               "the root's own record has a second child"},
        Damage{"SmallBox",
               [](auto& b) {
                 CoreTriangle last = triangle_of(b[last_triangle(b)]);
                 last.triangle.corners[0][0] = 262'143;
                 last.triangle.corners[1][0] = -262'143;
                 b[last_triangle(b)] = to_block(last);
               },
               "its leaf's box does not hold the triangle whole"},
        Damage{"NoNumber",
               [](auto& b) {
                 CoreTriangle last = triangle_of(b[last_triangle(b)]);
                 last.number = IntHit::none;
                 b[last_triangle(b)] = to_block(last);
               },
               "a triangle with the number of none"},
        Damage{"WideBox",
               [](auto& b) { change_record(b, 1, [](CoreRecord& r) { r.boxes.planes.max[0] = 262'143; }); },
               "a child's box is not inside its parent's"}),
    [](const testing::TestParamInfo<Damage>& each) { return each.param.name; });

}  // namespace
}  // namespace hitpipe::ref::core_image_test
