#include "host/parallel.hpp"

#include <algorithm>
#include <atomic>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <time.h>

namespace hitpipe::host {

void with_threads(int threads, const std::function<void()>& work) {
  // TBB prints a warning on standard error for more threads than cores.
  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(threads == 0 ? cores : std::min(threads, cores));
  arena.execute(work);
}

void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                    const std::function<void(double)>& progress) {
  std::atomic<std::size_t> done = 0;
  // ThreadSanitizer does not see what TBB's own library orders: work begins after what came before the loop, and
  // has ended behind it.
  std::atomic<std::size_t> ended;
  ended.store(0);
  with_threads(threads, [&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      static_cast<void>(ended.load());
      work(i);
      progress(static_cast<double>(++done) / static_cast<double>(count));
      ++ended;
    });
  });
  static_cast<void>(ended.load());
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace hitpipe::host
