// The floating-point arithmetic that hitpipe's code is written for: to nearest, denormal numbers as they are, no traps.
#pragma once

#include <cfenv>

namespace hitpipe::host {

/// While it lives, the thread computes so, whatever its caller has chosen. The caller's choice and exception flags come
/// back with its end.
class DefaultArithmetic {
 public:
  DefaultArithmetic();
  ~DefaultArithmetic();
  DefaultArithmetic(const DefaultArithmetic&) = delete;
  DefaultArithmetic& operator=(const DefaultArithmetic&) = delete;

 private:
  std::fenv_t callers_{};
};

}  // namespace hitpipe::host
