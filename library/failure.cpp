#include "library/failure.hpp"

#include <fmt/format.h>

namespace hitpipe::library {

namespace {

std::string& line_of_thread() {
  thread_local std::string line;
  return line;
}

}  // namespace

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

const char* hitpipe_version(void) {
  return HITPIPE_VERSION;
}
