// The machine that gives triangles to the triangle unit, with rays and triangles in any order: each triangle
// is tested once, in the order in which they came, with the operands of its ray and its own corners.
#include "hls/machines/triangle_feed.hpp"

#include <deque>
#include <optional>

#include "tests/sim/machine/feeds.hpp"

namespace hitpipe::sim::triangle_feed_test {
namespace {

using feeds::CoreBlock;
using feeds::Expected;
using feeds::Kind;
using rtl::NamedMachine;
using rtl::Seeded;

class TriangleFeed {
 public:
  TriangleFeed(const Kind& kind, unsigned seed)
      : kind_(kind),
        feed_("triangle_feed", kind.triangles()),
        random_(seed),
        rays_(static_cast<std::size_t>(kind.rays())) {}

  /// One cycle, in which blocks come and the unit takes tests with these shares of 8.
  void cycle(int reads, int takes) {
    feed_.give();
    ASSERT_EQ(feed_.out["reads"] != 0, read_.has_value()) << "triangle " << triangles_;
    if (read_) {
      ASSERT_NO_FATAL_FAILURE(read_->equal(feed_.out)) << "triangle " << triangles_;
    }
    read_.reset();
    const bool begins = feed_.out["begins"] != 0;
    ASSERT_NO_FATAL_FAILURE(look_at_test(begins));

    feed_.in.scramble(random_);
    feed_.in["read_valid"] = 0;
    feed_.in["ray_valid"] = 0;
    feed_.in["unit_takes"] = random_.below(8) < takes;
    const std::size_t reader = any(), fresh = any();
    if (random_.below(8) < reads) read(reader);
    if (fresh != reader) begin(fresh);
    if (begins && feed_.in["unit_takes"] != 0) {
      rays_[waiting_.front().ray].waits = false;
      waiting_.pop_front();
      ++tests_;
      last_ = cycle_;
    }
    feed_.step();
    ++cycle_;
  }

  [[nodiscard]] int tests() const { return tests_; }
  [[nodiscard]] int triangles() const { return triangles_; }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  struct Ray {
    std::optional<ref::IntRay> ray{};
    bool waits = false;  ///< for the unit
  };
  struct Test {
    std::size_t ray;
    Expected operands;
    int came;  ///< the cycle
  };

  std::size_t any() { return static_cast<std::size_t>(random_.below(kind_.rays())); }

  /// The oldest, until it is taken, so it does not change either.
  void look_at_test(bool begins) {
    const bool must = !waiting_.empty() && cycle_ >= waiting_.front().came + 3 && cycle_ >= last_ + interval;
    if (must) {
      ASSERT_TRUE(begins) << "test " << tests_;
    }
    if (!begins) return;
    ASSERT_FALSE(waiting_.empty()) << "after test " << tests_;
    ASSERT_GE(cycle_, last_ + interval) << "test " << tests_;
    ASSERT_NO_FATAL_FAILURE(waiting_.front().operands.equal(feed_.out)) << "test " << tests_;
  }

  void begin(std::size_t place) {
    Ray& ray = rays_[place];
    if (ray.waits) return;
    const ref::IntRay fresh = feeds::any_ray(random_, kind_.bits.world());
    const std::array<int, 3> axes = major_ray(fresh, kind_.bits.boxes()).axes;
    feeds::show(fresh, axes, feed_.in);
    feed_.in["begun_at"] = place;
    feed_.in["ray_ready"] = random_.below(4) != 0;
    feed_.in["ray_valid"] = random_.below(4) != 0;
    feed_.in.put("ray_s_a", std::abs(fresh.direction[static_cast<std::size_t>(axes[1])]));
    feed_.in.put("ray_s_b", std::abs(fresh.direction[static_cast<std::size_t>(axes[2])]));
    if (feed_.in["ray_valid"] != 0 && feed_.in["ray_ready"] != 0) ray.ray = fresh;
  }
  /// A triangle if the ray has none on its way; else a record, which is not for this machine.
  void read(std::size_t place) {
    Ray& ray = rays_[place];
    const bool triangle = ray.ray && !ray.waits && random_.below(8) != 0;
    const CoreBlock block = triangle ? feeds::any_triangle(random_, kind_.bits.coord)
                                     : feeds::any_record(random_, kind_.bits.coord, kind_.address);
    feed_.in["read_valid"] = 1;
    feeds::give(block, place, triangle, kind_.ray, feed_.in);
    if (!triangle) return;
    ray.waits = true;
    ++triangles_;
    waiting_.push_back({place, test_of(place, block), cycle_});
    read_ = {{{"read_ray", static_cast<std::int64_t>(place)}, {"number", ref::triangle_of(block).number}}};
  }

  [[nodiscard]] Expected test_of(std::size_t place, const CoreBlock& block) const {
    const ref::IntRay& ray = *rays_[place].ray;
    const std::array<int, 3> axes = major_ray(ray, kind_.bits.boxes()).axes;
    const auto m = static_cast<std::size_t>(axes[0]), a = static_cast<std::size_t>(axes[1]),
               b = static_cast<std::size_t>(axes[2]);
    const std::int64_t sign = ray.negative[m] ? -1 : 1;
    Expected test{{{"test_ray", static_cast<std::int64_t>(place)},
                   {"major_y", m == 1},
                   {"major_z", m == 2},
                   {"back_m", ray.negative[m]},
                   {"origin_m", ray.origin[m]},
                   {"origin_a", ray.origin[a]},
                   {"origin_b", ray.origin[b]},
                   {"slope_a", sign * ray.direction[a]},
                   {"slope_b", sign * ray.direction[b]}}};
    const ref::CoreTriangle triangle = ref::triangle_of(block);
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        test.ports.push_back(
            {feeds::letters[axis] + std::to_string(corner), triangle.triangle.corners[corner][axis]});
    return test;
  }

  static constexpr int interval = 2;

  Kind kind_;
  NamedMachine feed_;
  Seeded random_;
  std::vector<Ray> rays_;
  std::deque<Test> waiting_;
  std::optional<Expected> read_;      ///< in this cycle
  int cycle_ = 0, last_ = -interval;  ///< last_: when the unit took a test
  int tests_ = 0, triangles_ = 0;
};

class TriangleFeedIn : public testing::TestWithParam<Kind> {};

TEST_P(TriangleFeedIn, GivesTrianglesWithTheirRays) {
  TriangleFeed feed(GetParam(), 32);
  Seeded random(33);
  for (int period = 0; period < 400; ++period) {
    const int reads = random.below(9), takes = random.between(1, 8);
    for (int cycle = 0; cycle < 100; ++cycle)
      ASSERT_NO_FATAL_FAILURE(feed.cycle(reads, takes)) << "period " << period;
  }
  EXPECT_GT(feed.tests(), 2'000);
  for (int cycle = 0; cycle < 1'000; ++cycle) ASSERT_NO_FATAL_FAILURE(feed.cycle(0, 8));
  EXPECT_EQ(feed.tests(), feed.triangles()) << "each triangle is tested once";
}

TEST_P(TriangleFeedIn, GivesATriangleInEverySecondCycle) {
  TriangleFeed feed(GetParam(), 34);
  const int count = GetParam().rays();
  for (int cycle = 0; cycle < 40 * count + 100; ++cycle) ASSERT_NO_FATAL_FAILURE(feed.cycle(8, 0));
  ASSERT_EQ(feed.waiting(), static_cast<std::size_t>(count)) << "each ray has a place";
  for (int cycle = 0; cycle < 2 * count; ++cycle) ASSERT_NO_FATAL_FAILURE(feed.cycle(0, 8));
  EXPECT_EQ(feed.tests(), count);
}

INSTANTIATE_TEST_SUITE_P(Formats, TriangleFeedIn, feeds::kinds, feeds::name_of);

}  // namespace
}  // namespace hitpipe::sim::triangle_feed_test
