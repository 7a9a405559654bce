// Random numbers from a fixed seed, which is printed so that a run can be repeated.
#pragma once

#include <cstdint>
#include <iostream>
#include <random>

namespace hitpipe::rtl {

class Seeded {
 public:
  explicit Seeded(std::uint64_t seed) : engine_(seed) { std::cout << "seed " << seed << '\n'; }

  std::uint64_t bits() { return engine_(); }
  /// For functions that draw from an engine themselves.
  operator std::mt19937_64&() { return engine_; }
  /// 0 .. n-1, for n of at least 1.
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  int between(int low, int high) { return low + below(high - low + 1); }
  bool flip() { return (engine_() & 1) != 0; }

  /// Random bits, or a corner: zero, one, all ones, only the top bit, all bits but the top one.
  std::uint64_t value(int width) {
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - width);
    switch (below(8)) {
      case 0:
        return 0;
      case 1:
        return 1;
      case 2:
        return all;
      case 3:
        return all >> 1;
      case 4:
        return all ^ all >> 1;
      default:
        return bits() & all;
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hitpipe::rtl
