// The machine that gives records to the unit for two boxes, with rays and records in any order: each record
// is tested once, in the next cycle, with the operands that software makes of its ray and its contents.
#include "hls/machines/pair_feed.hpp"

#include <optional>

#include "tests/sim/machine/feeds.hpp"

namespace hitpipe::sim::pair_feed_test {
namespace {

using feeds::CoreBlock;
using feeds::Expected;
using feeds::Kind;
using rtl::NamedMachine;
using rtl::Seeded;

class PairFeed {
 public:
  PairFeed(const Kind& kind, unsigned seed)
      : kind_(kind),
        feed_("pair_feed", kind.pairs()),
        random_(seed),
        rays_(static_cast<std::size_t>(kind.rays())) {}

  void cycle() {
    feed_.give();
    ASSERT_EQ(feed_.out["begins"] != 0, expected_.has_value()) << "test " << tests_;
    if (expected_) {
      ASSERT_NO_FATAL_FAILURE(expected_->equal(feed_.out)) << "test " << tests_;
    }
    expected_.reset();

    feed_.in.scramble(random_);
    for (const char* name : {"ray_valid", "goes", "read_valid"}) feed_.in[name] = 0;
    // One ray does one thing in a cycle, as in the core.
    const std::size_t first = any(), second = any(), third = any();
    read(first);
    if (second != first) go(second);
    if (third != first && third != second) begin(third);
    feed_.step();
  }

  [[nodiscard]] int tests() const { return tests_; }
  [[nodiscard]] int triangles() const { return triangles_; }

 private:
  struct Ray {
    std::optional<ref::IntRay> ray{};
    bool waits = false;  ///< for a block
    rtl::Word near = 0, far = 0;
  };

  std::size_t any() { return static_cast<std::size_t>(random_.below(kind_.rays())); }

  void begin(std::size_t place) {
    Ray& ray = rays_[place];
    if (ray.waits) return;
    const ref::IntRay fresh = feeds::any_ray(random_, kind_.bits.world());
    const ref::IntMajorRay boxes = major_ray(fresh, kind_.bits.boxes());
    feeds::show(fresh, boxes.axes, feed_.in);
    feed_.in["begun_at"] = place;
    feed_.in["ray_ready"] = random_.below(4) != 0;
    feed_.in["ray_valid"] = random_.below(4) != 0;
    for (const std::size_t i : {0U, 1U}) {
      const std::string of = i == 0 ? "a" : "b";
      feed_.in.put("ray_floor_" + of, boxes.quotient[i].mantissa_low);
      feed_.in.put("ray_ceil_" + of, boxes.quotient[i].mantissa_high);
      feed_.in.put("ray_exp_" + of, boxes.quotient[i].exponent);
    }
    if (feed_.in["ray_valid"] != 0 && feed_.in["ray_ready"] != 0) ray.ray = fresh;
  }
  void go(std::size_t place) {
    Ray& ray = rays_[place];
    if (!ray.ray || ray.waits) return;
    feed_.in["goes"] = 1;
    feed_.in["walk_ray"] = place;
    ray.near = feed_.in["enters_at"];
    ray.far = feed_.in["leaves_at"];
    ray.waits = true;
  }
  /// A record, or the triangle of a leaf, after which the walker lets the ray go on.
  void read(std::size_t place) {
    Ray& ray = rays_[place];
    if (!ray.waits || random_.below(4) == 0) return;
    const bool triangle = random_.below(4) == 0;
    const CoreBlock block = triangle ? feeds::any_triangle(random_, kind_.bits.coord)
                                     : feeds::any_record(random_, kind_.bits.coord, kind_.address);
    feed_.in["read_valid"] = 1;
    feeds::give(block, place, triangle, kind_.ray, feed_.in);
    ray.waits = false;
    ++(triangle ? triangles_ : tests_);
    if (!triangle) expected_ = test_of(place, block);
  }

  [[nodiscard]] Expected test_of(std::size_t place, const CoreBlock& block) const {
    const Ray& of = rays_[place];
    const ref::IntMajorRay ray = major_ray(*of.ray, kind_.bits.boxes());
    const ref::CoreRecord record = ref::record_of(block);
    const auto count = [&](std::size_t child) {
      return record.counts[child] == ref::PairChild::none     ? 0
             : record.counts[child] == ref::PairChild::branch ? 255
                                                              : record.counts[child];
    };
    Expected test{{{"test_ray", static_cast<std::int64_t>(place)},
                   {"block", record.pointer},
                   {"count_0", count(0)},
                   {"count_1", count(1)},
                   {"major_y", ray.axes[0] == 1},
                   {"major_z", ray.axes[0] == 2},
                   {"back_m", ray.backward[0]},
                   {"back_a", ray.backward[1]},
                   {"back_b", ray.backward[2]},
                   {"origin_m", ray.origin[0]},
                   {"origin_a", ray.origin[1]},
                   {"origin_b", ray.origin[2]},
                   {"floor_a", ray.quotient[0].mantissa_low},
                   {"ceil_a", ray.quotient[0].mantissa_high},
                   {"exp_a", ray.quotient[0].exponent},
                   {"floor_b", ray.quotient[1].mantissa_low},
                   {"ceil_b", ray.quotient[1].mantissa_high},
                   {"exp_b", ray.quotient[1].exponent},
                   {"parent_near", static_cast<std::int64_t>(of.near)},
                   {"parent_far", static_cast<std::int64_t>(of.far)}}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string min = std::string(feeds::letters[axis]) + "min",
                        max = std::string(feeds::letters[axis]) + "max";
      test.ports.push_back({min, record.boxes.planes.min[axis]});
      test.ports.push_back({max, record.boxes.planes.max[axis]});
      test.ports.push_back({"own_" + min, record.boxes.owners >> axis & 1});
      test.ports.push_back({"own_" + max, record.boxes.owners >> (axis + 3) & 1});
    }
    return test;
  }

  Kind kind_;
  NamedMachine feed_;
  Seeded random_;
  std::vector<Ray> rays_;
  std::optional<Expected> expected_;  ///< in this cycle
  int tests_ = 0, triangles_ = 0;
};

class PairFeedIn : public testing::TestWithParam<Kind> {};

TEST_P(PairFeedIn, GivesRecordsWithTheirRays) {
  PairFeed feed(GetParam(), 31);
  for (int cycle = 0; cycle < 40'000; ++cycle) ASSERT_NO_FATAL_FAILURE(feed.cycle()) << "cycle " << cycle;
  EXPECT_GT(feed.tests(), 1'000);
  EXPECT_GT(feed.triangles(), 300);
}

INSTANTIATE_TEST_SUITE_P(Formats, PairFeedIn, feeds::kinds, feeds::name_of);

}  // namespace
}  // namespace hitpipe::sim::pair_feed_test
