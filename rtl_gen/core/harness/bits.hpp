// What ports show: bytes and random bits. And how a check ends that fails.
#pragma once

#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <type_traits>

[[noreturn]] inline void fail(const std::string& what, uint64_t where) {
  std::printf("FAIL %s %" PRIu64 "\n", what.c_str(), where);
  std::exit(1);
}

// Why a ray has failed.
struct Why {
  enum : uint64_t { no_ray = 1, steps, levels, outside, unread };
};

struct Random {
  uint64_t state;
  uint32_t operator()() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<uint32_t>(state >> 32);
  }
  bool one_in(uint32_t count) { return (*this)() % count == 0; }
};

// Of a number that has room in it.
template <class Port>
void set(Port& port, uint64_t value) {
  port = static_cast<Port>(value);
}
// Verilator has a port of more than 64 bits as an array of 32-bit words.
template <class Port>
void put_bytes(Port& port, const uint8_t* bytes, size_t count) {
  if constexpr (std::is_integral_v<Port>) port = 0;
  for (size_t i = 0; i < count; ++i) {
    if constexpr (std::is_integral_v<Port>)
      port = static_cast<Port>(port | static_cast<uint64_t>(bytes[i]) << 8 * i);
    else
      port[i / 4] = (i % 4 == 0 ? 0 : port[i / 4]) | static_cast<uint32_t>(bytes[i]) << i % 4 * 8;
  }
}
template <class Port>
void get_bytes(const Port& port, uint8_t* bytes, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if constexpr (std::is_integral_v<Port>)
      bytes[i] = static_cast<uint8_t>(static_cast<uint64_t>(port) >> 8 * i);
    else
      bytes[i] = static_cast<uint8_t>(port[i / 4] >> i % 4 * 8);
  }
}
// What a port shows while its valid bit is 0.
template <class Port>
void put_rubbish(Port& port, size_t bytes, Random& random) {
  if constexpr (std::is_integral_v<Port>) {
    const uint64_t bits = static_cast<uint64_t>(random()) << 32 | random();
    port = static_cast<Port>(bits & (~uint64_t{0} >> (64 - 8 * bytes)));
  } else {
    for (size_t i = 0; i < bytes; i += 4)
      port[i / 4] = bytes - i < 4 ? random() & ((1u << 8 * (bytes - i)) - 1) : random();
  }
}
