// What a traversal reads: bytes without a cache follow from its counts, for every kind of tracer, and lines
// are those of the addresses.
#include "sw_ref/memory/scene_memory.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "sw_ref/memory/read_bytes.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::ref::scene_memory_test {
namespace {

constexpr CacheShape four_kib{.bytes = 4 << 10};

TEST(ReadCounter, CountsBytesAndLines) {
  ReadCounter reads({&four_kib, 1});
  const std::uint64_t one = reads.add_array(100);
  const std::uint64_t other = reads.add_array(1);
  EXPECT_EQ(other - one, ReadCounter::alignment) << "no line holds parts of two arrays";
  reads.read(one + 60, 8);
  EXPECT_EQ(reads.lines_fetched(0), 2U) << "over the end of a line";
  reads.read(one, 100);
  EXPECT_EQ(reads.lines_fetched(0), 2U);
  reads.read(other, 1);
  EXPECT_EQ(reads.lines_fetched(0), 3U);
  EXPECT_EQ(reads.bytes_fetched(0), 3U * 64);
  EXPECT_EQ(reads.bytes_read(), 109U);
}

class MemoryOfHills : public testing::Test {
 protected:
  [[nodiscard]] ReadBytes traced(const Tracer& tracer, TriangleLayout layout) const {
    return read_bytes(tracer, scene_.mesh, bvh_, batches_, layout, usual_caches());
  }
  [[nodiscard]] TraceCounts counts(const Tracer& tracer) const {
    return measure(tracer, batches_, 1).counts.total();
  }

  const Scene scene_ = sim::hills();
  const Bvh bvh_ = build_bvh(scene_.mesh, surface_area_build);
  const std::vector<RecordedBatch> batches_ = record_rays(scene_, bvh_, 32, 24, 1);
};

TEST_F(MemoryOfHills, HasTheBytesOfItsLoads) {
  for (const Encoding encoding : {Encoding::plain, Encoding::hierarchical_4, Encoding::hierarchical_8}) {
    const auto tracer = make_tracer(
        scene_.mesh, bvh_,
        {.algorithm = Algorithm::plu_dsa, .arithmetic = Arithmetic::binary32, .encoding = encoding});
    const TraceCounts loads = counts(*tracer);
    const ReadBytes corners = traced(*tracer, TriangleLayout::corners);
    EXPECT_EQ(corners.rays, loads.rays);
    EXPECT_EQ(corners.without_cache,
              loads.nodes_loaded * tracer->bytes_per_node() + loads.triangles_loaded * 36);
    const ReadBytes indices = traced(*tracer, TriangleLayout::indices);
    EXPECT_EQ(indices.without_cache,
              loads.nodes_loaded * tracer->bytes_per_node() + loads.triangles_loaded * 52);
    for (const ReadBytes& result : {corners, indices}) {
      EXPECT_LT(result.behind[0], result.without_cache);
      EXPECT_LE(result.behind[1], result.behind[0]);
      EXPECT_LE(result.behind[2], result.behind[1]);
      EXPECT_GT(result.behind[2], 0U);
    }
  }
}

/// Smaller nodes are fewer lines, also behind a cache.
TEST_F(MemoryOfHills, SmallNodesAreFewerLines) {
  const auto fetched = [&](Encoding encoding) {
    const auto tracer = make_tracer(
        scene_.mesh, bvh_,
        {.algorithm = Algorithm::plu_dsa, .arithmetic = Arithmetic::binary32, .encoding = encoding});
    return traced(*tracer, TriangleLayout::corners).behind[0];
  };
  EXPECT_LT(fetched(Encoding::hierarchical_8), fetched(Encoding::plain));
}

}  // namespace
}  // namespace hitpipe::ref::scene_memory_test
