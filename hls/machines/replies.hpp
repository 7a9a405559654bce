// Answers of rays, on their way out (docs/core.md). Each waits in a queue with a place for every ray, and
// leaves with the tag with which its ray came. Then the ray's number is free. The answer of what was no ray
// has failed.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {

/// The format "tTgGiI", for example t20g16i5.
///   T  bits of a distance;  G  bits of a tag;  I  bits of a ray's number
struct ReplyBits {
  int distance = 20;  ///< T
  int tag = 16;       ///< G
  int ray = 5;        ///< I

  static constexpr FormatField fields[] = {{"t", "T", 4, 36}, {"g", "G", 1, 64}, {"i", "I", 1, 8}};
  static constexpr const char* type = "ReplyFormat";

  constexpr int rays() const { return power_of_two(ray); }
  friend constexpr bool operator==(const ReplyBits& a, const ReplyBits& b) {
    return a.distance == b.distance && a.tag == b.tag && a.ray == b.ray;
  }
};
template <int Distance, int Tag, int Ray>
struct ReplyFormat {
  static constexpr ReplyBits bits{Distance, Tag, Ray};
  Width<Distance> distance{};
  Width<Tag> tag{};
  Width<Ray> ray{};
  constexpr operator ReplyBits() const { return bits; }
};

namespace replies {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto number_of(const F& f) { return f.ray * 0_w + Width<triangle_number_bits>(); }
  /// Of a word in the queue: ray, failed, T, number.
  static constexpr auto answer_of(const F& f) { return f.ray + f.distance + number_of(f) + 1_w; }

  using Ray = decltype(format.ray + 0_w);
  using Tag = decltype(format.tag + 0_w);
  using Distance = decltype(format.distance + 0_w);
  using Number = decltype(number_of(format));
};

template <class D, class F>
struct State {
  using W = Widths<F>;
  using bit = typename D::bit;

  IdQueue<D, F> queue;
  bit there;  ///< an answer that leaves
  Word<D, typename W::Ray> ray;
  bit failed;
  Word<D, typename W::Distance> t;
  Word<D, typename W::Number> number;
  bit freed;
  Word<D, typename W::Ray> freed_ray;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReplyBits bits = format;
    IdQueue<D, F>::for_each({"used", "oldest", "there"}, bits.ray, self.queue, visit);
    visit(control_field("there_1", 1), self.there);
    visit(data_field("ray_1", bits.ray), self.ray);
    visit(data_field("failed_1", 1), self.failed);
    visit(data_field("t_1", bits.distance), self.t);
    visit(data_field("number_1", triangle_number_bits), self.number);
    visit(control_field("freed_2", 1), self.freed);
    visit(data_field("freed_ray_2", bits.ray), self.freed_ray);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit valid, ready;  ///< both are 1: a ray begins
  Word<D, typename W::Ray> at;
  Word<D, typename W::Tag> tag;
  bit error;    ///< it is no ray
  bit answers;  ///< best_hits has the answer of a ray
  Word<D, typename W::Ray> answered;
  Word<D, typename W::Distance> t;
  Word<D, typename W::Number> number;
  bit failed;
  bit taken;  ///< the answer that is given is taken

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReplyBits bits = format;
    visit(data_field("ray_valid", 1), self.valid);
    visit(data_field("ray_ready", 1), self.ready);
    visit(data_field("begun_at", bits.ray), self.at);
    visit(data_field("ray_tag", bits.tag), self.tag);
    visit(data_field("ray_error", 1), self.error);
    visit(data_field("answer", 1), self.answers);
    visit(data_field("answered", bits.ray), self.answered);
    visit(data_field("answer_t", bits.distance), self.t);
    visit(data_field("answer_number", triangle_number_bits), self.number);
    visit(data_field("answer_failed", 1), self.failed);
    visit(data_field("hit_ready", 1), self.taken);
  }
};

template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit there;
  Word<D, typename W::Tag> tag;
  Word<D, typename W::Distance> t;
  Word<D, typename W::Number> number;  ///< all ones: no hit
  bit failed;
  bit freed;  ///< to the door
  Word<D, typename W::Ray> freed_ray;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReplyBits bits = format;
    visit(data_field("hit_valid", 1), self.there);
    visit(data_field("hit_tag", bits.tag), self.tag);
    visit(data_field("hit_t", bits.distance), self.t);
    visit(data_field("hit_number", triangle_number_bits), self.number);
    visit(data_field("hit_failed", 1), self.failed);
    visit(data_field("freed", 1), self.freed);
    visit(data_field("freed_ray", bits.ray), self.freed_ray);
  }
};

template <class Memory>
struct Memories {
  Memory waiting;  ///< the queue
  Memory tags;     ///< by ray, with its error above

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReplyBits bits = format;
    using W = Widths<ReplyBits>;
    visit(MemoryShape{"waiting", bits.rays(), W::answer_of(bits), MemoryKind::block}, self.waiting);
    visit(MemoryShape{"tags", bits.rays(), bits.tag + 1, MemoryKind::block}, self.tags);
  }
};

struct Replies {
  static constexpr const char* name = "replies";
  static constexpr const char* summary = "gives answers out, with the tags of their rays";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = ReplyBits;
  using BuiltIn = FormatList<ReplyFormat<20, 16, 5>, ReplyFormat<20, 16, 7>>;
  template <class D, class F>
  using State = replies::State<D, F>;
  template <class D, class F>
  using Inputs = replies::Inputs<D, F>;
  template <class D, class F>
  using Outputs = replies::Outputs<D, F>;
  template <class Memory>
  using Memories = replies::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    const auto tag = memories.tags.word(format.tag + 1_w);
    return {state.there,
            slice(tag, format.tag - 1_w, 0_w),
            state.t,
            state.number,
            state.failed | typename D::bit(bit_at(tag, format.tag)),
            state.freed,
            state.freed_ray};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto i = format.ray;
    const auto number_bits = Widths<F>::number_of(format);
    const auto failed_at = number_bits + format.distance;
    memories.tags.write(as("ray_begins", in.valid & in.ready), in.at, cat(in.error, in.tag));
    memories.waiting.write(in.answers, as("place", state.queue.place(i)),
                           cat(cat(in.answered, in.failed), cat(in.t, in.number)));

    const auto word = memories.waiting.word(Widths<F>::answer_of(format));
    const Bit leaves = as("leaves", state.there & in.taken);
    const Bit holds = as("holds", state.there & ~in.taken);
    const Bit moves = as("moves", state.queue.there & ~holds);
    state.freed = leaves;
    state.freed_ray = state.ray;
    state.ray = as("leaving_ray", select(holds, state.ray, slice(word, failed_at + i, failed_at + 1_w)));
    state.failed = select(holds, state.failed, Bit(bit_at(word, failed_at)));
    state.t = select(holds, state.t, slice(word, failed_at - 1_w, number_bits));
    state.number = select(holds, state.number, slice(word, number_bits - 1_w, 0_w));
    state.there = holds | moves;
    memories.tags.ask(state.ray);
    memories.waiting.ask(state.queue.step(i, in.answers, moves));
  }
};

}  // namespace replies

using replies::Replies;

}  // namespace hls
}  // namespace hitpipe
