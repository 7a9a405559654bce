// What the harness does for a feature of a core. A feature's file has a struct derived from Episode with what differs,
// and features.hpp, which hitpipe writes, names those of one core.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>

#include "bits.hpp"
#include "core.hpp"
#include "lite.hpp"

// For a feature for which nothing is to do.
struct Episode {
  static constexpr bool hides_requests = false;  // nobody outside sees what rays ask for
  static constexpr bool hides_rays = false;      // or when they begin, and answers leave
  static constexpr size_t numbers = 0;           // of a ray in the scene file, behind those of all cores

  // Before a run: its registers are written.
  template <class System>
  void start(System&) {}
  // Before a cycle in which the host may send a ray.
  void announce(Lite&, Random&) {}
  // In each cycle: what its pins show, and what the clock edge takes.
  void show(Top&, Random&, uint64_t) {}
  void step(Top&, Random&, uint64_t) {}
  // What the pins must show by the registers, and what a clock edge does to these if address `at` is written.
  template <class Registers>
  void compare(const Top&, const Registers&) const {}
  template <class Registers>
  void count(Registers&, const Top&, uint32_t) {}
  // Bits of a register that what passes outside tells.
  template <class Registers>
  uint32_t known(const Registers&, uint32_t) const {
    return ~uint32_t{0};
  }
  // A hard reset begins, or a soft one ends.
  void reset() {}
  void end_reset() {}
  // Something is on its way to memory or from it.
  bool is_busy() const { return false; }
  // The image has changed.
  void forget(Lite&) {}
  // After a run: bits of the status, and counters.
  uint32_t status() { return 0; }
  template <class System>
  void check_counters(System&) {}
  // What goes wrong beside the image.
  template <class System, class Host>
  void damage(System&, Host&) {}

  // A ray asks for crossings, which are counted or come one after the other.
  static bool asks_crossings(const core_ray&) { return false; }
  // The core says of it that it is none.
  static void spoil(core_ray&) {}
  // The rest of the answer for a hit, with the numbers of the scene file.
  static bool is_answer(const core_hit&, const uint64_t*) { return true; }
};

template <class... All>
class EpisodesOf {
 public:
  static constexpr bool hides_requests = (All::hides_requests || ...);
  static constexpr bool hides_rays = (All::hides_rays || ...);
  static constexpr size_t numbers = (All::numbers + ... + 0);

  template <class Do>
  void each(const Do& act) {
    std::apply([&](auto&... one) { (act(one), ...); }, all_);
  }
  template <class Do>
  void each(const Do& act) const {
    std::apply([&](const auto&... one) { (act(one), ...); }, all_);
  }
  template <class One>
  One& get() {
    return std::get<One>(all_);
  }
  static bool asks_crossings(const core_ray& ray) { return (All::asks_crossings(ray) || ...); }
  static void spoil(core_ray& ray) { (All::spoil(ray), ...); }
  static bool is_answer(const core_hit& hit, const uint64_t* numbers_of_ray) {
    return (All::is_answer(hit, numbers_of_ray) && ...);
  }

 private:
  std::tuple<All...> all_;
};
