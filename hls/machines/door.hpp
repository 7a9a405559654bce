// New rays (docs/core.md): each gets a number, which it has until its answer has left. Numbers that no ray
// has had yet come first, then those that answers gave back. A ray begins in every second cycle at most.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

/// The format "tTiI", for example t20i5.
///   T  bits of a distance;  I  bits of a ray's number
struct DoorBits {
  int distance = 20;  ///< T
  int ray = 5;        ///< I

  static constexpr FormatField fields[] = {{"t", "T", 4, 36}, {"i", "I", 1, 8}};
  static constexpr const char* type = "DoorFormat";

  constexpr int rays() const { return power_of_two(ray); }
  friend constexpr bool operator==(const DoorBits& a, const DoorBits& b) {
    return a.distance == b.distance && a.ray == b.ray;
  }
};
template <int Distance, int Ray>
struct DoorFormat {
  static constexpr DoorBits bits{Distance, Ray};
  Width<Distance> distance{};
  Width<Ray> ray{};
  constexpr operator DoorBits() const { return bits; }
};

namespace door {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  using Ray = decltype(format.ray + 0_w);
  using Count = decltype(format.ray + 1_w);
  using Distance = decltype(format.distance + 0_w);
};

template <class D, class F>
struct State {
  using W = Widths<F>;
  using bit = typename D::bit;

  Word<D, typename W::Count> given;  ///< numbers that have been given for the first time
  IdQueue<D, F> free;
  bit has;  ///< a number for the next ray
  Word<D, typename W::Ray> next;
  bit begins;  ///< a ray that has come
  Word<D, typename W::Ray> begun;
  Word<D, typename W::Distance> length;
  bit any;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const DoorBits bits = format;
    visit(control_field("given", bits.ray + 1), self.given);
    IdQueue<D, F>::for_each({"free_used", "free_oldest", "free_there"}, bits.ray, self.free, visit);
    visit(control_field("has", 1), self.has);
    visit(data_field("next", bits.ray), self.next);
    visit(control_field("begins_1", 1), self.begins);
    visit(data_field("begun_1", bits.ray), self.begun);
    visit(data_field("length_1", bits.distance), self.length);
    visit(data_field("any_1", 1), self.any);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit valid;  ///< a ray comes; it begins if `ready` is 1
  Word<D, typename W::Distance> length;
  bit error;                             ///< it is no ray: it goes nowhere
  bit any;                               ///< it wants any hit, else the nearest
  Word<D, typename W::Count> most_rays;  ///< in flight, 1 or more; there are 2^I numbers
  bit takes;                             ///< best_hits takes a ray in this cycle
  bit freed;                             ///< an answer has left
  Word<D, typename W::Ray> freed_ray;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const DoorBits bits = format;
    visit(data_field("ray_valid", 1), self.valid);
    visit(data_field("ray_length", bits.distance), self.length);
    visit(data_field("ray_error", 1), self.error);
    visit(data_field("ray_any", 1), self.any);
    visit(data_field("most_rays", bits.ray + 1), self.most_rays);
    visit(data_field("takes", 1), self.takes);
    visit(data_field("freed", 1), self.freed);
    visit(data_field("freed_ray", bits.ray), self.freed_ray);
  }
};

template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit ready;
  Word<D, typename W::Ray> at;  ///< the number that the next ray will have
  bit begins;                   ///< to best_hits
  Word<D, typename W::Ray> begun;
  Word<D, typename W::Distance> length;
  bit any;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const DoorBits bits = format;
    visit(data_field("ray_ready", 1), self.ready);
    visit(data_field("begun_at", bits.ray), self.at);
    visit(data_field("new_ray", 1), self.begins);
    visit(data_field("begun", bits.ray), self.begun);
    visit(data_field("length", bits.distance), self.length);
    visit(data_field("any", 1), self.any);
  }
};

template <class Memory>
struct Memories {
  Memory free_rays;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const DoorBits bits = format;
    visit(MemoryShape{"free_rays", bits.rays(), bits.ray, MemoryKind::block}, self.free_rays);
  }
};

struct Door {
  static constexpr const char* name = "door";
  static constexpr const char* summary = "gives each new ray a number";
  static constexpr const char* header = __FILE__;
  using Bits = DoorBits;
  using BuiltIn = FormatList<DoorFormat<20, 5>, DoorFormat<20, 7>>;
  template <class D, class F>
  using State = door::State<D, F>;
  template <class D, class F>
  using Inputs = door::Inputs<D, F>;
  template <class D, class F>
  using Outputs = door::Outputs<D, F>;
  template <class Memory>
  using Memories = door::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& /*format*/, const State<D, F>& state, Memories<Memory>&) {
    return {ready<D>(state), state.next, state.begins, state.begun, state.length, state.any};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto i = format.ray;
    const Bit accepts = as("accepts", in.valid & ready<D>(state));
    state.begun = select(accepts, state.next, state.begun);
    const auto length = in.length & spread(Bit(~in.error), format.distance);
    state.length = select(accepts, as_unsigned(length), state.length);
    state.any = select(accepts, in.any, state.any);
    state.begins = accepts | (state.begins & ~in.takes);

    const Bit never_given = as("never_given", Bit(state.given < in.most_rays) & ~Bit(bit_at(state.given, i)));
    const Bit from_free = as("from_free", ~state.has & ~never_given & state.free.there);
    const Bit from_given = as("from_given", ~state.has & never_given);
    state.next = select(state.has, state.next,
                        select(never_given, slice(state.given, i - 1_w, 0_w), memories.free_rays.word(i)));
    state.has = (state.has & ~accepts) | from_free | from_given;
    state.given = as_unsigned(resize(state.given + from_given, i + 1_w));
    memories.free_rays.write(in.freed, as("free_place", state.free.place(i)), in.freed_ray);
    memories.free_rays.ask(state.free.step(i, in.freed, from_free));
  }

 private:
  template <class D, class F>
  static constexpr typename D::bit ready(const State<D, F>& state) {
    return as("takes_ray", state.has & ~state.begins);
  }
};

}  // namespace door

using door::Door;

}  // namespace hls
}  // namespace hitpipe
