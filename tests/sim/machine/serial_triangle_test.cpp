// The serial triangle test against exact crossings: each triangle that comes is tested once, in order, with
// its own ray, and a hit has the right T and the right comparison with the ray's best.
#include "hls/machines/serial_triangle.hpp"

#include <deque>
#include <optional>

#include "rays/world/int_triangle.hpp"
#include "tests/rays/world/cases.hpp"
#include "tests/sim/machine/feeds.hpp"

namespace hitpipe::sim::serial_triangle_test {
namespace {

using feeds::Expected;
using rtl::NamedMachine;
using rtl::Seeded;

/// A test with its answer.
struct Test {
  std::size_t ray;
  bool hit;
  std::int64_t t;
  std::uint32_t number;
};

struct Ray {
  std::uint64_t number = 0, best = 0, best_number = 0;
  bool waits = false;
};

class SerialTriangle {
 public:
  SerialTriangle(const hls::CoreBits& bits, unsigned seed)
      : bits_(bits),
        machine_("serial_triangle", bits),
        random_(seed),
        draw_(seed),
        rays_(static_cast<std::size_t>(bits.rays())) {}

  /// One cycle, in which a triangle comes with this share of 8 if a ray may have one.
  void cycle(int reads) {
    machine_.give();
    ASSERT_EQ(machine_.out["reads"] != 0, read_.has_value());
    if (read_) {
      ASSERT_NO_FATAL_FAILURE(read_->equal(machine_.out));
    }
    read_.reset();
    const auto asked = static_cast<std::size_t>(machine_.out["asked"]);
    ASSERT_NO_FATAL_FAILURE(look(asked));

    machine_.in.scramble(random_);
    machine_.in["ray_valid"] = 0;
    machine_.in["read_valid"] = 0;
    const Ray& wanted = rays_[asked_];
    machine_.in["asked_number"] = wanted.number;
    machine_.in["best"] = wanted.best;
    machine_.in["best_number"] = wanted.best_number;
    if (random_.below(8) < reads) come(static_cast<std::size_t>(random_.below(bits_.rays())));
    machine_.step();
    asked_ = asked;
    ++cycle_;
  }

  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }
  int tests = 0, hits = 0, closer_ones = 0, longest = 0;

 private:
  void look(std::size_t asked) {
    if (machine_.out["tested"] != 0) {
      ASSERT_FALSE(waiting_.empty());
      ASSERT_FALSE(divides_);
      const Test& test = waiting_.front();
      ASSERT_EQ(asked, test.ray);
      ASSERT_EQ(machine_.out["hit"] != 0, test.hit) << "test " << tests;
      divides_ = test.hit;
      if (!test.hit) end();
    }
    ASSERT_EQ(machine_.out["done"] != 0 && !divides_, false);
    if (machine_.out["done"] != 0) {
      const Test& test = waiting_.front();
      const Ray& ray = rays_[test.ray];
      ASSERT_EQ(asked, test.ray);
      const auto t = static_cast<std::uint64_t>(test.t);
      ASSERT_EQ(static_cast<std::uint64_t>(machine_.out["t"]), t) << "test " << tests;
      const bool closer = t < ray.best || (t == ray.best && test.number < ray.best_number);
      ASSERT_EQ(machine_.out["closer"] != 0, closer) << "test " << tests;
      ++hits;
      closer_ones += closer ? 1 : 0;
      divides_ = false;
      end();
    }
  }
  void end() {
    rays_[waiting_.front().ray].waits = false;
    waiting_.pop_front();
    ++tests;
    longest = std::max(longest, cycle_ - began_);
    began_ = cycle_;
  }

  /// In the first cycle the ray begins anew, in the next its triangle comes.
  void come(std::size_t place) {
    if (pending_) {
      read();
      return;
    }
    Ray& ray = rays_[place];
    if (ray.waits) return;
    const hls::WorldBits& world = bits_;
    pending_ = ref::world_cases::Case{world, {}, draw_.triangle(world)};
    pending_->ray = draw_.ray(world, pending_->triangle);
    pending_->ray.length = world.largest_distance();
    place_ = place;
    const ref::IntRay& fresh = pending_->ray;
    std::array<int, 3> axes{0, 1, 2};
    std::swap(axes[0], axes[static_cast<std::size_t>(fresh.major)]);
    feeds::show(fresh, axes, machine_.in);
    machine_.in["begun_at"] = place;
    machine_.in["ray_ready"] = 1;
    machine_.in["ray_valid"] = 1;
    machine_.in.put("ray_s_a", std::abs(fresh.direction[static_cast<std::size_t>(axes[1])]));
    machine_.in.put("ray_s_b", std::abs(fresh.direction[static_cast<std::size_t>(axes[2])]));
  }
  void read() {
    const auto number = static_cast<std::uint32_t>(random_.value(32));
    feeds::give(ref::to_block(ref::CoreTriangle{pending_->triangle, number}, bits_.coord), place_, true,
                bits_.ray, machine_.in);
    machine_.in["read_valid"] = 1;
    read_ = {{{"read_ray", static_cast<std::int64_t>(place_)}, {"number", number}}};
    const auto crossing = ref::int_crossing(pending_->ray, pending_->triangle, pending_->bits);
    const std::int64_t t = crossing ? crossing->t : 0;
    if (waiting_.empty()) began_ = cycle_;
    waiting_.push_back({place_, crossing.has_value(), t, number});
    // Often the best is this T, so the numbers decide.
    Ray& ray = rays_[place_];
    ray = {.number = number,
           .best = random_.below(3) == 0 ? static_cast<std::uint64_t>(t)
                                         : static_cast<std::uint64_t>(random_.value(bits_.distance())),
           .best_number = (number + static_cast<std::uint64_t>(random_.below(3)) - 1) & 0xffffffff,
           .waits = true};
    pending_.reset();
  }

  hls::CoreBits bits_;
  NamedMachine machine_;
  Seeded random_;
  ref::world_cases::Draw draw_;
  std::vector<Ray> rays_;
  std::deque<Test> waiting_;
  std::optional<ref::world_cases::Case> pending_;  ///< whose ray has begun
  std::size_t place_ = 0, asked_ = 0;
  std::optional<Expected> read_;  ///< in this cycle
  bool divides_ = false;
  int cycle_ = 0, began_ = 0;
};

class SerialTriangleIn : public testing::TestWithParam<hls::CoreBits> {};

TEST_P(SerialTriangleIn, GivesExactAnswersInOrder) {
  SerialTriangle machine(GetParam(), 41);
  Seeded random(42);
  for (int period = 0; period < 500; ++period) {
    const int reads = random.below(9);
    for (int cycle = 0; cycle < 800; ++cycle)
      ASSERT_NO_FATAL_FAILURE(machine.cycle(reads)) << "period " << period;
  }
  EXPECT_GT(machine.tests, 2'000);
  EXPECT_GT(machine.hits, machine.tests / 8) << "coarse slopes miss more";
  EXPECT_GT(machine.closer_ones, machine.hits / 5);
  for (int cycle = 0; cycle < 200 * GetParam().rays(); ++cycle) ASSERT_NO_FATAL_FAILURE(machine.cycle(0));
  EXPECT_EQ(machine.waiting(), 0U) << "each triangle is tested";
  EXPECT_LE(machine.longest, hls::triangle_program::program.length + GetParam().distance() + 10);
}

INSTANTIATE_TEST_SUITE_P(
    Formats, SerialTriangleIn,
    testing::Values(hls::CoreBits{}, hls::CoreBits{{12, 0, 12, 0, 0}, 2}, hls::CoreBits{{15, 1, 14, 0, 0}, 1},
                    hls::CoreBits{{24, 3, 32, 8, 0}, 4}, hls::CoreBits{{24, 3, 8, 0, 0}, 3},
                    hls::CoreBits{{8, 0, 32, 0, 0}, 2}, hls::CoreBits{{8, 3, 8, 8, 0}, 2},
                    hls::CoreBits{{24, 0, 12, 2, 0}, 3}),
    [](const testing::TestParamInfo<hls::CoreBits>& each) { return Format(each.param).identifier(); });

}  // namespace
}  // namespace hitpipe::sim::serial_triangle_test
