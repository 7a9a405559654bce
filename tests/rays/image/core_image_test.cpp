// Blocks of the core's memory: what is written is read again, and what is damaged is refused.
#include "rays/image/core_image.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/world/int_triangle.hpp"
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
    ASSERT_EQ(record_of(to_block(record, 24)), record);
    ASSERT_EQ(triangle_of(to_block(triangle, 24)), triangle);
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
  EXPECT_EQ(to_block(record, 20), (CoreBlock{0xffff'0000'0200'0001, 0x0600'0005'0000'04ff,
                                             0x89ab'cdef'0021'0000, 0x5400'0000'0000'03ff}));
  CoreTriangle triangle;
  triangle.triangle.corners = {{{1, 2, 3}, {4, 5, 6}, {7, 8, -1}}};
  triangle.number = 0x89abcdef;
  EXPECT_EQ(to_block(triangle, 9), (CoreBlock{0x0003'0000'0200'0001, 0x0600'0005'0000'0400,
                                              0x0000'0800'0007'0000, 0x6989'abcd'efff'ffff}));
}

/// docs/core.md has these places too.
TEST(CoreHeader, HasItsFieldsInTheirPlaces) {
  std::vector<CoreBlock> blocks(4);
  const CoreHeader header{.coord_bits = 20,
                          .levels = 17,
                          .triangles = 5,
                          .missing = 3,
                          .most_in_leaf = 6,
                          .to_cube = {.offset = {1.0, -2.0, 0.5}, .scale = 0.25}};
  put_header(blocks, header);
  EXPECT_EQ(blocks[1], (CoreBlock{0x0265'7069'7074'6968, 0x0000'0004'0006'1114, 0x0000'0003'0000'0005, 0}));
  EXPECT_EQ(blocks[2], (CoreBlock{0x3ff0'0000'0000'0000, 0xc000'0000'0000'0000, 0x3fe0'0000'0000'0000, 0}));
  EXPECT_EQ(blocks[3], (CoreBlock{0x3fd0'0000'0000'0000, blocks[3][1], 0, 0}));
  const CoreHeader again = header_of(blocks);
  EXPECT_EQ(again.coord_bits, 20);
  EXPECT_EQ(again.levels, 17);
  EXPECT_EQ(again.triangles, 5U);
  EXPECT_EQ(again.missing, 3U);
  EXPECT_EQ(again.most_in_leaf, 6);
  EXPECT_EQ(again.to_cube.offset, header.to_cube.offset);
  EXPECT_EQ(again.to_cube.scale, 0.25);
}

TEST(CoreHeader, SeesEachBitThatChanges) {
  const std::vector<CoreBlock> blocks = core_image(hills_in({}, 2)).blocks;
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<CoreBlock> changed = blocks;
    changed[random() % changed.size()][random() % 4] ^= std::uint64_t{1} << random() % 64;
    EXPECT_THROW((void)header_of(changed), std::runtime_error);
  }
}

TEST(CoreImage, HoldsTheScene) {
  for (const int max_triangles : {1, 2, 6}) {
    const IntScene scene = hills_in({}, max_triangles);
    const CoreImage image = core_image(scene);
    EXPECT_EQ(image.header.triangles, scene.mesh.triangles.size());
    const std::size_t used = image.records + image.header.triangles + header_blocks;
    EXPECT_EQ(image.blocks.size(), used + used % 2) << "whole lines of 64 bytes";
    EXPECT_EQ(image.header.to_cube.scale, scene.scene.to_cube.scale);
    EXPECT_EQ(image.bytes(), 32 * image.blocks.size());
    const CoreImage again = checked_image(image.blocks);
    EXPECT_EQ(again.records, image.records);
    EXPECT_EQ(again.header.triangles, image.header.triangles);
    EXPECT_EQ(again.header.levels, image.header.levels);
    EXPECT_EQ(again.header.most_in_leaf, image.header.most_in_leaf);
  }
}

TEST(CoreImage, OfAnEmptyMeshHasARecordWithoutChildren) {
  Scene empty = sim::hills();
  empty.mesh = {};
  const CoreImage image = core_image(int_scene(empty, {}));
  ASSERT_EQ(image.blocks.size(), 1U + header_blocks);
  EXPECT_EQ(checked_image(image.blocks).header.triangles, 0U);
}

/// All ones of either is no number.
TEST(CoreHeader, SaysHowManyBitsACoreNeeds) {
  const auto numbers = [](std::uint32_t triangles, std::uint32_t missing) {
    return CoreHeader{.triangles = triangles, .missing = missing}.number_bits();
  };
  EXPECT_EQ(numbers(0, 0), 0);
  EXPECT_EQ(numbers(15, 0), 4);
  EXPECT_EQ(numbers(16, 0), 5);
  EXPECT_EQ(numbers(15, 241), 9);
  EXPECT_EQ(numbers(0xffff'ffff, 0), 32);
  const auto leaves = [](int most) { return CoreHeader{.most_in_leaf = most}.leaf_bits(); };
  EXPECT_EQ(leaves(2), 2);
  EXPECT_EQ(leaves(3), 3);
  EXPECT_EQ(leaves(6), 3);
  EXPECT_EQ(leaves(7), 4);
  EXPECT_EQ(leaves(CoreRecord::most_in_leaf), 8);
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
  EXPECT_EQ(image.header.triangles, static_cast<std::uint32_t>(all));
  EXPECT_EQ(image.records, 2U) << "the root's own, and one whose children are the halves";
  EXPECT_EQ(checked_image(image.blocks).header.levels, 2);
}

struct Damage {
  const char* name;
  std::function<void(std::vector<CoreBlock>&)> change;
  const char* said;
  const char* said_with_checksum = nullptr;
};
void PrintTo(const Damage& damage, std::ostream* out) {
  *out << damage.name;
}

void change_record(std::vector<CoreBlock>& blocks, std::size_t at,
                   const std::function<void(CoreRecord&)>& change) {
  CoreRecord record = record_of(blocks[at]);
  change(record);
  blocks[at] = to_block(record, hls::WorldBits().coord);
}
std::size_t last_triangle(const std::vector<CoreBlock>& blocks) {
  return blocks.size() - (blocks.back() == CoreBlock{} ? 2 : 1);
}
void change_triangle(std::vector<CoreBlock>& blocks, const std::function<void(CoreTriangle&)>& change) {
  CoreTriangle last = triangle_of(blocks[last_triangle(blocks)]);
  change(last);
  blocks[last_triangle(blocks)] = to_block(last, hls::WorldBits().coord);
}
/// The first record behind the header.
constexpr std::size_t top = 1 + header_blocks;

class DamagedImage : public testing::TestWithParam<Damage> {};

void expect_refused(std::vector<CoreBlock> blocks, const char* said) {
  try {
    (void)checked_image(std::move(blocks));
    FAIL() << "nothing was said";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(said));
  }
}

TEST_P(DamagedImage, IsRefused) {
  std::vector<CoreBlock> blocks = core_image(hills_in({}, 2)).blocks;
  GetParam().change(blocks);
  expect_refused(std::move(blocks), GetParam().said);
}

/// Somebody wrote the header of what is damaged.
TEST_P(DamagedImage, IsRefusedWithARightChecksum) {
  CoreImage image = core_image(hills_in({}, 2));
  const CoreHeader header = image.header;
  GetParam().change(image.blocks);
  if (GetParam().said_with_checksum == nullptr) return;
  put_header(image.blocks, header);
  expect_refused(std::move(image.blocks), GetParam().said_with_checksum);
}

constexpr const char* differs = "the checksum differs";

INSTANTIATE_TEST_SUITE_P(
    Images, DamagedImage,
    testing::Values(
        Damage{"Empty", [](auto& b) { b.clear(); }, "there is no header"},
        Damage{"Zeros", [](auto& b) { b.assign(b.size(), {}); }, "there is no header"},
        Damage{"OtherVersion", [](auto& b) { b[1][0] += std::uint64_t{1} << 56; },
               "the image has version 3 of its layout; allowed is 2"},
        Damage{"TriangleInTheHeader", [](auto& b) { b[3][3] = b[last_triangle(b)][3]; }, differs,
               "as its word 11; allowed is 0"},
        Damage{"Cut", [](auto& b) { b.resize(b.size() - 2); }, "blocks; allowed are",
               "a child lies outside the image"},
        Damage{"CutInALine", [](auto& b) { b.pop_back(); }, "blocks; allowed are",
               "allowed is an even number"},
        Damage{"HalfWritten",
               [](auto& b) {
                 std::fill(b.begin() + static_cast<std::ptrdiff_t>(b.size() / 2), b.end(), CoreBlock{});
               },
               "the checksum differs", "of this grid"},
        Damage{"Outside",
               [](auto& b) { change_record(b, top, [](CoreRecord& r) { r.pointer = 1'000'000; }); }, differs,
               "a child lies outside the image"},
        Damage{"Loop", [](auto& b) { change_record(b, top, [](CoreRecord& r) { r.pointer = 0; }); }, differs,
               "two records lead to it, or a loop"},
        Damage{"Unreached", [](auto& b) { b.insert(b.end(), 2, {}); }, "blocks; allowed are",
               "nothing leads to it"},
        Damage{"SecondRoot", [](auto& b) { change_record(b, 0, [](CoreRecord& r) { r.counts[1] = 1; }); },
               differs, "the root's own record has a second child"},
        Damage{"OtherGrid", [](auto& b) { b[0] = to_block(record_of(b[0]), 16); }, differs,
               "block 0 of the image: it is no record of this grid"},
        Damage{"TriangleForRecord", [](auto& b) { b[top] = b[last_triangle(b)]; }, differs,
               "it is no record of this grid"},
        Damage{"RecordForTriangle", [](auto& b) { b[last_triangle(b)] = b[0]; }, differs,
               "it is no triangle of this grid"},
        Damage{"SmallBox",
               [](auto& b) {
                 change_triangle(b, [](CoreTriangle& last) {
                   last.triangle.corners[0][0] = 262'143;
                   last.triangle.corners[1][0] = -262'143;
                 });
               },
               differs, "its leaf's box does not hold the triangle whole"},
        Damage{"NoNumber",
               [](auto& b) { change_triangle(b, [](CoreTriangle& last) { last.number = IntHit::none; }); },
               differs, "a triangle with the number of none"},
        Damage{"NumberOfAnother",
               [](auto& b) {
                 change_triangle(b, [&](CoreTriangle& last) { last.number = last.number == 0 ? 1 : 0; });
               },
               differs, "two triangles of the image have the number "},
        Damage{"NumberOfNoTriangle",
               [](auto& b) { change_triangle(b, [](CoreTriangle& last) { last.number = 288; }); }, differs,
               "the image has a triangle 288, but its header says that the mesh has 288 triangles"},
        Damage{"NoArea",
               [](auto& b) {
                 change_triangle(
                     b, [](CoreTriangle& last) { last.triangle.corners[0] = last.triangle.corners[1]; });
               },
               differs, "a triangle without area"},
        Damage{"WideBox",
               [](auto& b) { change_record(b, top, [](CoreRecord& r) { r.boxes.planes.max[0] = 262'143; }); },
               differs, "a child's box is not inside its parent's"}),
    [](const testing::TestParamInfo<Damage>& each) { return each.param.name; });

/// A header whose counts are wrong, with a right checksum.
TEST(CoreHeader, IsRefusedWhenItDoesNotTellTheTruth) {
  const CoreImage image = core_image(hills_in({}, 2));
  const auto with = [&](CoreHeader header) {
    std::vector<CoreBlock> blocks = image.blocks;
    put_header(blocks, header);
    return blocks;
  };
  CoreHeader header = image.header;
  ++header.levels;
  expect_refused(with(header), "levels, but its header says");
  header = image.header;
  for (const int lie : {-1, 1}) {
    header.most_in_leaf = image.header.most_in_leaf + lie;
    expect_refused(with(header), "triangles in a leaf, but its header says");
  }
  header = image.header;
  --header.triangles;
  expect_refused(with(header), "triangles, but its header says");
  header = image.header;
  header.coord_bits = 19;
  expect_refused(with(header), "block 0 of the image: it is no record of this grid");
  header.coord_bits = 25;
  expect_refused(with(header), "the header says a grid of 25 bits; allowed is 4 to 24");
  header = image.header;
  header.to_cube.scale = 0;
  expect_refused(with(header), "and the scale 0; allowed are finite numbers, and a scale above 0");
  header.to_cube = {.offset = {0, std::numeric_limits<double>::infinity(), 0}};
  expect_refused(with(header), "the header has the offset (0, inf, 0) and the scale 1; allowed");
}

/// Larger than what it holds, so corners of the image are outside its cube, and boxes that hold them.
TEST(CoreImage, IsRefusedWithABoxOutsideItsCube) {
  IntScene scene = hills_in({}, 2);
  for (IntTriangle& triangle : scene.mesh.triangles)
    for (auto& corner : triangle.corners)
      for (std::int32_t& x : corner) x *= 2;
  expect_refused(core_image(scene).blocks, "a plane lies outside the cube");
}

}  // namespace
}  // namespace hitpipe::ref::core_image_test
