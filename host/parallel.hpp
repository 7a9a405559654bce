// Work on a limited number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace hitpipe::host {

/// Runs `work`. What it does in parallel through TBB gets at most `threads` threads, and never more than one
/// a core; 0: one a core.
void with_threads(int threads, const std::function<void()>& work);

/// Calls work(i) for each i below `count`, on threads as with_threads(). Tells after each which share of all
/// is done.
void for_each_index(
    std::size_t count, int threads, const std::function<void(std::size_t)>& work,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace hitpipe::host
