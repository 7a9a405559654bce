// Every possible tracer: it finds the same triangles as testing all of them, bundles do not change the
// counts, and a combination that does not exist gets one line.
#include "rays/trace/tracer.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/trace/slabs.hpp"
#include "sw_ref/hierarchy/fp_nodes.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/hierarchy/plain_nodes.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/trace/fp_slabs_safe.hpp"
#include "sw_ref/trace/int_major_pair.hpp"
#include "sw_ref/trace/int_plucker.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "sw_ref/trace/plucker.hpp"
#include "sw_ref/trace/store_tracer.hpp"
#include "sw_ref/trace/traversal.hpp"
#include "tests/message_of.hpp"
#include "tests/rays/trace/tracer_scenes.hpp"
#include "tests/sw_ref/quantise/major_formats.hpp"

namespace hitpipe::ref::tracer_test {
namespace {

constexpr unsigned seed = 17;

constexpr std::array algorithms{Algorithm::slabs, Algorithm::plu, Algorithm::slabs_dist, Algorithm::slabs_dsa,
                                Algorithm::plu_dsa};
constexpr std::array arithmetics{Arithmetic::binary32, Arithmetic::binary64, Arithmetic::conservative,
                                 Arithmetic::integer};
constexpr std::array encodings{Encoding::plain,           Encoding::hierarchical_4,  Encoding::hierarchical_8,
                               Encoding::hierarchical_12, Encoding::hierarchical_16, Encoding::wide4,
                               Encoding::wide8,           Encoding::wide4_float,     Encoding::wide8_float,
                               Encoding::pair6,           Encoding::pair8,           Encoding::pair10};

/// Children of a node that is loaded with their boxes; 0: nodes are loaded one by one.
std::uint64_t boxes_in(Encoding encoding) {
  switch (encoding) {
    case Encoding::wide4:
    case Encoding::wide4_float:
      return 4;
    case Encoding::wide8:
    case Encoding::wide8_float:
      return 8;
    case Encoding::pair6:
    case Encoding::pair8:
    case Encoding::pair10:
      return 2;
    default:
      return 0;
  }
}

std::string name(const TracerOptions& options) {
  return fmt::format("algorithm {} arithmetic {} encoding {} table {} bundle {} bits {}/{}",
                     static_cast<int>(options.algorithm), static_cast<int>(options.arithmetic),
                     static_cast<int>(options.encoding), options.look_up_table, options.bundle,
                     options.bits.coord, options.bits.interval);
}

/// Written independently of make_tracer().
bool exists(const TracerOptions& options) {
  const bool plucker = options.algorithm == Algorithm::plu || options.algorithm == Algorithm::plu_dsa;
  const bool by_distance = options.algorithm == Algorithm::slabs_dist;
  if (const std::uint64_t boxes = boxes_in(options.encoding); boxes != 0) {
    return (by_distance || (boxes == 2 && !plucker)) && options.arithmetic == Arithmetic::conservative &&
           !options.look_up_table && options.bundle == 1;
  }
  if (plucker && options.arithmetic == Arithmetic::conservative) return false;
  if (options.arithmetic == Arithmetic::integer) {
    return !by_distance && options.encoding == Encoding::plain && !options.look_up_table &&
           options.bundle == 1;
  }
  if (by_distance && options.bundle != 1) return false;
  return !options.look_up_table || options.encoding == Encoding::hierarchical_4 ||
         options.encoding == Encoding::hierarchical_8;
}

/// Every combination with the exact triangle test, and three formats of integers.
std::vector<TracerOptions> all_combinations() {
  std::vector<TracerOptions> all;
  for (const Algorithm algorithm : algorithms)
    for (const Arithmetic arithmetic : arithmetics)
      for (const Encoding encoding : encodings)
        for (const bool table : {false, true})
          for (const int bundle : {1, 64, 256})
            all.push_back({algorithm, arithmetic, encoding, table, bundle, {24, 24}, TriangleTest::exact});
  for (const Algorithm algorithm : algorithms)
    for (const hls::IntBits bits : {hls::IntBits{16, 16}, hls::IntBits{12, 20}})
      all.push_back({algorithm, Arithmetic::integer, Encoding::plain, false, 1, bits, TriangleTest::exact});
  return all;
}

/// A tracer of the thesis, or one that store_tracer() makes for a unit.
struct Kind {
  std::string name;
  TracerOptions options{};
  Tracing tracing{};
  std::function<std::unique_ptr<Tracer>(const Bvh&, const Leaves&, const Tracing&)> of_unit{};
  bool in_pairs = false;  ///< two boxes at a time

  [[nodiscard]] std::unique_ptr<Tracer> make(const Mesh& mesh, const Bvh& bvh) const {
    return of_unit ? of_unit(bvh, Leaves(mesh, bvh, options.triangle_test), tracing)
                   : make_tracer(mesh, bvh, options);
  }
};

/// Integers with coarser axes, six formats with a major axis, floats of 16 bits, and units without the ends
/// of rays.
std::vector<Kind> unit_tracers() {
  std::vector<Kind> all;
  const auto add = [&](const std::string& name, auto make_store, auto make_test, bool ends = true) {
    for (const ChildOrder order : {ChildOrder::fixed, ChildOrder::by_direction}) {
      all.push_back({.name = fmt::format("{} ends {} order {}", name, ends, static_cast<int>(order)),
                     .tracing = {.order = order, .ends = ends},
                     .of_unit = [=](const Bvh& bvh, const Leaves& leaves, const Tracing& tracing) {
                       return store_tracer(make_store(bvh), make_test, leaves, tracing);
                     }});
    }
  };
  const auto integers = [](int n, const CoarseAxes& coarse = {}, int finer = 0) {
    return [=](const Bvh& bvh) { return IntNodes(bvh, n, coarse, finer); };
  };
  for (const CoarseAxes coarse : {CoarseAxes{{0, 4, 0}}, CoarseAxes{{2, 1, 3}}}) {
    const std::string dropped = " dropped " + to_text(coarse);
    add("int slabs" + dropped, integers(12, coarse), IntSlabsTestMaker({12, 12}, coarse));
    add("int plucker" + dropped, integers(12, coarse), IntPluckerTestMaker({12, 12}, coarse));
  }
  const auto plain = [](const Bvh& bvh) { return PlainNodes(bvh); };
  add("slabs", plain, TestMaker<Slabs<float>>(), false);
  add("plucker", plain, TestMaker<Plucker<float>>(), false);
  add("int slabs", integers(16), IntSlabsTestMaker({16, 16}), false);
  add("int plucker", integers(16), IntPluckerTestMaker({16, 16}), false);
  for (const hls::MajorBits bits :
       {hls::MajorBits{}, hls::MajorBits{16, 0, 8}, hls::MajorBits{12, 2, 10, 3}, hls::MajorBits{8, 3, 6, -1},
        hls::MajorBits{6, 0, 4}, hls::MajorBits{32, 3, 28}})
    add("major " + name_of(bits), integers(bits.coord, {}, bits.finer), IntMajorTestMaker(bits));
  add("major", integers(hls::MajorBits{}.coord, {}, hls::MajorBits{}.finer), IntMajorTestMaker({}), false);
  add(
      "safe floats",
      [](const Bvh& bvh) {
        return FpNodes(bvh, {8, 7});
      },
      FpSlabsSafeTestMaker({8, 7}));
  for (const hls::MajorBits bits : {hls::MajorBits{20, 1, 13}, hls::MajorBits{8, 0, 5}}) {
    all.push_back({.name = "pair " + name_of(bits),
                   .of_unit = [=](const Bvh& bvh, const Leaves& leaves,
                                  const Tracing&) { return major_pair_tracer(bits, *leaves.mesh, bvh); },
                   .in_pairs = true});
  }
  return all;
}

std::vector<Kind> every_tracer() {
  std::vector<Kind> all = unit_tracers();
  for (const TracerOptions& options : all_combinations())
    if (exists(options)) all.push_back({.name = name(options), .options = options});
  return all;
}

struct Traced {
  std::vector<std::uint32_t> triangles;
  std::vector<TraceCounts> work;
  TraceCounts counts;
};

Traced traced(const Tracer& tracer, const std::vector<Ray>& rays, Query query) {
  Traced result;
  result.triangles.resize(rays.size());
  result.work.resize(rays.size());
  tracer.trace({rays, query, result.triangles, result.work}, result.counts);
  return result;
}

void expect_what_testing_every_triangle_finds(Random& random, const Mesh& mesh, const Bvh& bvh) {
  const std::vector<Ray> rays = special_rays(random, mesh, 300);
  std::vector<std::uint32_t> expected;
  for (const Ray& ray : rays) expected.push_back(test_every_triangle(mesh, ray).triangle);
  const auto misses = static_cast<std::size_t>(std::count(expected.begin(), expected.end(), Hit::none));
  EXPECT_LT(misses, rays.size() * 3 / 4);
  EXPECT_GT(misses, 0U);
  const std::vector<Kind> tracers = every_tracer();
  EXPECT_EQ(tracers.size(), 33U + 6 * 33 + 4 + 3 * 3 + 4 + 8 + 8 + 8 + 2 * 6 + 2 + 2 + 2);
  for (const Kind& kind : tracers) {
    const auto tracer = kind.make(mesh, bvh);
    const Traced closest = traced(*tracer, rays, Query::closest);
    const Traced any = traced(*tracer, rays, Query::any);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(closest.triangles[i], expected[i]) << kind.name << ": " << adversary::to_text(rays[i]);
      ASSERT_EQ(any.triangles[i] == Hit::none, expected[i] == Hit::none)
          << kind.name << ": " << adversary::to_text(rays[i]);
    }
    ASSERT_LE(any.counts.triangle_tests, closest.counts.triangle_tests) << kind.name;
  }
}

TEST(EveryTracer, FindsWhatTestingEveryTriangleFinds) {
  Random random(seed);
  const Mesh anywhere = soup(random, 400);
  expect_what_testing_every_triangle_finds(random, anywhere, build_bvh(anywhere, {.max_triangles = 6}));
  const Mesh on_grid = grid_soup(random, 120);
  expect_what_testing_every_triangle_finds(random, on_grid,
                                           build_bvh(on_grid, {.builder = Builder::sah, .max_triangles = 2}));
  const Mesh sheet = hills(12);
  expect_what_testing_every_triangle_finds(random, sheet, build_bvh(sheet, {.max_triangles = 1}));
}

class TracersOnHills : public testing::Test {
 protected:
  Mesh mesh_ = hills(24);
  Bvh bvh_ = build_bvh(mesh_);
  std::vector<Ray> rays_ = [this] {
    Random random(seed);
    std::vector<Ray> rays = coherent_rays({0.1F, 0.9F, 0.1F}, {0.2F, 0.0F, -0.3F}, 16);
    for (const Ray& ray : special_rays(random, mesh_, 100)) rays.push_back(ray);
    return rays;
  }();
};

TEST_F(TracersOnHills, BundlesTestWhatSingleRaysTest) {
  for (TracerOptions options : all_combinations()) {
    if (options.bundle == 1 || !exists(options)) continue;
    const auto bundled = make_tracer(mesh_, bvh_, options);
    options.bundle = 1;
    const auto single = make_tracer(mesh_, bvh_, options);
    for (const Query query : {Query::closest, Query::any}) {
      const Traced alone = traced(*single, rays_, query);
      const Traced together = traced(*bundled, rays_, query);
      ASSERT_EQ(together.counts.rays, rays_.size());
      for (std::size_t i = 0; i < rays_.size(); ++i) {
        ASSERT_EQ(together.work[i].box_tests, alone.work[i].box_tests) << name(options) << " ray " << i;
        ASSERT_EQ(together.work[i].triangle_tests, alone.work[i].triangle_tests)
            << name(options) << " ray " << i;
      }
      ASSERT_LT(3 * together.counts.nodes_loaded, alone.counts.nodes_loaded) << name(options);
      ASSERT_LT(2 * together.counts.triangles_loaded, alone.counts.triangles_loaded) << name(options);
    }
  }
}

TEST_F(TracersOnHills, WithoutTheEndsOfRaysMoreBoxesAreTested) {
  int compared = 0;
  for (Kind kind : unit_tracers()) {
    if (kind.tracing.ends) continue;
    const Traced endless = traced(*kind.make(mesh_, bvh_), rays_, Query::closest);
    kind.tracing.ends = true;
    const Traced ended = traced(*kind.make(mesh_, bvh_), rays_, Query::closest);
    EXPECT_GT(endless.counts.box_tests, ended.counts.box_tests) << kind.name;
    EXPECT_EQ(endless.triangles, ended.triangles) << kind.name;
    ++compared;
  }
  EXPECT_EQ(compared, 2 * 5);
}

TEST_F(TracersOnHills, LoadsOfSingleRaysAreTheirTestsAndWorkAddsUp) {
  for (const Kind& kind : every_tracer()) {
    const Traced result = traced(*kind.make(mesh_, bvh_), rays_, Query::closest);
    TraceCounts sum;
    for (const TraceCounts& work : result.work) sum += work;
    if (kind.options.bundle != 1) {
      sum.nodes_loaded = result.counts.nodes_loaded;
      sum.triangles_loaded = result.counts.triangles_loaded;
    } else if (kind.in_pairs) {
      // The root is one box.
      ASSERT_EQ(result.counts.box_tests, 2 * result.counts.nodes_loaded - rays_.size());
    } else if (const std::uint64_t boxes = boxes_in(kind.options.encoding); boxes != 0) {
      ASSERT_LE(result.counts.box_tests, boxes * result.counts.nodes_loaded) << kind.name;
      ASSERT_GT(result.counts.box_tests, result.counts.nodes_loaded) << kind.name;
      ASSERT_EQ(result.counts.triangles_loaded, result.counts.triangle_tests);
    } else {
      ASSERT_EQ(result.counts.nodes_loaded, result.counts.box_tests);
      ASSERT_EQ(result.counts.triangles_loaded, result.counts.triangle_tests);
    }
    ASSERT_EQ(sum, result.counts) << kind.name;
  }
}

TEST_F(TracersOnHills, OrderByDirectionOrDistanceSavesTests) {
  const auto tests = [&](Algorithm algorithm) {
    const TracerOptions options{.algorithm = algorithm, .arithmetic = Arithmetic::binary32};
    return traced(*make_tracer(mesh_, bvh_, options), rays_, Query::closest).counts;
  };
  // From above, child 1 is the near one of splits along y.
  EXPECT_LT(tests(Algorithm::slabs_dsa).box_tests, tests(Algorithm::slabs).box_tests);
  EXPECT_LT(tests(Algorithm::plu_dsa).box_tests, tests(Algorithm::plu).box_tests);
  EXPECT_LT(tests(Algorithm::slabs_dist).triangle_tests, tests(Algorithm::slabs).triangle_tests);
}

/// With 18 bits boxes are nearly exact, and to load both children at once is no other walk. Only the root's
/// box is not tested, and where distances are almost equal the order may change.
TEST_F(TracersOnHills, PairsOfManyBitsTestWhatSingleBoxesTest) {
  const auto counts = [&](Encoding encoding, Algorithm algorithm = Algorithm::slabs_dist) {
    const TracerOptions options{.algorithm = algorithm, .encoding = encoding};
    return traced(*make_tracer(mesh_, bvh_, options), rays_, Query::closest).counts;
  };
  const auto expect_near = [](std::uint64_t ours, std::uint64_t plain) {
    EXPECT_NEAR(static_cast<double>(ours), static_cast<double>(plain), 0.005 * static_cast<double>(plain));
  };
  const TraceCounts plain = counts(Encoding::plain);
  const TraceCounts pairs = counts(Encoding::pair10);
  expect_near(pairs.box_tests, plain.box_tests - rays_.size());
  expect_near(pairs.triangle_tests, plain.triangle_tests);
  // With their distances pairs drop a few leaves more than single boxes in the same order.
  for (const Algorithm algorithm : {Algorithm::slabs, Algorithm::slabs_dsa}) {
    const std::uint64_t single = counts(Encoding::plain, algorithm).triangle_tests;
    const std::uint64_t ours = counts(Encoding::pair10, algorithm).triangle_tests;
    EXPECT_LE(ours, single + single / 500);
    EXPECT_GE(ours, single - single / 100);
  }
  EXPECT_LT(counts(Encoding::pair10, Algorithm::slabs_dsa).box_tests,
            counts(Encoding::pair10, Algorithm::slabs).box_tests);
  EXPECT_LE(counts(Encoding::pair8).box_tests, counts(Encoding::pair6).box_tests);
  EXPECT_LE(counts(Encoding::wide8_float).triangle_tests, counts(Encoding::wide8).triangle_tests);
  EXPECT_LE(counts(Encoding::wide4_float).box_tests, counts(Encoding::wide4).box_tests);
  // All children of a node are sorted, so near triangles are found no later than in pairs.
  EXPECT_LE(counts(Encoding::wide4_float).triangle_tests, plain.triangle_tests);
  EXPECT_LE(counts(Encoding::wide8_float).triangle_tests, plain.triangle_tests);
}

TEST_F(TracersOnHills, HaveTheNodesOfTheirEncoding) {
  const auto bytes = [&](const TracerOptions& options) {
    return make_tracer(mesh_, bvh_, options)->bytes_per_node();
  };
  EXPECT_EQ(bytes({}), 32U);
  EXPECT_EQ(bytes({.arithmetic = Arithmetic::binary64}), 56U);
  EXPECT_EQ(bytes({.encoding = Encoding::hierarchical_4}), 8U);
  EXPECT_EQ(bytes({.encoding = Encoding::hierarchical_8}), 12U);
  const auto bytes_of_boxes = [&](Encoding encoding) {
    return bytes({.algorithm = Algorithm::slabs_dist, .encoding = encoding});
  };
  EXPECT_EQ(bytes_of_boxes(Encoding::wide4), 64U);
  EXPECT_EQ(bytes_of_boxes(Encoding::wide8), 80U);
  EXPECT_EQ(bytes_of_boxes(Encoding::wide4_float), 128U);
  EXPECT_EQ(bytes_of_boxes(Encoding::wide8_float), 256U);
  EXPECT_EQ(bytes_of_boxes(Encoding::pair6), 12U);
  EXPECT_EQ(bytes_of_boxes(Encoding::pair8), 16U);
  EXPECT_EQ(bytes_of_boxes(Encoding::pair10), 20U);
  EXPECT_EQ(bytes({.arithmetic = Arithmetic::integer, .bits = {20, 20}}), 23U);
  EXPECT_EQ(IntNodes(bvh_, 16, {{1, 0, 3}}).bytes_per_node, 19U);
  EXPECT_EQ(make_tracer(mesh_, bvh_, {})->node_count(), bvh_.nodes.size());
}

struct Recorder final : LoadObserver {
  std::vector<std::uint32_t> nodes, triangles;
  void node_loaded(std::uint32_t index) override { nodes.push_back(index); }
  void triangle_loaded(std::uint32_t index) override { triangles.push_back(index); }
};

TEST_F(TracersOnHills, ObserverIsToldEveryLoad) {
  const PlainNodes nodes(bvh_);
  const TestMaker<ConservativeSlabs> make_test;
  const Leaves leaves(mesh_, bvh_);
  for (const Tracing tracing : {Tracing{ChildOrder::by_direction}, Tracing{ChildOrder::by_distance},
                                Tracing{ChildOrder::by_direction, 64}}) {
    for (const Query query : {Query::closest, Query::any}) {
      Recorder recorder;
      TraceCounts counts;
      std::vector<std::uint32_t> triangles(rays_.size());
      trace_batch(TraceWith<PlainNodes, TestMaker<ConservativeSlabs>>{nodes, make_test, leaves, tracing},
                  {.rays = rays_, .query = query, .triangles = triangles, .loads = &recorder}, counts);
      EXPECT_EQ(recorder.nodes.size(), counts.nodes_loaded);
      EXPECT_EQ(recorder.triangles.size(), counts.triangles_loaded);
      EXPECT_EQ(recorder.nodes.front(), 0U);
      const std::set<std::uint32_t> told(recorder.triangles.begin(), recorder.triangles.end());
      for (const std::uint32_t found : triangles) EXPECT_TRUE(found == Hit::none || told.contains(found));
    }
  }
}

TEST_F(TracersOnHills, MoellerTrumboreNearlyAgreesWithTheExactTest) {
  const std::vector<std::uint32_t> exact =
      traced(*make_tracer(mesh_, bvh_, {}), rays_, Query::closest).triangles;
  for (const TriangleTest test : {TriangleTest::binary32, TriangleTest::binary64}) {
    std::size_t different = 0;
    for (const Algorithm algorithm : algorithms) {
      TracerOptions options{.algorithm = algorithm, .arithmetic = Arithmetic::binary64};
      options.triangle_test = test;
      const Traced result = traced(*make_tracer(mesh_, bvh_, options), rays_, Query::closest);
      for (std::size_t i = 0; i < rays_.size(); ++i) different += result.triangles[i] != exact[i] ? 1 : 0;
    }
    // The special rays aim at vertices, where rounding decides between a neighbour and no triangle.
    EXPECT_LT(different, algorithms.size() * 100);
  }
}

TEST(MoellerTrumboreTest, IsTwoSidedAndTakesTheNearestWithTiesToTheLowerIndex) {
  Mesh mesh;
  for (const float z : {0.5F, 0.25F, 0.25F, 0.75F}) add_triangle(mesh, {0, 0, z}, {0.5F, 0, z}, {0, 0.5F, z});
  const Bvh bvh = build_bvh(mesh);
  const Ray up{{0.125F, 0.125F, 0.0F}, {0, 0, 0.5F}, Ray::infinite};
  const Ray down{{0.125F, 0.125F, 0.9F}, {0, 0, -1}, Ray::infinite};
  const Ray as_long{up.origin, up.direction, 0.5F};
  const Ray too_short{up.origin, up.direction, 0.499F};
  const Ray beside{{-0.01F, 0.125F, 0.0F}, up.direction, Ray::infinite};
  const Ray in_plane{{-0.5F, 0.125F, 0.25F}, {1, 0, 0}, Ray::infinite};
  for (const TriangleTest test : {TriangleTest::binary32, TriangleTest::binary64}) {
    TracerOptions options;
    options.triangle_test = test;
    const std::vector<Ray> rays{up, down, as_long, too_short, beside, in_plane};
    EXPECT_THAT(traced(*make_tracer(mesh, bvh, options), rays, Query::closest).triangles,
                testing::ElementsAre(1, 3, 1, Hit::none, Hit::none, Hit::none));
  }
}

TEST(Tracer, DeepestHierarchyFitsTheStacks) {
  const Mesh mesh = one_triangle_a_level();
  const Bvh bvh = build_bvh(mesh, {.max_triangles = 1, .min_split = 0.0F});
  ASSERT_EQ(bvh.depth, BuildOptions::deepest);
  std::vector<Ray> rays(256, Ray{{0.95F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}});
  rays.resize(512, Ray{{-0.95F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}});
  for (Kind kind : every_tracer()) {
    if (kind.options.encoding != Encoding::plain && boxes_in(kind.options.encoding) == 0) continue;
    // The exact test is in doubt at nearly every triangle.
    kind.options.triangle_test = TriangleTest::binary64;
    const Traced result = traced(*kind.make(mesh, bvh), rays, Query::closest);
    EXPECT_EQ(result.triangles.front(), 0U) << kind.name;
    EXPECT_NE(result.triangles.back(), Hit::none) << kind.name;
    EXPECT_GE(result.work.front().box_tests, 3U) << kind.name;
  }
}

TEST(Tracer, CombinationsThatDoNotExistAreRejected) {
  const Mesh mesh = hills(4);
  const Bvh bvh = build_bvh(mesh);
  const auto message = [&](const TracerOptions& options) {
    return message_of<std::invalid_argument>([&] { (void)make_tracer(mesh, bvh, options); });
  };
  std::set<std::string> messages;
  for (const TracerOptions& options : all_combinations()) {
    const std::string said = message(options);
    EXPECT_EQ(said == "no exception", exists(options)) << name(options);
    if (!exists(options)) messages.insert(said);
  }
  messages.insert(message({.bundle = 2}));
  messages.insert(message({.arithmetic = Arithmetic::integer, .bits = {5, 24}}));
  EXPECT_THAT(
      messages,
      testing::UnorderedElementsAre(
          "tracer: conservative arithmetic is for slabs; with Pluecker take binary32 or binary64",
          "tracer: integer units give no distance; with integers take slabs, slabs_dsa, plu or plu_dsa",
          "tracer: integer arithmetic has nodes of its own; take the plain encoding",
          "tracer: a look-up table is for hierarchical nodes of 4 or 8 bits",
          "tracer: wide nodes and pairs are for single rays and conservative slabs, without a table",
          "tracer: wide nodes have the order by distance; take slabs_dist",
          "tracer: bundles of 2 rays; allowed are 1, 64 and 256",
          "tracer: the order by distance is of single rays; take bundle 1",
          "tracer: integer units take single rays; take bundle 1",
          "tracer: format 5/24; n must be 6 to 32 and t 6 to 2n-1"));
  const auto tracer = make_tracer(mesh, bvh, {});
  const std::vector<Ray> rays(2, Ray{{0, 0, 0}, {0, 1, 0}});
  std::vector<std::uint32_t> triangles(1);
  TraceCounts counts;
  EXPECT_THROW(tracer->trace({rays, Query::closest, triangles}, counts), std::invalid_argument);
}

}  // namespace
}  // namespace hitpipe::ref::tracer_test
