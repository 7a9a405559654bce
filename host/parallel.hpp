// Work on a limited number of threads, and the processor time of one of them. It is our own and not a library's for
// two reasons: ThreadSanitizer follows all of it, and whoever links hitpipe::ref needs nothing else.
#pragma once

#include <cstddef>
#include <functional>

namespace hitpipe::host {

/// The most threads that can be asked for.
inline constexpr int most_threads = 256;

/// Runs `work`. Loops in it, and loops in those, use at most `threads` threads in all, of which the caller's is one.
/// 0: one for each core; more than most_threads are as many as that.
void with_threads(int threads, const std::function<void()>& work);

/// Calls work(i) for each i below `count`, on the threads of the with_threads() around it, or one for each core where
/// there is none. One thread takes them in order. After an error, which may be a Watch's, no
/// further call begins, and the first is thrown again.
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work);

/// The same with threads as with_threads() has them. After each call it reports the finished share.
void for_each_index(
    std::size_t count, int threads, const std::function<void(std::size_t)>& work,
    const std::function<void(double)>& progress = [](double) {});

/// Calls work(first, last) for pieces of at most `block` numbers, which cover those from `first` to `last` - 1.
void for_each_block(std::size_t first, std::size_t last, std::size_t block,
                    const std::function<void(std::size_t, std::size_t)>& work);

/// Processor time of the calling thread since its start, in seconds. It does not advance while the thread
/// waits.
[[nodiscard]] double thread_seconds();

}  // namespace hitpipe::host
