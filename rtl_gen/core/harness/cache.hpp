// A cache, which memory sees in place of the rays.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "bits.hpp"
#include "core.hpp"
#include "episode.hpp"
#include "lite.hpp"

struct Cache : Episode {
  static constexpr bool hides_requests = true;

  template <class System>
  void start(System& system) {
    system.write(CORE_REG_MOST_LINES, 1 + system.random() % 12);
  }
  void forget(Lite& lite) { lite.ask_write(CORE_REG_CONTROL, CORE_EMPTY_CACHE, 15); }
  template <class Registers>
  void count(Registers& registers, const Top& top, uint32_t) {
    registers.count(CORE_COUNT_CACHE_LINES, top.m_axi_arvalid && top.m_axi_arready);
  }
  template <class Registers>
  uint32_t known(const Registers& registers, uint32_t at) const {
    for (const uint32_t counter :
         std::initializer_list<uint32_t>{CORE_COUNT_RECORDS, CORE_COUNT_TRIANGLES, CORE_COUNT_IDLE,
                                         CORE_COUNT_REFUSED, CORE_COUNT_CACHE_HITS, CORE_COUNT_CACHE_JOINS})
      if (at / 8 == counter / 8) return counter != CORE_COUNT_IDLE && !registers.had_ray() ? ~uint32_t{0} : 0;
    if (at == CORE_REG_STATUS)
      return ~(CORE_BUS_ERROR | (registers.resetting() ? CORE_RESETTING | CORE_IDLE : 0));
    return ~uint32_t{0};
  }
  template <class System>
  void check_counters(System& system) {
    const uint64_t found = system.counter(CORE_COUNT_CACHE_HITS) + system.counter(CORE_COUNT_CACHE_JOINS);
    if (found + system.counter(CORE_COUNT_CACHE_LINES) !=
        system.counter(CORE_COUNT_RECORDS) + system.counter(CORE_COUNT_TRIANGLES))
      fail("hits, joins and lines of the cache are not what rays read, register", CORE_COUNT_CACHE_HITS);
    // In each cycle a ray asks for nothing, is refused, or is granted. Some cycles pass while the counters are read.
    const uint64_t asked = system.counter(CORE_COUNT_RECORDS) + system.counter(CORE_COUNT_TRIANGLES) +
                           system.counter(CORE_COUNT_REFUSED);
    const uint64_t before = system.counter(CORE_COUNT_CYCLES), idle = system.counter(CORE_COUNT_IDLE),
                   after = system.counter(CORE_COUNT_CYCLES);
    if (asked + idle < before || asked + idle > after)
      fail("cycles with a question or none are not all, register", CORE_COUNT_IDLE);
  }
};
