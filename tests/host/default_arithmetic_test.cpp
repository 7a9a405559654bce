// Work is done in the default arithmetic, on all threads, and the caller's comes back.
#include "host/default_arithmetic.hpp"

#include <atomic>
#include <cfenv>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "host/parallel.hpp"
#include "tests/callers_arithmetic.hpp"

namespace hitpipe::host::default_arithmetic_test {
namespace {

/// Whether the thread rounds to nearest and keeps denormal numbers.
bool is_default() {
  volatile float one = 1.0F;
  volatile float small = 0x1p-30F;
  volatile float least = std::numeric_limits<float>::denorm_min();
  volatile float twice = least + least;  // flushed by FTZ or DAZ
  return std::fegetround() == FE_TONEAREST && one + small == 1.0F && one - small == 1.0F && twice > 0.0F;
}

TEST(DefaultArithmetic, IsThereAndLeavesTheCallers) {
  for (const CallersArithmetic::Choice& choice : CallersArithmetic::choices()) {
    SCOPED_TRACE(choice.name);
    const CallersArithmetic callers(choice);
    std::feraiseexcept(FE_INEXACT);
    const auto before = CallersArithmetic::state();
    {
      const DefaultArithmetic arithmetic;
      EXPECT_TRUE(is_default());
      std::feraiseexcept(FE_DIVBYZERO);
    }
    EXPECT_EQ(CallersArithmetic::state(), before);
    EXPECT_EQ(is_default(), std::string(choice.name) == "default");
  }
}

/// The pool's threads may be hired by a thread of another arithmetic, as some are for each here.
TEST(DefaultArithmetic, IsOfTheThreadsOfAPool) {
  std::thread([] {
    std::size_t threads = 30;
    for (const CallersArithmetic::Choice& choice : CallersArithmetic::choices()) {
      const CallersArithmetic callers(choice);
      const auto caller = std::this_thread::get_id();
      std::mutex telling;
      std::condition_variable came;
      std::set<std::thread::id> seen;
      std::atomic<int> others = 0;
      threads += 10;
      for_each_index(threads, static_cast<int>(threads), [&](std::size_t) {
        if (std::this_thread::get_id() != caller && !is_default()) ++others;
        std::unique_lock lock(telling);
        seen.insert(std::this_thread::get_id());
        came.notify_all();
        came.wait_for(lock, std::chrono::seconds(20), [&] { return seen.size() == threads; });
      });
      EXPECT_EQ(seen.size(), threads);
      EXPECT_EQ(others, 0) << choice.name;
    }
  }).join();
}

}  // namespace
}  // namespace hitpipe::host::default_arithmetic_test
