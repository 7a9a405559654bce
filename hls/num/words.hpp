// The storage behind ap_int: one 64-bit word up to 64 bits, one 128-bit word up to 128, an array of 64-bit
// limbs beyond. A word of width W is canonical when every storage bit above W repeats the sign (signed) or is
// 0 (unsigned). All words are unsigned types, so that their arithmetic is modulo a power of two and never
// undefined. Shift counts are 0 <= n < the storage's bits; bit indices likewise.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

namespace hitpipe::hls::words {

using u64 = std::uint64_t;
__extension__ typedef unsigned __int128 u128;
__extension__ typedef __int128 i128;

template <class T>
concept machine_word = std::same_as<T, u64> || std::same_as<T, u128>;

/// N limbs of two's complement, the least significant first.
template <int N>
struct Limbs {
  u64 limb[N] = {};

  friend constexpr bool operator==(const Limbs&, const Limbs&) = default;

  friend constexpr Limbs operator~(Limbs a) {
    for (u64& x : a.limb) x = ~x;
    return a;
  }
  friend constexpr Limbs operator&(Limbs a, const Limbs& b) {
    for (int i = 0; i < N; ++i) a.limb[i] &= b.limb[i];
    return a;
  }
  friend constexpr Limbs operator|(Limbs a, const Limbs& b) {
    for (int i = 0; i < N; ++i) a.limb[i] |= b.limb[i];
    return a;
  }
  friend constexpr Limbs operator^(Limbs a, const Limbs& b) {
    for (int i = 0; i < N; ++i) a.limb[i] ^= b.limb[i];
    return a;
  }
  friend constexpr Limbs operator+(Limbs a, const Limbs& b) {
    u64 carry = 0;
    for (int i = 0; i < N; ++i) {
      const u128 sum = static_cast<u128>(a.limb[i]) + b.limb[i] + carry;
      a.limb[i] = static_cast<u64>(sum);
      carry = static_cast<u64>(sum >> 64);
    }
    return a;
  }
  friend constexpr Limbs operator-(const Limbs& a, const Limbs& b) {
    Limbs one;
    one.limb[0] = 1;
    return a + (~b + one);
  }
  friend constexpr Limbs operator*(const Limbs& a, const Limbs& b) {
    Limbs product;
    for (int i = 0; i < N; ++i) {
      u64 carry = 0;
      for (int j = 0; i + j < N; ++j) {
        const u128 sum = static_cast<u128>(a.limb[i]) * b.limb[j] + product.limb[i + j] + carry;
        product.limb[i + j] = static_cast<u64>(sum);
        carry = static_cast<u64>(sum >> 64);
      }
    }
    return product;
  }
};

template <int W>
struct Storage {
  using type = Limbs<(W + 63) / 64>;
};
template <int W>
requires(W <= 64) struct Storage<W> {
  using type = u64;
};
template <int W>
requires(W > 64 && W <= 128) struct Storage<W> {
  using type = u128;
};
/// The word that holds W bits.
template <int W>
using word_t = typename Storage<W>::type;

template <class T>
inline constexpr int bits = static_cast<int>(sizeof(T)) * 8;

template <machine_word T>
constexpr auto as_signed(T w) {
  if constexpr (std::same_as<T, u64>) {
    return static_cast<std::int64_t>(w);
  } else {
    return static_cast<i128>(w);
  }
}

/// Limb i of w. Above w's own limbs it is the sign (S) or zero.
template <bool S, machine_word T>
constexpr u64 limb(T w, int i) {
  if (i == 0) return static_cast<u64>(w);
  if constexpr (std::same_as<T, u128>) {
    if (i == 1) return static_cast<u64>(w >> 64);
  }
  return S && as_signed(w) < 0 ? ~u64{0} : 0;
}
template <bool S, int N>
constexpr u64 limb(const Limbs<N>& w, int i) {
  if (i < N) return w.limb[i];
  return S && (w.limb[N - 1] >> 63) != 0 ? ~u64{0} : 0;
}

/// The same number in another word: extended by its own sign (S) or zeros, or cut.
template <class To, bool S, class From>
constexpr To convert(const From& w) {
  if constexpr (std::same_as<To, From>) {
    return w;
  } else if constexpr (machine_word<To> && machine_word<From>) {
    if constexpr (S && bits<From> < bits<To>) {
      return static_cast<To>(static_cast<i128>(as_signed(w)));
    } else {
      return static_cast<To>(w);
    }
  } else if constexpr (std::same_as<To, u64>) {
    return limb<S>(w, 0);
  } else if constexpr (std::same_as<To, u128>) {
    return static_cast<u128>(limb<S>(w, 1)) << 64 | limb<S>(w, 0);
  } else {
    To out;
    for (int i = 0; i < bits<To> / 64; ++i) out.limb[i] = limb<S>(w, i);
    return out;
  }
}

/// Cut to W bits and made canonical.
template <int W, bool S, machine_word T>
constexpr T wrap(T w) {
  constexpr int spare = bits<T> - W;
  if constexpr (spare == 0) {
    return w;
  } else if constexpr (S) {
    return static_cast<T>(as_signed(static_cast<T>(w << spare)) >> spare);
  } else {
    return w & (~T{0} >> spare);
  }
}
template <int W, bool S, int N>
constexpr Limbs<N> wrap(Limbs<N> w) {
  w.limb[N - 1] = wrap<W - 64 * (N - 1), S>(w.limb[N - 1]);
  return w;
}

template <machine_word T>
constexpr T shift_left(T w, int n) {
  return w << n;
}
template <int N>
constexpr Limbs<N> shift_left(const Limbs<N>& w, int n) {
  const int whole = n / 64;
  const int part = n % 64;
  Limbs<N> out;
  for (int i = whole; i < N; ++i) {
    out.limb[i] = w.limb[i - whole] << part;
    if (part != 0 && i > whole) out.limb[i] |= w.limb[i - whole - 1] >> (64 - part);
  }
  return out;
}

/// Filled with the sign (S) or zeros.
template <bool S, machine_word T>
constexpr T shift_right(T w, int n) {
  if constexpr (S) {
    return static_cast<T>(as_signed(w) >> n);
  } else {
    return w >> n;
  }
}
template <bool S, int N>
constexpr Limbs<N> shift_right(const Limbs<N>& w, int n) {
  const int whole = n / 64;
  const int part = n % 64;
  Limbs<N> out;
  for (int i = 0; i < N; ++i) {
    out.limb[i] = limb<S>(w, i + whole) >> part;
    if (part != 0) out.limb[i] |= limb<S>(w, i + whole + 1) << (64 - part);
  }
  return out;
}

template <bool S, machine_word T>
constexpr bool less(T a, T b) {
  if constexpr (S) {
    return as_signed(a) < as_signed(b);
  } else {
    return a < b;
  }
}
template <bool S, int N>
constexpr bool less(const Limbs<N>& a, const Limbs<N>& b) {
  if (a.limb[N - 1] != b.limb[N - 1]) return less<S>(a.limb[N - 1], b.limb[N - 1]);
  for (int i = N - 2; i >= 0; --i) {
    if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i];
  }
  return false;
}

template <class T>
constexpr bool bit(const T& w, int i) {
  return (limb<false>(w, i / 64) >> (i % 64) & 1) != 0;
}

/// A word whose n >= 1 lowest bits are 1 and all others 0.
template <class T>
constexpr T low_ones(int n) {
  return shift_right<false>(~T{}, bits<T> - n);
}

template <class T>
constexpr bool parity(const T& w) {
  u64 folded = 0;
  for (int i = 0; i < bits<T> / 64; ++i) folded ^= limb<false>(w, i);
  return std::popcount(folded) % 2 != 0;
}

template <class T>
struct Division {
  T quotient{};
  T remainder{};
};

/// Unsigned division; the divisor is not 0.
template <machine_word T>
constexpr Division<T> divide(T dividend, T divisor) {
  return {static_cast<T>(dividend / divisor), static_cast<T>(dividend % divisor)};
}
template <int N>
constexpr Division<Limbs<N>> divide(const Limbs<N>& dividend, const Limbs<N>& divisor) {
  Division<Limbs<N>> out;
  for (int i = 64 * N - 1; i >= 0; --i) {
    // Before the shift the remainder is below 2^(64N-1-i), because it is at most the dividend's bits so far.
    out.remainder = shift_left(out.remainder, 1);
    out.remainder.limb[0] |= bit(dividend, i) ? 1u : 0u;
    if (!less<false>(out.remainder, divisor)) {
      out.remainder = out.remainder - divisor;
      out.quotient.limb[i / 64] |= u64{1} << (i % 64);
    }
  }
  return out;
}

}  // namespace hitpipe::hls::words
