// The generic tracer of a design finds the triangles that its own tracer finds, with as many tests.
#include "sim/cosim/generic_tracer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sw_ref/render/recording.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::generic_tracer_test {
namespace {

class GenericTracer : public testing::Test {
 protected:
  struct Traced {
    std::vector<std::uint32_t> triangles;
    std::vector<ref::TraceCounts> work;
    ref::TraceCounts counts;
    friend bool operator==(const Traced&, const Traced&) = default;
  };

  [[nodiscard]] Traced traced(const ref::Tracer& tracer) const {
    Traced all;
    for (const ref::RecordedBatch& batch : batches_) {
      std::vector<std::uint32_t> triangles(batch.rays.size());
      std::vector<ref::TraceCounts> work(batch.rays.size());
      tracer.trace({batch.rays, batch.query, triangles, work}, all.counts);
      all.triangles.insert(all.triangles.end(), triangles.begin(), triangles.end());
      all.work.insert(all.work.end(), work.begin(), work.end());
    }
    return all;
  }
  /// Both tracers of a unit; true if it has one of its own.
  bool compare(const rtl::Design& design, const TracedUnit& unit) const {
    if (software_of(design).tracer == nullptr) return false;
    const std::unique_ptr<ref::Tracer> own = make_tracer(design, unit, scene_.mesh, bvh_);
    const std::unique_ptr<ref::Tracer> generic = generic_tracer(design, unit, scene_.mesh, bvh_);
    const Traced expected = traced(*own);
    EXPECT_GT(expected.counts.triangle_tests, 0U);
    EXPECT_EQ(traced(*generic), expected)
        << fmt::format("{} dropped {} ends {}", design.name_at(unit.format), to_text(unit.coarse), unit.ends);
    if (software_of(design).bytes_per_node == nullptr) {
      EXPECT_EQ(generic->bytes_per_node(), own->bytes_per_node()) << design.name;
    }
    return true;
  }

  ref::Scene scene_ = hills();
  ref::Bvh bvh_ = ref::build_bvh(scene_.mesh);
  std::vector<ref::RecordedBatch> batches_ = ref::record_rays(scene_, bvh_, 24, 24, 1);
};

TEST_F(GenericTracer, FindsAndCountsWhatTheDesignsOwnTracerDoes) {
  int compared = 0;
  for (const rtl::Design& design : rtl::designs()) {
    if (!why_not_traced(design).empty()) continue;
    compared += compare(design, {design.default_format}) ? 1 : 0;
    for (const Format& format : software_of(design).stiffness_formats) compare(design, {format});
  }
  EXPECT_GT(compared, 0);
}

TEST_F(GenericTracer, DoesSoOnCoarseAxesAndWithoutTheEndsOfRays) {
  for (const rtl::Design& design : rtl::designs()) {
    if (!why_not_traced(design).empty()) continue;
    if (software_of(design).fits_coarse != nullptr) {
      const TracedUnit coarse{design.default_format, {{14, 11, 7}}};
      compare(design, coarse);
      const auto box_tests = [&](const TracedUnit& unit) {
        return traced(*generic_tracer(design, unit, scene_.mesh, bvh_)).counts.box_tests;
      };
      EXPECT_GT(box_tests(coarse), box_tests({design.default_format})) << design.name;
    }
    if (rtl::index_of(design.ports(design.default_format), hls::Role::endless))
      compare(design, {.format = design.default_format, .ends = false});
  }
}

TEST_F(GenericTracer, RefusesPlacesThatAreNotAsManyAsTheRays) {
  for (const rtl::Design& design : rtl::designs()) {
    if (!why_not_traced(design).empty()) continue;
    const auto tracer = generic_tracer(design, {design.default_format}, scene_.mesh, bvh_);
    std::vector<std::uint32_t> triangles(1);
    ref::TraceCounts counts;
    EXPECT_THROW(tracer->trace({batches_.front().rays, ref::Query::closest, triangles}, counts),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace hitpipe::sim::generic_tracer_test
