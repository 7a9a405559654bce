// Four numbers in a vector, x, y, z and one more, so that the compiler works on all axes at once: one SSE2
// register of binary32 or two of binary64, in the vector extension of GCC and Clang.
#pragma once

#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace hitpipe::ref {

template <class T>
struct PackOf;
template <>
struct PackOf<float> {
  using Type = float __attribute__((vector_size(16)));
  using Mask = std::int32_t __attribute__((vector_size(16)));
};
template <>
struct PackOf<double> {
  using Type = double __attribute__((vector_size(16)));
  using Mask = std::int64_t __attribute__((vector_size(16)));
};
template <class T>
constexpr std::size_t lanes_per_pack = 16 / sizeof(T);
template <class T>
constexpr std::size_t pack_count = sizeof(T) / sizeof(float);

/// The bits of four lanes. A comparison sets all bits of a lane if it holds there, and otherwise none.
template <class T>
struct LaneMask {
  using Pack = typename PackOf<T>::Mask;
  Pack packs[pack_count<T>];

  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) {
    LaneMask result;
    for (std::size_t i = 0; i < pack_count<T>; ++i) result.packs[i] = a.packs[i] | b.packs[i];
    return result;
  }
  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) {
    LaneMask result;
    for (std::size_t i = 0; i < pack_count<T>; ++i) result.packs[i] = a.packs[i] & b.packs[i];
    return result;
  }
  friend LaneMask operator^(const LaneMask& a, const LaneMask& b) {
    LaneMask result;
    for (std::size_t i = 0; i < pack_count<T>; ++i) result.packs[i] = a.packs[i] ^ b.packs[i];
    return result;
  }
};

template <class T>
struct Lanes {
  using Pack = typename PackOf<T>::Type;
  Pack packs[pack_count<T>];

  Lanes() = default;
  Lanes(T x, T y, T z, T w) {
    if constexpr (pack_count<T> == 1) {
      packs[0] = Pack{x, y, z, w};
    } else {
      packs[0] = Pack{x, y};
      packs[1] = Pack{z, w};
    }
  }
  /// The same numbers in another precision.
  template <class U>
  explicit Lanes(const Lanes<U>& other) : Lanes(T(other[0]), T(other[1]), T(other[2]), T(other[3])) {}
  explicit Lanes(const LaneMask<T>& bits) {
    for (std::size_t i = 0; i < pack_count<T>; ++i) packs[i] = reinterpret_cast<Pack>(bits.packs[i]);
  }

  T operator[](std::size_t lane) const { return packs[lane / lanes_per_pack<T>][lane % lanes_per_pack<T>]; }
  void set(std::size_t lane, T value) { packs[lane / lanes_per_pack<T>][lane % lanes_per_pack<T>] = value; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < pack_count<T>; ++i) result.packs[i] = a.packs[i] + b.packs[i];
    return result;
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < pack_count<T>; ++i) result.packs[i] = a.packs[i] - b.packs[i];
    return result;
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < pack_count<T>; ++i) result.packs[i] = a.packs[i] * b.packs[i];
    return result;
  }
  friend LaneMask<T> operator>(const Lanes& a, const Lanes& b) {
    LaneMask<T> result;
    for (std::size_t i = 0; i < pack_count<T>; ++i) result.packs[i] = a.packs[i] > b.packs[i];
    return result;
  }
};

/// Lanes a, b, c, d of `v`, which has one pack.
template <int a, int b, int c, int d, class Pack>
Pack arranged(const Pack& v) {
  return __builtin_shufflevector(v, v, a, b, c, d);
}
/// The upper lane of `v` and the lower of `w`, which have two lanes.
template <class Pack>
Pack across(const Pack& v, const Pack& w) {
  return __builtin_shufflevector(v, w, 1, 2);
}

/// x, y, z, w become y, z, w, x. V: Lanes or LaneMask.
template <class V>
V rotated(const V& v) {
  V result;
  if constexpr (sizeof v.packs == sizeof v.packs[0]) {
    result.packs[0] = arranged<1, 2, 3, 0>(v.packs[0]);
  } else {
    result.packs[0] = across(v.packs[0], v.packs[1]);
    result.packs[1] = across(v.packs[1], v.packs[0]);
  }
  return result;
}

/// x, y, z, w become z, w, x, y.
template <class V>
V rotated_twice(const V& v) {
  V result;
  if constexpr (sizeof v.packs == sizeof v.packs[0]) {
    result.packs[0] = arranged<2, 3, 0, 1>(v.packs[0]);
  } else {
    result.packs[0] = v.packs[1];
    result.packs[1] = v.packs[0];
  }
  return result;
}

/// x, y, z, w become y, z, x, w.
template <class V>
V next_axis(const V& v) {
  V result;
  if constexpr (sizeof v.packs == sizeof v.packs[0]) {
    result.packs[0] = arranged<1, 2, 0, 3>(v.packs[0]);
  } else {
    result.packs[0] = across(v.packs[0], v.packs[1]);
    result.packs[1] = __builtin_shufflevector(v.packs[0], v.packs[1], 0, 3);
  }
  return result;
}

/// Whether the comparison holds in some lane.
inline bool any(const LaneMask<float>& holds) {
#ifdef __SSE2__
  return _mm_movemask_ps(reinterpret_cast<__m128>(holds.packs[0])) != 0;
#else
  const auto& bits = holds.packs[0];
  return (bits[0] | bits[1] | bits[2] | bits[3]) != 0;
#endif
}
inline bool any(const LaneMask<double>& holds) {
  const auto bits = holds.packs[0] | holds.packs[1];
#ifdef __SSE2__
  return _mm_movemask_pd(reinterpret_cast<__m128d>(bits)) != 0;
#else
  return (bits[0] | bits[1]) != 0;
#endif
}

}  // namespace hitpipe::ref
