// Answers of rays, on their way out (docs/core.md). Each waits in a queue with a place for every ray, and
// leaves with the tag with which its ray came. Then the ray's number is free. The answer of what was no ray
// has failed.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/memory.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe::hls {

/// The format "tTgGiI", for example t20g16i5.
struct ReplyBits {
  int distance = 20;  ///< T: bits of a distance
  int tag = 16;       ///< G: bits of a tag
  int ray = 5;        ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {{"t", "T", 4, 36}, {"g", "G", 1, 64}, {"i", "I", 1, 8}};

  constexpr int rays() const { return power_of_two(ray); }
  friend constexpr bool operator==(const ReplyBits&, const ReplyBits&) = default;
};

namespace replies {

constexpr Data<"ray_valid"> ray_valid;  // this and `ray_ready` are 1: a ray begins
constexpr Data<"ray_ready"> ray_ready;
constexpr Data<"begun_at", &ReplyBits::ray> begun_at;
constexpr Data<"ray_tag", &ReplyBits::tag> ray_tag;
constexpr Data<"ray_error"> ray_error;  // it is no ray
constexpr Data<"answer"> answer;        // best_hits has the answer of a ray
constexpr Data<"answered", &ReplyBits::ray> answered;
constexpr Data<"answer_t", &ReplyBits::distance> answer_t;
constexpr Data<"answer_number", triangle_number_bits> answer_number;
constexpr Data<"answer_failed"> answer_failed;
constexpr Data<"hit_ready"> hit_ready;  // the answer that is given is taken

constexpr Data<"hit_valid"> hit_valid;
constexpr Data<"hit_tag", &ReplyBits::tag> hit_tag;
constexpr Data<"hit_t", &ReplyBits::distance> hit_t;
constexpr Data<"hit_number", triangle_number_bits> hit_number;  // all ones: no hit
constexpr Data<"hit_failed"> hit_failed;
constexpr Data<"freed"> freed;  // to the door
constexpr Data<"freed_ray", &ReplyBits::ray> freed_ray;

using Queue = IdQueue<>;
constexpr Control<"there_1"> there_1;  // an answer that leaves
constexpr Data<"ray_1", &ReplyBits::ray> ray_1;
constexpr Data<"failed_1"> failed_1;
constexpr Data<"t_1", &ReplyBits::distance> t_1;
constexpr Data<"number_1", triangle_number_bits> number_1;
constexpr Control<"freed_2"> freed_2;
constexpr Data<"freed_ray_2", &ReplyBits::ray> freed_ray_2;

struct Answer : List<answered, answer_failed, answer_t, answer_number> {};
struct Tag : List<ray_error, ray_tag> {};
constexpr BlockOf<"waiting", &ReplyBits::rays, Answer> waiting;  // the queue
constexpr BlockOf<"tags", &ReplyBits::rays, Tag> tags;           // by ray

struct Replies {
  static constexpr const char* name = "replies";
  static constexpr const char* summary = "gives answers out, with the tags of their rays";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = ReplyBits;
  using BuiltIn = FormatList<Fixed<ReplyBits{20, 16, 5}>, Fixed<ReplyBits{20, 16, 7}>>;
  struct In : List<ray_valid, ray_ready, begun_at, ray_tag, ray_error, answer, answered, answer_t,
                   answer_number, answer_failed, hit_ready> {};
  struct Out : List<hit_valid, hit_tag, hit_t, hit_number, hit_failed, freed, freed_ray> {};
  struct State : Join<Queue::State, List<there_1, ray_1, failed_1, t_1, number_1, freed_2, freed_ray_2>> {};
  struct Memory : List<waiting, tags> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    const auto tag = memory[tags].word();
    out[hit_valid] = now[there_1];
    out[hit_tag] = tag[ray_tag];
    out[hit_t] = now[t_1];
    out[hit_number] = now[number_1];
    out[hit_failed] = now[failed_1] | tag[ray_error];
    out[freed] = now[freed_2];
    out[freed_ray] = now[freed_ray_2];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit begins = as("ray_begins", in[ray_valid] & in[ray_ready]);
    memory[tags].write(begins, in[begun_at], in[ray_error], in[ray_tag]);
    memory[waiting].write(in[answer], as("place", Queue::place(now)), in[answered], in[answer_failed],
                          in[answer_t], in[answer_number]);

    const auto oldest = memory[waiting].word();
    const Bit holds = as("holds", now[there_1] & ~in[hit_ready]);
    const Bit moves = as("moves", now[Queue::there] & ~holds);
    const auto ray = as("leaving_ray", select(holds, now[ray_1], oldest[answered]));
    next[freed_2] = as("leaves", now[there_1] & in[hit_ready]);
    next[freed_ray_2] = now[ray_1];
    next[ray_1] = ray;
    next[failed_1] = select(holds, now[failed_1], oldest[answer_failed]);
    next[t_1] = select(holds, now[t_1], oldest[answer_t]);
    next[number_1] = select(holds, now[number_1], oldest[answer_number]);
    next[there_1] = holds | moves;
    memory[tags].ask(ray);
    memory[waiting].ask(Queue::step<D>(now, next, in[answer], moves));
  }
};

}  // namespace replies

using replies::Replies;

}  // namespace hitpipe::hls
