// New rays (docs/core.md): each gets a number, which it has until its answer has left. Numbers that no ray
// has had yet come first, then those that answers gave back. A ray begins in every second cycle at most.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "tTiI", for example t20i5, or "tTiIqQuU".
struct DoorBits {
  int distance = 20;                  ///< T: bits of a distance
  int ray = 5;                        ///< I: bits of a ray's number
  int questions = 0;                  ///< Q: rays may want crossings
  int number = triangle_number_bits;  ///< U: bits of a triangle's number; not written: those of an image

  static constexpr FormatField fields[] = {{"t", "T", 4, 36},
                                           {"i", "I", 1, 8},
                                           {"q", "Q", 1, 1, nullptr, true},
                                           {"u", "U", 4, triangle_number_bits, nullptr, true}};

  constexpr int rays() const { return power_of_two(ray); }
  friend constexpr bool operator==(const DoorBits&, const DoorBits&) = default;
};

namespace door {

using namespace channels;

constexpr Control<"given", ray_count_bits> given;  // numbers that have been given for the first time
using Free = IdQueue<"free_">;                     // numbers that answers gave back
constexpr Control<"has"> has;                      // a number for the next ray
constexpr Data<"next", ray_bits> next_number;
constexpr Control<"begins_1"> begins_1;  // a ray that has come
struct Ray : List<begun, length, any_hit> {};
struct Question : List<counts, turned, from_t, from_number> {};

// What says whether axes trade places in the tests of a ray, or its direction is turned.
constexpr DataIf<"ray_major_y", 1, has_questions> major_y;
constexpr DataIf<"ray_major_z", 1, has_questions> major_z;
constexpr DataIf<"ray_back_m", 1, has_questions> back_m;
struct Turn : List<major_y, major_z, back_m> {};

constexpr Block<"free_rays", &DoorBits::rays, ray_bits> free_rays;

struct Door {
  static constexpr const char* name = "door";
  static constexpr const char* summary = "gives each new ray a number";
  using Bits = DoorBits;
  using BuiltIn = FormatList<Fixed<DoorBits{20, 5}>, Fixed<DoorBits{20, 7}>>;
  struct In : Join<List<ray_valid, ray_length, ray_error, ray_any, most_rays>, NewRay::Back, Freed,
                   List<ray_once, ray_from_t, ray_from_number>, Turn> {};
  struct Out : Join<List<ray_ready, begun_at>, NewRay> {};
  struct State : Join<List<given>, Free::State, List<has, next_number, begins_1>, Held<Ray>, Held<Question>> {
  };
  struct Memory : List<free_rays> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& /*memory*/, const auto& out) {
    out[ray_ready] = is_ready(now);
    out[begun_at] = now[next_number];
    out[new_ray] = now[begins_1];
    out.from_held(now, Ray());
    if (has_questions(DoorBits(f))) out.from_held(now, Question());
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit accepts = as("accepts", in[ray_valid] & is_ready(now));
    next.where(accepts)[held<begun>] = now[next_number];
    next.where(accepts)[held<length>] = only(Bit(~in[ray_error]), in[ray_length]);
    if (has_questions(DoorBits(f)))
      take_question<D>(f, accepts, in, next);
    else
      next.where(accepts)[held<any_hit>] = in[ray_any];
    next[begins_1] = accepts | (now[begins_1] & ~in[takes]);

    const auto i = width_of(now[next_number]);
    const Bit never_given = as("never_given", Bit(now[given] < in[most_rays]) & ~Bit(bit_at(now[given], i)));
    const Bit from_free = as("from_free", ~now[has] & ~never_given & now[Free::there]);
    const Bit from_given = as("from_given", ~now[has] & never_given);
    const auto number = select(never_given, slice(now[given], i - 1_w, 0_w), memory[free_rays].word());
    next[next_number] = select(now[has], now[next_number], number);
    next[has] = (now[has] & ~accepts) | from_free | from_given;
    next[given] = plus(now[given], from_given);
    memory[free_rays].write(in[Freed::is], as("free_place", Free::place(now)), in[Freed::ray]);
    memory[free_rays].ask(Free::step<D>(now, next, in[Freed::is], from_free));
  }

 private:
  /// A ray that wants the next crossing has a place from which it looks. One that counts has its end there.
  template <class D>
  static constexpr void take_question(const auto& f, const auto& accepts, const auto& in, const auto& next) {
    using Bit = typename D::bit;
    const Bit counting = as("counting", in[ray_once] & in[ray_any]);
    next.where(accepts)[held<any_hit>] = in[ray_any] & ~in[ray_once];
    next.where(accepts)[held<counts>] = counting;
    next.where(accepts)[held<turned>] = in[back_m] ^ in[major_y] ^ in[major_z];
    next.where(accepts)[held<from_t>] =
        only(in[ray_once], select(in[ray_any], in[ray_length], in[ray_from_t]));
    next.where(accepts)[held<from_number>] =
        only(in[ray_once], at_most<D>(in[ray_from_number], from_number.width(f)));
  }
  static constexpr auto is_ready(const auto& now) { return as("takes_ray", now[has] & ~now[begins_1]); }
};

}  // namespace door

using door::Door;

}  // namespace hitpipe::hls
