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
  for (const Encoding encoding :
       {Encoding::plain, Encoding::hierarchical_4, Encoding::hierarchical_8, Encoding::wide4, Encoding::wide8,
        Encoding::wide8_float, Encoding::pair6, Encoding::pair8, Encoding::pair10}) {
    const auto tracer =
        make_tracer(scene_.mesh, bvh_, {.algorithm = Algorithm::slabs_dist, .encoding = encoding});
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

/// Two nodes of 16 bytes and three triangles in one array: node, triangles 1 and 2, node, triangle 0.
class TwoNodes final : public Tracer {
 public:
  void trace(const TraceJob&, TraceCounts&) const override {}
  [[nodiscard]] std::size_t bytes_per_node() const override { return 16; }
  [[nodiscard]] std::size_t node_count() const override { return 2; }
  [[nodiscard]] MemoryOrder memory_order() const override { return {triangles_, before_}; }

 private:
  std::vector<std::uint32_t> triangles_{1, 2, 0};
  std::vector<std::uint32_t> before_{0, 2};
};

TEST(SceneMemoryTogether, NodesAndTrianglesLieInOneArray) {
  Mesh mesh;
  mesh.vertices.resize(3);
  mesh.triangles.resize(3);
  const TwoNodes nodes;
  const auto lines = [&](TriangleLayout layout, const auto& load) {
    const CacheShape bytes{.bytes = 1 << 20, .line_bytes = 4};
    SceneMemory memory(mesh, {}, nodes, layout, {&bytes, 1});
    load(memory);
    return memory.reads().lines_fetched(0);
  };
  const auto all = [](SceneMemory& memory) {
    for (const std::uint32_t node : {1U, 0U}) memory.node_loaded(node);
    for (const std::uint32_t triangle : {0U, 1U, 2U}) memory.triangle_loaded(triangle);
  };
  EXPECT_EQ(lines(TriangleLayout::corners, all), (2 * 16 + 3 * 36) / 4) << "none lies on another";
  EXPECT_EQ(lines(TriangleLayout::indices, all), (2 * 16 + 3 * 4 + 3 * 12 + 12) / 4)
      << "also three numbers of each triangle, and one corner";
  const CacheShape whole{.bytes = 1 << 20, .line_bytes = 256};
  SceneMemory memory(mesh, {}, nodes, TriangleLayout::corners, {&whole, 1});
  all(memory);
  EXPECT_EQ(memory.reads().lines_fetched(0), 1U);
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
