// The door with traffic of every kind: each ray that begins goes on to best_hits once, with a number that no
// other ray in flight has, and the door neither lets in too many rays nor stops letting them in.
#include "hls/machines/door.hpp"

#include <deque>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::rtl::door_test {
namespace {

struct Kind {
  hls::DoorBits bits;
  int most_rays;
};

struct Ray {
  Word number, length, any;
};

/// What a cycle's inputs are made from, of 8.
struct Traffic {
  int offers, takes, answers;
};

class Traveller {
 public:
  Traveller(const Kind& kind, unsigned seed)
      : kind_(kind),
        door_("door", kind.bits),
        random_(seed),
        in_flight_(static_cast<std::size_t>(kind.bits.rays())) {}

  /// One cycle. Stops the test at the first thing that is wrong.
  void cycle(const Traffic& traffic) {
    door_.give();
    const bool ready = door_.out["ray_ready"] != 0;
    // A number that comes back can be given three cycles later; one that nobody has had, sooner.
    const bool must_be_ready = quiet_ >= 3 && !shown_ && flying_ < kind_.most_rays;
    if (must_be_ready) {
      ASSERT_TRUE(ready) << "nothing holds the ray up";
    }
    if (shown_ || flying_ == kind_.most_rays) {
      ASSERT_FALSE(ready) << flying_ << " rays are in flight";
    }
    expect_shown();
    ++quiet_;

    door_.in.scramble(random_);
    door_.in["most_rays"] = static_cast<Word>(kind_.most_rays);
    door_.in["ray_valid"] = of_eight(traffic.offers);
    door_.in["takes"] = of_eight(traffic.takes);
    door_.in["freed"] = !taken_.empty() && of_eight(traffic.answers);
    const std::optional<Ray> was_shown = shown_;
    if (shown_ && door_.in["takes"] != 0) shown_.reset();
    if (ready && door_.in["ray_valid"] != 0) begin();
    if (door_.in["freed"] != 0) answer();
    if (was_shown && !shown_) taken_.push_back(was_shown->number);
    door_.step();
  }

  [[nodiscard]] int begun() const { return begun_; }
  [[nodiscard]] int flying() const { return flying_; }
  [[nodiscard]] int most_flying() const { return most_flying_; }
  [[nodiscard]] int taken() const { return begun_ - (shown_ ? 1 : 0); }

 private:
  bool of_eight(int share) { return random_.below(8) < share; }

  void expect_shown() {
    ASSERT_EQ(door_.out["new_ray"] != 0, shown_.has_value()) << "of ray " << begun_;
    if (!shown_) return;
    ASSERT_EQ(door_.out["begun"], shown_->number);
    ASSERT_EQ(door_.out["length"], shown_->length);
    ASSERT_EQ(door_.out["any"], shown_->any);
  }

  void begin() {
    const Word number = door_.out["begun_at"];
    if (begun_ < kind_.most_rays) {
      ASSERT_EQ(number, static_cast<Word>(begun_)) << "it has not been given yet";
    }
    ASSERT_LT(number, static_cast<Word>(kind_.most_rays));
    ASSERT_FALSE(in_flight_[static_cast<std::size_t>(number)]) << "a second ray has this number";
    in_flight_[static_cast<std::size_t>(number)] = true;
    shown_ = {number, door_.in["ray_error"] != 0 ? 0 : door_.in["ray_length"], door_.in["ray_any"]};
    ++begun_;
    most_flying_ = std::max(most_flying_, ++flying_);
    quiet_ = 0;
  }

  /// Of any ray that best_hits has.
  void answer() {
    const auto which = taken_.begin() + random_.below(static_cast<int>(taken_.size()));
    door_.in["freed_ray"] = *which;
    in_flight_[static_cast<std::size_t>(*which)] = false;
    taken_.erase(which);
    --flying_;
    quiet_ = 0;
  }

  Kind kind_;
  NamedMachine door_;
  Seeded random_;
  std::vector<bool> in_flight_;  ///< by number
  std::optional<Ray> shown_;     ///< to best_hits
  std::deque<Word> taken_;       ///< by best_hits
  int begun_ = 0, flying_ = 0, most_flying_ = 0;
  int quiet_ = 0;  ///< cycles since a ray began or an answer left
};

class DoorWith : public testing::TestWithParam<Kind> {};

TEST_P(DoorWith, LetsEachRayInOnce) {
  const Kind& kind = GetParam();
  Traveller rays(kind, 11);
  constexpr Traffic kinds[] = {{8, 8, 8}, {8, 8, 2}, {4, 4, 4}, {8, 1, 8}, {1, 8, 8}, {8, 8, 0}, {7, 6, 7}};
  Seeded random(12);
  for (int period = 0; period < 600; ++period) {
    const Traffic& traffic = kinds[random.below(std::size(kinds))];
    const int begun = rays.begun();
    for (int cycle = 0; cycle < 200; ++cycle) {
      ASSERT_NO_FATAL_FAILURE(rays.cycle(traffic));
    }
    if (traffic.answers != 0) {
      EXPECT_GT(rays.begun(), begun) << "the door goes on for ever";
    }
  }
  EXPECT_EQ(rays.most_flying(), kind.most_rays) << "there was a time when it was full";
  EXPECT_GT(rays.begun(), 10'000);
}

TEST_P(DoorWith, IsFullOnceAllNumbersAreInFlight) {
  Traveller rays(GetParam(), 13);
  for (int cycle = 0; cycle < 2 * GetParam().most_rays + 10; ++cycle)
    ASSERT_NO_FATAL_FAILURE(rays.cycle({8, 8, 0}));
  EXPECT_EQ(rays.begun(), GetParam().most_rays);
  EXPECT_EQ(rays.taken(), GetParam().most_rays);
}

INSTANTIATE_TEST_SUITE_P(Formats, DoorWith,
                         testing::Values(Kind{{}, 32}, Kind{{}, 1}, Kind{{}, 19}, Kind{{4, 1}, 1},
                                         Kind{{4, 1}, 2}, Kind{{36, 3}, 7}, Kind{{21, 8}, 256},
                                         Kind{{17, 8}, 192}),
                         [](const auto& each) {
                           return Format(each.param.bits).identifier() + "_" +
                                  std::to_string(each.param.most_rays);
                         });

TEST(Door, HasNoMoreRaysThanNumbers) {
  NamedMachine door("door", hls::DoorBits{20, 3});
  door.in["most_rays"] = 15;
  door.in["ray_valid"] = door.in["takes"] = 1;
  std::vector<Word> numbers;
  for (int cycle = 0; cycle < 100; ++cycle) {
    door.give();
    if (door.out["ray_ready"] != 0) numbers.push_back(door.out["begun_at"]);
    door.step();
  }
  EXPECT_EQ(numbers, (std::vector<Word>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Door, LetsARayInEverySecondCycle) {
  Traveller rays({{}, 8}, 14);
  // Numbers that have never been given come first, and later those that came back.
  for (const int cycles : {2, 4, 20, 100, 10'000}) {
    const int begun = rays.begun();
    for (int cycle = 0; cycle < cycles; ++cycle) {
      ASSERT_NO_FATAL_FAILURE(rays.cycle({8, 8, 8}));
    }
    EXPECT_NEAR(rays.begun() - begun, cycles / 2, cycles == 2 ? 1 : 0) << "in " << cycles << " cycles";
  }
}

}  // namespace
}  // namespace hitpipe::rtl::door_test
