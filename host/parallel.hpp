// Work on a limited number of threads, and the processor time of one of them.
#pragma once

#include <cstddef>
#include <functional>

namespace hitpipe::host {

/// Runs `work`. What it does in parallel through TBB uses at most `threads` threads, and at most one for each
/// core. 0: one for each core.
void with_threads(int threads, const std::function<void()>& work);

/// Calls work(i) for each i below `count`, on threads as with_threads(). After each call it reports the
/// finished share.
void for_each_index(
    std::size_t count, int threads, const std::function<void(std::size_t)>& work,
    const std::function<void(double)>& progress = [](double) {});

/// Processor time of the calling thread since its start, in seconds. It does not advance while the thread
/// waits.
[[nodiscard]] double thread_seconds();

}  // namespace hitpipe::host
