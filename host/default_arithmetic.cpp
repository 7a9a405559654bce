#include "host/default_arithmetic.hpp"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace hitpipe::host {

// These are here and not in the header so that a compiler, which may not know the pragma FENV_ACCESS, moves no
// computation across them.
DefaultArithmetic::DefaultArithmetic() {
  std::fegetenv(&callers_);
  std::fesetenv(FE_DFL_ENV);
#if defined(__SSE__)
  // Not every C library's default clears FTZ and DAZ, too. This is the state of a new process.
  _mm_setcsr(0x1f80);
#endif
}

DefaultArithmetic::~DefaultArithmetic() {
  std::fesetenv(&callers_);
}

}  // namespace hitpipe::host
