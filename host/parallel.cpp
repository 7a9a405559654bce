#include "host/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <pthread.h>
#include <time.h>

#include "host/default_arithmetic.hpp"
#include "host/watch.hpp"

namespace hitpipe::host {
namespace {

/// The threads of one with_threads().
struct Crew {
  int limit;
  int working = 1;  ///< guarded by the pool
};

thread_local Crew* crew_of_thread = nullptr;

struct SetCrew {
  explicit SetCrew(Crew* crew) : before(crew_of_thread) { crew_of_thread = crew; }
  SetCrew(const SetCrew&) = delete;
  SetCrew& operator=(const SetCrew&) = delete;
  ~SetCrew() { crew_of_thread = before; }
  Crew* before;
};

/// A loop that lives where it was called.
struct Loop {
  std::size_t count;
  const std::function<void(std::size_t)>& work;
  Crew& crew;
  std::atomic<std::size_t> next = 0;
  int helpers = 0;  ///< guarded by the pool, as is the error
  std::exception_ptr error{};

  [[nodiscard]] bool has_work() const { return next.load() < count; }
};

/// Threads that wait for loops. It is never destroyed: its threads may still wait when the program ends.
class Pool {
 public:
  static Pool& instance() {
    static std::once_flag once;
    std::call_once(once, [] {
      current = new Pool;
      // A forked process has none of the threads.
      pthread_atfork(nullptr, nullptr, [] { current = new Pool; });
    });
    return *current;
  }

  void run(Loop& loop) {
    std::unique_lock lock(mutex_);
    open_.push_back(&loop);
    hire(std::min(static_cast<std::size_t>(loop.crew.limit), loop.count) - 1);
    changed_.notify_all();
    work_at(loop, lock);
    std::erase(open_, &loop);
    while (loop.helpers > 0) {
      // Of its own crew only, which may wait for this very thread.
      if (Loop* const other = find([&](const Loop& each) { return &each.crew == &loop.crew; })) {
        help(*other, lock);
      } else {
        changed_.wait(lock);
      }
    }
  }

 private:
  void hire(std::size_t helpers) {
    for (; threads_ < helpers; ++threads_) std::thread([this] { serve(); }).detach();
  }

  [[noreturn]] void serve() {
    // A new thread would have the arithmetic of whoever hires it.
    const DefaultArithmetic arithmetic;
    std::unique_lock lock(mutex_);
    for (;;) {
      Loop* const loop = find([](const Loop& each) { return each.crew.working < each.crew.limit; });
      if (loop == nullptr) {
        changed_.wait(lock);
        continue;
      }
      Crew& crew = loop->crew;
      const SetCrew member(&crew);
      ++crew.working;
      // The loop, and with it the crew, may end as soon as the lock is free again.
      help(*loop, lock, [&] { --crew.working; });
    }
  }

  /// The innermost loops come last, and others wait for them.
  template <class Allows>
  [[nodiscard]] Loop* find(const Allows& allows) const {
    const auto found = std::find_if(open_.rbegin(), open_.rend(),
                                    [&](const Loop* each) { return each->has_work() && allows(*each); });
    return found == open_.rend() ? nullptr : *found;
  }

  template <class Leave = void (*)()>
  void help(
      Loop& loop, std::unique_lock<std::mutex>& lock, const Leave& leave = [] {}) {
    ++loop.helpers;
    work_at(loop, lock);
    leave();
    --loop.helpers;
    changed_.notify_all();
  }

  static void work_at(Loop& loop, std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    std::exception_ptr error;
    try {
      for (std::size_t i = 0; (i = loop.next++) < loop.count;) {
        look();
        loop.work(i);
      }
    } catch (...) {
      error = std::current_exception();
      loop.next = loop.count;
    }
    lock.lock();
    if (error && !loop.error) loop.error = error;
  }

  static Pool* current;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Loop*> open_;
  std::size_t threads_ = 0;
};

Pool* Pool::current = nullptr;

}  // namespace

void with_threads(int threads, const std::function<void()>& work) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Crew crew{.limit = std::min(threads == 0 ? cores : threads, most_threads)};
  const SetCrew member(&crew);
  work();
}

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (crew_of_thread == nullptr) return with_threads(0, [&] { for_each_index(count, work); });
  if (count <= 1 || crew_of_thread->limit <= 1) {
    for (std::size_t i = 0; i < count; ++i) {
      look();
      work(i);
    }
    return;
  }
  Loop loop{.count = count, .work = work, .crew = *crew_of_thread};
  Pool::instance().run(loop);
  if (loop.error) std::rethrow_exception(loop.error);
}

void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                    const std::function<void(double)>& progress) {
  std::atomic<std::size_t> done = 0;
  with_threads(threads, [&] {
    for_each_index(count, [&](std::size_t i) {
      work(i);
      progress(static_cast<double>(++done) / static_cast<double>(count));
    });
  });
}

void for_each_block(std::size_t first, std::size_t last, std::size_t block,
                    const std::function<void(std::size_t, std::size_t)>& work) {
  for_each_index((last - first + block - 1) / block, [&](std::size_t i) {
    const std::size_t begin = first + i * block;
    work(begin, std::min(begin + block, last));
  });
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace hitpipe::host
