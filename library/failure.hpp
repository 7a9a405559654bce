// How the C interface tells of errors: exceptions end here, as a status and one line for the thread.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "hitpipe/ref.h"

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

/// Runs a call of the interface.
template <class Call>
hitpipe_status guarded(Call&& call) noexcept {
  try {
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
