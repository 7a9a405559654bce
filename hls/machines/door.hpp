// New rays (docs/core.md): each gets a number, which it has until its answer has left. Numbers that no ray
// has had yet come first, then those that answers gave back. A ray begins in every second cycle at most.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "tTiI", for example t20i5.
struct DoorBits {
  int distance = 20;  ///< T: bits of a distance
  int ray = 5;        ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {{"t", "T", 4, 36}, {"i", "I", 1, 8}};

  constexpr int rays() const { return power_of_two(ray); }
  constexpr int count() const { return ray + 1; }
  friend constexpr bool operator==(const DoorBits&, const DoorBits&) = default;
};

namespace door {

constexpr Data<"ray_valid"> ray_valid;  // a ray comes; it begins if `ray_ready` is 1
constexpr Data<"ray_length", &DoorBits::distance> ray_length;
constexpr Data<"ray_error"> ray_error;                    // it is no ray: it goes nowhere
constexpr Data<"ray_any"> ray_any;                        // it wants any hit, else the nearest
constexpr Data<"most_rays", &DoorBits::count> most_rays;  // in flight, 1 or more; there are 2^I numbers
constexpr Data<"takes"> takes;                            // best_hits takes a ray in this cycle
constexpr Data<"freed"> freed;                            // an answer has left
constexpr Data<"freed_ray", &DoorBits::ray> freed_ray;

constexpr Data<"ray_ready"> ray_ready;
constexpr Data<"begun_at", &DoorBits::ray> begun_at;  // the number that the next ray will have
constexpr Data<"new_ray"> new_ray;                    // to best_hits
constexpr Data<"begun", &DoorBits::ray> begun;
constexpr Data<"length", &DoorBits::distance> length;
constexpr Data<"any"> any_hit;

constexpr Control<"given", &DoorBits::count> given;  // numbers that have been given for the first time
using Free = IdQueue<"free_">;                       // numbers that answers gave back
constexpr Control<"has"> has;                        // a number for the next ray
constexpr Data<"next", &DoorBits::ray> next_number;
constexpr Control<"begins_1"> begins_1;  // a ray that has come
constexpr Data<"begun_1", &DoorBits::ray> begun_1;
constexpr Data<"length_1", &DoorBits::distance> length_1;
constexpr Data<"any_1"> any_1;

constexpr Block<"free_rays", &DoorBits::rays, &DoorBits::ray> free_rays;

struct Door {
  static constexpr const char* name = "door";
  static constexpr const char* summary = "gives each new ray a number";
  static constexpr const char* header = __FILE__;
  using Bits = DoorBits;
  using BuiltIn = FormatList<Fixed<DoorBits{20, 5}>, Fixed<DoorBits{20, 7}>>;
  struct In : List<ray_valid, ray_length, ray_error, ray_any, most_rays, takes, freed, freed_ray> {};
  struct Out : List<ray_ready, begun_at, new_ray, begun, length, any_hit> {};
  struct State : Join<List<given>, Free::State, List<has, next_number, begins_1, begun_1, length_1, any_1>> {
  };
  struct Memory : List<free_rays> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& /*memory*/, const auto& out) {
    out[ray_ready] = is_ready(now);
    out[begun_at] = now[next_number];
    out[new_ray] = now[begins_1];
    out[begun] = now[begun_1];
    out[length] = now[length_1];
    out[any_hit] = now[any_1];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit accepts = as("accepts", in[ray_valid] & is_ready(now));
    next.where(accepts)[begun_1] = now[next_number];
    next.where(accepts)[length_1] = only(Bit(~in[ray_error]), in[ray_length]);
    next.where(accepts)[any_1] = in[ray_any];
    next[begins_1] = accepts | (now[begins_1] & ~in[takes]);

    const auto i = width_of(now[next_number]);
    const Bit never_given = as("never_given", Bit(now[given] < in[most_rays]) & ~Bit(bit_at(now[given], i)));
    const Bit from_free = as("from_free", ~now[has] & ~never_given & now[Free::there]);
    const Bit from_given = as("from_given", ~now[has] & never_given);
    const auto number = select(never_given, slice(now[given], i - 1_w, 0_w), memory[free_rays].word());
    next[next_number] = select(now[has], now[next_number], number);
    next[has] = (now[has] & ~accepts) | from_free | from_given;
    next[given] = plus(now[given], from_given);
    memory[free_rays].write(in[freed], as("free_place", Free::place(now)), in[freed_ray]);
    memory[free_rays].ask(Free::step<D>(now, next, in[freed], from_free));
  }

 private:
  static constexpr auto is_ready(const auto& now) { return as("takes_ray", now[has] & ~now[begins_1]); }
};

}  // namespace door

using door::Door;

}  // namespace hitpipe::hls
