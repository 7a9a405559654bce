// How the C interface tells of errors: exceptions end here, as a status and one line for the thread.
#pragma once

#include <exception>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>

#include "hitpipe/ref.h"
#include "host/default_arithmetic.hpp"
#include "host/watch.hpp"

namespace hitpipe::library {

/// The caller asked for what is not allowed.
class Refusal : public std::runtime_error {
 public:
  Refusal(hitpipe_status status, const std::string& line) : std::runtime_error(line), status_(status) {}
  [[nodiscard]] hitpipe_status status() const { return status_; }

 private:
  hitpipe_status status_;
};

/// Keeps the line for hitpipe_error(). Returns the status.
hitpipe_status failed(hitpipe_status status, const char* line) noexcept;

/// What a call of this thread looks at: throws a Refusal if the thread's hitpipe_watch ends it. Empty: the thread has
/// none.
std::function<void()> look_of_thread();

/// Runs a call of the interface, in the arithmetic that answers are defined in.
template <class Call>
hitpipe_status guarded(Call&& call) noexcept {
  const host::DefaultArithmetic arithmetic;
  try {
    const host::Watch watch(look_of_thread());
    call();
    return HITPIPE_OK;
  } catch (const Refusal& refusal) {
    return failed(refusal.status(), refusal.what());
  } catch (const std::bad_alloc&) {
    return failed(HITPIPE_FAILED, "out of memory");
  } catch (const std::exception& error) {
    return failed(HITPIPE_FAILED, error.what());
  }
}

/// Throws a Refusal that names the pointer.
template <class T>
T& given(T* pointer, const char* name) {
  if (pointer == nullptr)
    throw Refusal(HITPIPE_BAD_ARGUMENT, std::string(name) + ": a null pointer is not allowed");
  return *pointer;
}

/// Throws a Refusal unless index < count.
void check_index(std::size_t index, std::size_t count, const char* what);

}  // namespace hitpipe::library
