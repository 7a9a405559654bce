#include "library/failure.hpp"

#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::library {

namespace {

std::string& line_of_thread() {
  thread_local std::string line;
  return line;
}

/// A look costs the watch's owner more than the call's work between two.
constexpr std::chrono::milliseconds between_looks(50);

thread_local const hitpipe_watch* watch_of_thread = nullptr;

}  // namespace

std::function<void()> look_of_thread() {
  if (watch_of_thread == nullptr) return {};
  return [own = *watch_of_thread, next = std::chrono::steady_clock::now() + between_looks,
          stopped = false]() mutable {
    if (!stopped && std::chrono::steady_clock::now() < next) return;
    // Loops within loops end one after the other.
    stopped = stopped || own.stop(own.context) != 0;
    if (stopped) throw Refusal(HITPIPE_STOPPED, "stopped by the watch of its thread");
    next = std::chrono::steady_clock::now() + between_looks;
  };
}

hitpipe_status failed(hitpipe_status status, const char* line) noexcept {
  try {
    line_of_thread() = line;
  } catch (const std::bad_alloc&) {
    line_of_thread().clear();
  }
  return status;
}

void check_index(std::size_t index, std::size_t count, const char* what) {
  if (index >= count)
    throw Refusal(HITPIPE_BAD_ARGUMENT, fmt::format("{} {}: allowed is 0..{}", what, index, count - 1));
}

}  // namespace hitpipe::library

const char* hitpipe_error(void) {
  return hitpipe::library::line_of_thread().c_str();
}

const hitpipe_watch* hitpipe_set_watch(const hitpipe_watch* watch) {
  return std::exchange(hitpipe::library::watch_of_thread, watch);
}

const char* hitpipe_version(void) {
  return HITPIPE_VERSION;
}
