// A watch is asked by its own thread, and what it throws ends the loop.
#include "host/watch.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "host/parallel.hpp"

namespace hitpipe::host::watch_test {
namespace {

TEST(Watch, EndsALoop) {
  for (const int threads : {1, 3}) {
    const auto caller = std::this_thread::get_id();
    std::atomic<int> asked = 0;
    std::atomic<std::size_t> calls = 0;
    const Watch watch([&] {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      if (++asked == 5) throw std::runtime_error("enough");
    });
    // Others wait until the caller's thread has had its turns.
    const auto work = [&](std::size_t) {
      ++calls;
      while (std::this_thread::get_id() != caller && asked < 5) std::this_thread::yield();
    };
    EXPECT_THROW(for_each_index(1'000, threads, work), std::runtime_error);
    EXPECT_EQ(asked, 5);
    EXPECT_LT(calls, 1'000U);
  }
}

TEST(Watch, IsTheInnermost) {
  int outer = 0;
  int inner = 0;
  look();
  const Watch watch([&] { ++outer; });
  {
    const Watch another([&] { ++inner; });
    look();
    const Watch none({});
    look();
  }
  look();
  for (std::size_t call = 0; call < 3'000; ++call) look(call);
  EXPECT_EQ(inner, 1);
  EXPECT_EQ(outer, 4);
}

}  // namespace
}  // namespace hitpipe::host::watch_test
