// The queue of requests with traffic of every kind: what is asked for while it is granted leaves once and in
// order, with its address and identifier, and no cycle is lost.
#include "hls/machines/requests.hpp"

#include <deque>

#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::rtl::requests_test {
namespace {

struct Request {
  Word address, id;
};

class Asker {
 public:
  Asker(const hls::RequestBits& bits, unsigned seed)
      : bits_(bits), machine_("requests", bits), random_(seed), base_(random_.value(bits.bytes - 6)) {}

  /// One cycle, in which the reader asks and memory takes with these shares of 8.
  void cycle(int asks, int takes) {
    machine_.give();
    const bool granted = machine_.out["granted"] != 0, valid = machine_.out["request_valid"] != 0;
    ASSERT_EQ(granted, waiting_.size() < 2) << "there is room for two";
    ASSERT_EQ(valid, !waiting_.empty()) << "with " << waiting_.size() << " that wait";
    if (valid) {
      ASSERT_EQ(machine_.out["request_address"], waiting_.front().address) << "request " << left_;
      ASSERT_EQ(machine_.out["request_id"], waiting_.front().id) << "request " << left_;
    }

    machine_.in.scramble(random_);
    machine_.in["base"] = base_;
    machine_.in["asks"] = random_.below(8) < asks;
    machine_.in["request_ready"] = random_.below(8) < takes;
    if (valid && machine_.in["request_ready"] != 0) {
      waiting_.pop_front();
      ++left_;
    }
    if (granted && machine_.in["asks"] != 0) waiting_.push_back(asked());
    machine_.step();
  }

  [[nodiscard]] int left() const { return left_; }

 private:
  /// Addresses wrap, as those of an image that ends at the last address.
  [[nodiscard]] Request asked() const {
    const Word block = (2 * base_ + machine_.in["asked_block"]) & ones_below(bits_.bytes - 5);
    return {block * 32, machine_.in["triangle"] << bits_.ray | machine_.in["asker"]};
  }

  hls::RequestBits bits_;
  NamedMachine machine_;
  Seeded random_;
  Word base_;
  std::deque<Request> waiting_;
  int left_ = 0;
};

class RequestsIn : public testing::TestWithParam<hls::RequestBits> {};

TEST_P(RequestsIn, LeaveOnceAndInOrder) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Asker asker(GetParam(), seed);
    Seeded random(seed + 100);
    for (int period = 0; period < 40; ++period) {
      const int asks = random.below(9), takes = random.below(9);
      for (int cycle = 0; cycle < 50; ++cycle) {
        ASSERT_NO_FATAL_FAILURE(asker.cycle(asks, takes));
      }
    }
    EXPECT_GT(asker.left(), 400);
  }
}

TEST_P(RequestsIn, LeaveInEveryCycle) {
  Asker asker(GetParam(), 30);
  for (int cycle = 0; cycle < 1'000; ++cycle) {
    ASSERT_NO_FATAL_FAILURE(asker.cycle(8, 8));
  }
  EXPECT_EQ(asker.left(), 999) << "all but the one that was asked for in the last cycle";
}

INSTANTIATE_TEST_SUITE_P(Formats, RequestsIn,
                         testing::Values(hls::RequestBits{}, hls::RequestBits{4, 9, 1},
                                         hls::RequestBits{32, 64, 8}, hls::RequestBits{32, 37, 7},
                                         hls::RequestBits{10, 40, 3}),
                         [](const auto& each) { return Format(each.param).identifier(); });

}  // namespace
}  // namespace hitpipe::rtl::requests_test
