// Answers of rays, on their way out (docs/core.md). Each waits in a queue with a place for every ray, and
// leaves with the tag with which its ray came. Then the ray's number is free. The answer of what was no ray
// has failed.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "tTgGiI", for example t20g16i5, or "tTgGiIqQuU".
struct ReplyBits {
  int distance = 20;                  ///< T: bits of the T of an answer
  int tag = 16;                       ///< G: bits of a tag
  int ray = 5;                        ///< I: bits of a ray's number
  int questions = 0;                  ///< Q: rays may want crossings
  int number = triangle_number_bits;  ///< U: bits of a triangle's number; not written: those of an image

  static constexpr FormatField fields[] = {{"t", "T", 4, 36},
                                           {"g", "G", 1, 64},
                                           {"i", "I", 1, 8},
                                           {"q", "Q", 1, 1, nullptr, true},
                                           {"u", "U", 4, triangle_number_bits, nullptr, true}};

  constexpr int rays() const { return power_of_two(ray); }
  /// All ones may be a count, and no number of a triangle.
  constexpr bool has_few_counts() const { return questions != 0 && number < triangle_number_bits; }
  friend constexpr bool operator==(const ReplyBits&, const ReplyBits&) = default;
};

namespace replies {

using namespace channels;

using Queue = IdQueue<>;
constexpr Control<"there_1"> there_1;  // an answer that leaves
constexpr Data<"ray_1", ray_bits> ray_1;
struct Leaving : List<Hits::failed, Hits::t, answer_number> {};
constexpr Control<"freed_2"> freed_2;
constexpr Data<"freed_ray_2", ray_bits> freed_ray_2;

struct Answer : List<answered, answer_failed, answer_t, answer_number> {};
struct Tag : List<ray_error, ray_tag> {};
inline constexpr auto has_few_counts = [](const ReplyBits& format) { return format.has_few_counts(); };
constexpr DataIf<"ray_once", 1, has_few_counts> once;
constexpr DataIf<"ray_any", 1, has_few_counts> any_or_count;
constexpr BlockOf<"waiting", &ReplyBits::rays, Answer> waiting;               // the queue
constexpr BlockOf<"tags", &ReplyBits::rays, Tag> tags;                        // by ray
constexpr BlockIf<"counting", &ReplyBits::rays, 1, has_few_counts> counting;  // by ray: it wants a count

struct Replies {
  static constexpr const char* name = "replies";
  static constexpr const char* summary = "gives answers out, with the tags of their rays";
  using Bits = ReplyBits;
  using BuiltIn = FormatList<Fixed<ReplyBits{20, 16, 5}>, Fixed<ReplyBits{20, 16, 7}>>;
  struct In : Join<Begun, List<ray_tag, ray_error, once, any_or_count>, Answers, Hits::Back> {};
  struct Out : Join<Hits, Freed> {};
  struct State : Join<Queue::State, List<there_1, ray_1>, Held<Leaving>, List<freed_2, freed_ray_2>> {};
  struct Memory : List<waiting, tags, counting> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& memory, const auto& out) {
    const auto tag = memory[tags].word();
    out[Hits::valid] = now[there_1];
    out[Hits::tag] = tag[ray_tag];
    out[Hits::t] = now[held<Hits::t>];
    const auto kept = now[held<answer_number>];
    out[Hits::number] = either(
        width_of(kept) < Width<triangle_number_bits>(), kept,
        [&](const auto& few) {
          typename D::bit none = ~any<D>(~few);
          if (has_few_counts(f)) none = none & ~typename D::bit(memory[counting].word());
          return cat(spread(none, Width<triangle_number_bits>() - width_of(few)), few);
        },
        [](const auto& all) { return all; });
    out[Hits::failed] = select(typename D::bit(tag[ray_error]), D::lit(no_ray, Width<failure_bits>()),
                               now[held<Hits::failed>]);
    out[Freed::is] = now[freed_2];
    out[Freed::ray] = now[freed_ray_2];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit begins = as("ray_begins", in[ray_valid] & in[ray_ready]);
    memory[tags].write(begins, in[begun_at], in[ray_error], in[ray_tag]);
    memory[waiting].write(in[answers], as("place", Queue::place(now)), in[answered], in[answer_failed],
                          in[answer_t], in[answer_number]);

    const auto oldest = memory[waiting].word();
    const Bit holds = as("holds", now[there_1] & ~in[Hits::ready]);
    const Bit moves = as("moves", now[Queue::there] & ~holds);
    const auto ray = as("leaving_ray", select(holds, now[ray_1], oldest[answered]));
    next[freed_2] = as("leaves", now[there_1] & in[Hits::ready]);
    next[freed_ray_2] = now[ray_1];
    next[ray_1] = ray;
    next[held<Hits::failed>] = select(holds, now[held<Hits::failed>], oldest[answer_failed]);
    next[held<Hits::t>] = select(holds, now[held<Hits::t>], oldest[answer_t]);
    next[held<answer_number>] = select(holds, now[held<answer_number>], oldest[answer_number]);
    next[there_1] = holds | moves;
    memory[tags].ask(ray);
    if (has_few_counts(f)) {
      memory[counting].write(begins, in[begun_at], in[once] & in[any_or_count]);
      memory[counting].ask(ray);
    }
    memory[waiting].ask(Queue::step<D>(now, next, in[answers], moves));
  }
};

}  // namespace replies

using replies::Replies;

}  // namespace hitpipe::hls
