// Floating-point arithmetic as a caller may have set it: another rounding, denormal numbers flushed.
#pragma once

#include <array>
#include <cfenv>
#include <cstdint>
#include <vector>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace hitpipe {

/// Set while it lives.
class CallersArithmetic {
 public:
  struct Choice {
    const char* name;
    int rounding;
    bool flushes;
  };
  static std::vector<Choice> choices() {
    std::vector<Choice> all{{"default", FE_TONEAREST, false},
                            {"upward", FE_UPWARD, false},
                            {"downward", FE_DOWNWARD, false},
                            {"toward zero", FE_TOWARDZERO, false}};
#if defined(__x86_64__) || defined(__aarch64__)
    all.push_back({"flushed", FE_TONEAREST, true});
    all.push_back({"flushed, upward", FE_UPWARD, true});
#endif
    return all;
  }

  explicit CallersArithmetic(const Choice& choice) {
    std::fegetenv(&before_);
    std::fesetround(choice.rounding);
    if (!choice.flushes) return;
#if defined(__x86_64__)
    _mm_setcsr(_mm_getcsr() | 0x8040U);  // FTZ and DAZ
#elif defined(__aarch64__)
    __builtin_aarch64_set_fpcr(__builtin_aarch64_get_fpcr() | (1U << 24U));  // FZ
#endif
  }
  ~CallersArithmetic() {
    std::fesetenv(&before_);
  }
  CallersArithmetic(const CallersArithmetic&) = delete;
  CallersArithmetic& operator=(const CallersArithmetic&) = delete;

  /// Rounding, exception flags and, where it is known, the whole control register.
  static std::array<std::uint64_t, 3> state() {
    std::array<std::uint64_t, 3> now{static_cast<std::uint64_t>(std::fegetround()),
                                     static_cast<std::uint64_t>(std::fetestexcept(FE_ALL_EXCEPT)), 0};
#if defined(__x86_64__)
    now[2] = _mm_getcsr();
#elif defined(__aarch64__)
    now[2] = __builtin_aarch64_get_fpcr();
#endif
    return now;
  }

 private:
  std::fenv_t before_{};
};

}  // namespace hitpipe
