// Rays from memory, and their answers to memory (docs/core.md): two rings, with as many places each. The host writes
// rays behind those that are there, and says how many it has offered in all. The machine reads them, four at a time if
// there are so many, and gives them to the core. It writes the answers in the order in which they come, four at a
// time, or fewer when no other answer has come for some time. It says how many are in memory.
// Counts go round at 2^16. A ring has 2^k places; the host offers no more rays than have room, so answers have room
// too. If it offers more, or takes some back, no further ray is read. If an answer could not be written, none is
// written after it, and no ray is read: the answers that are said to be in memory end before it. A reset ends both.
//   a ray      32 bytes: ox, oy, oz, dx, dy, dz, length as binary32, then 3 bytes of the tag, and a byte with 1 for any
//              hit, else 0
//   an answer  16 bytes: the triangle's number in 4, 3 bytes of the tag, a byte that says why it has failed, and T in 8
// A ray that could not be read has a NaN as its length, so it is none and fails. Its answer has the tag that was read.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "hHgGtTdD", for example h32g16t20d128.
struct RingBits {
  static constexpr int most_tag = 24;

  int bytes = 32;     ///< H: bits of an address, of bytes
  int tag = 16;       ///< G: bits of a tag
  int distance = 20;  ///< T: bits of a distance
  int data = 128;     ///< D: bits of a beat: 64, 128

  static constexpr FormatField fields[] = {
      {"h", "H", 9, 64}, {"g", "G", 1, most_tag}, {"t", "T", 4, 36}, {"d", "D", 64, 128}};
  static constexpr const char* condition = "D 64 or 128";

  constexpr bool valid() const { return data == 64 || data == 128; }
  constexpr bool halves() const { return data == 64; }
  constexpr bool pairs() const { return data == 128; }
  /// Of the number of a beat in its ray.
  constexpr int beat() const { return halves() ? 2 : 1; }
  friend constexpr bool operator==(const RingBits&, const RingBits&) = default;
};

namespace rings {

using namespace channels;

constexpr int place_bits = 4;  ///< of a place in the machine's own queues
constexpr int places = 1 << place_bits;
constexpr int patience_bits = 6;  ///< an answer waits 2^6 cycles for others

// To the unit int_ray, and whether it takes the ray.
constexpr Data<"ray_ox", 32> ray_ox;
constexpr Data<"ray_oy", 32> ray_oy;
constexpr Data<"ray_oz", 32> ray_oz;
constexpr Data<"ray_dx", 32> ray_dx;
constexpr Data<"ray_dy", 32> ray_dy;
constexpr Data<"ray_dz", 32> ray_dz;
constexpr Data<"ray_len", 32> ray_len;
constexpr Data<"ray_taken"> ray_taken;
// Rays are asked for, and come in beats, in order.
constexpr Data<"fetch_valid"> fetch_valid;
constexpr Data<"fetch_ready"> fetch_ready;
constexpr Data<"fetch_address", byte_bits> fetch_address;
constexpr Data<"fetch_four"> fetch_four;  // four rays; else one
constexpr Data<"fetched_valid"> fetched_valid;
constexpr Data<"fetched_error"> fetched_error;
constexpr Data<"fetched_0", 64> fetched_0;
constexpr DataIf<"fetched_1", 64, &RingBits::pairs> fetched_1;
// Answers are written: where, their beats, and that they are in memory.
constexpr Data<"store_valid"> store_valid;
constexpr Data<"store_ready"> store_ready;
constexpr Data<"store_address", byte_bits> store_address;
constexpr Data<"store_four"> store_four;
constexpr Data<"put_valid"> put_valid;
constexpr Data<"put_ready"> put_ready;
constexpr Data<"put_last"> put_last;
constexpr Data<"put_0", 64> put_0;
constexpr DataIf<"put_1", 64, &RingBits::pairs> put_1;
constexpr Data<"stored_valid"> stored_valid;
constexpr Data<"stored_error"> stored_error;
struct Fetch : List<fetch_valid, fetch_address, fetch_four> {
  using Back = List<fetch_ready, fetched_valid, fetched_error, fetched_0, fetched_1>;
};
struct Store : List<store_valid, store_address, store_four, put_valid, put_last, put_0, put_1> {
  using Back = List<store_ready, put_ready, stored_valid, stored_error>;
};

// Rays that were asked for in all, and those of them that the core has not taken. The first of these have come.
constexpr Control<"asked_for", ring_count_bits> asked_for;
constexpr Control<"held", place_bits + 1> held_rays;
constexpr Control<"come", place_bits + 1> come;
constexpr Control<"first_ray", place_bits> first_ray;
constexpr Control<"is_offered"> is_offered;  // there are more
constexpr Control<"fetches"> fetches;
constexpr Data<"fetch_place", byte_bits> fetch_place;
constexpr Data<"fetches_four"> fetches_four;
constexpr Control<"beat", &RingBits::beat> beat;  // of the ray that is coming
constexpr Control<"spoils"> spoils;               // one of its beats had an error
constexpr Control<"begun"> begun_1;
// Answers that were put in all, those that wait, and those that are in memory.
constexpr Control<"sent", ring_count_bits> sent;
constexpr Control<"waiting", place_bits + 1> waiting;
constexpr Control<"in_memory", ring_count_bits> in_memory;
constexpr Control<"patience", patience_bits> patience;
constexpr Control<"stores"> stores;    // the address is offered
constexpr Control<"storing"> storing;  // memory has not said that it has them
constexpr Data<"store_place", byte_bits> store_place;
constexpr Data<"stores_four"> stores_four;
constexpr Control<"left", 3> left;  // answers to be put
constexpr ControlIf<"second", 1, &RingBits::halves> second;
constexpr Control<"failed_1"> failed_1;
constexpr Control<"unwritten"> unwritten;  // an answer could not be written
// What the host has offered one cycle ago, how many of these have no answer in memory, and how many of them are new.
constexpr Control<"announced", ring_count_bits> announced;
constexpr Control<"unanswered", ring_count_bits> unanswered;
constexpr Control<"fresh", ring_count_bits> fresh;
constexpr Control<"accepted", ring_count_bits> accepted;
constexpr Control<"overfull"> overfull;  // more rays were offered than there are places

struct Answer : List<Hits::failed, Hits::tag, Hits::t, Hits::number> {};
constexpr Lookup<"rays_0", places, 64> rays_0;
constexpr Lookup<"rays_1", places, 64> rays_1;
constexpr Lookup<"rays_2", places, 64> rays_2;
constexpr Lookup<"rays_3", places, 64> rays_3;
constexpr Lookup<"spoilt", places, 1> spoilt;
constexpr LookupOf<"answers", places, Answer> answers_kept;

struct Rings {
  static constexpr const char* name = "rings";
  static constexpr const char* summary = "reads rays from a ring in memory, and writes answers to another";
  using Bits = RingBits;
  using BuiltIn = FormatList<Fixed<RingBits{32, 16, 20, 128}>, Fixed<RingBits{32, 16, 20, 64}>>;
  struct In : Join<RingSettings, List<ray_taken>, Hits, Fetch::Back, Store::Back> {};
  struct Out
      : Join<List<ray_valid, ray_tag, ray_any, ray_ox, ray_oy, ray_oz, ray_dx, ray_dy, ray_dz, ray_len>,
             Hits::Back, Fetch, Store, RingState> {};
  struct State
      : List<asked_for, held_rays, come, first_ray, is_offered, fetches, fetch_place, fetches_four, beat,
             spoils, begun_1, sent, waiting, in_memory, patience, stores, storing, store_place, stores_four,
             left, second, failed_1, unwritten, announced, unanswered, fresh, accepted, overfull> {};
  struct Memory : List<rays_0, rays_1, rays_2, rays_3, spoilt, answers_kept> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& memory, const auto& out) {
    using Bit = typename D::bit;
    const auto low = [](const auto& word) { return slice(word, 31_w, 0_w); };
    const auto high = [](const auto& word) { return slice(word, 63_w, 32_w); };
    const auto ray = [&](auto words) { return memory[words].read(now[first_ray]); };
    out[ray_valid] = any<D>(now[come]);
    out[ray_ox] = low(ray(rays_0));
    out[ray_oy] = high(ray(rays_0));
    out[ray_oz] = low(ray(rays_1));
    out[ray_dx] = high(ray(rays_1));
    out[ray_dy] = low(ray(rays_2));
    out[ray_dz] = high(ray(rays_2));
    out[ray_len] = as_unsigned(low(ray(rays_3)) | spread(Bit(ray(spoilt)), 32_w));
    out[ray_tag] = slice(ray(rays_3), 31_w + number_in<&RingBits::tag>(f), 32_w);
    out[ray_any] = bit_at(ray(rays_3), 56_w);
    out[ray_begins] = now[begun_1];

    out[Hits::ready] = has_room(now);
    out[fetch_valid] = now[fetches];
    out[fetch_address] = now[fetch_place];
    out[fetch_four] = now[fetches_four];
    out[store_valid] = now[stores];
    out[store_address] = now[store_place];
    out[store_four] = now[stores_four];
    const RingBits bits = f;
    const auto answer = memory[answers_kept].read(slice(now[sent], Width<place_bits - 1>(), 0_w));
    const auto words_0 =
        resize(cat(answer[Hits::failed], resize(answer[Hits::tag], 24_w), answer[Hits::number]), 64_w);
    const auto words_1 = resize(answer[Hits::t], 64_w);
    Bit is_last = is<D>(now[left], 1);
    if (bits.halves()) {
      is_last = is_last & now[second];
      out[put_0] = select(Bit(now[second]), words_1, words_0);
    } else {
      out[put_0] = words_0;
      out[put_1] = words_1;
    }
    out[put_valid] = any<D>(now[left]);
    out[put_last] = is_last;
    out[ring_answers] = now[in_memory];
    out[ring_busy] =
        now[is_offered] | any<D>(now[held_rays]) | now[begun_1] | any<D>(now[waiting]) | now[storing];
    out[ring_quiet] = Bit(now[held_rays] == now[come]) & ~now[storing];
    out[ring_flaws] = cat(now[overfull], now[unwritten], now[failed_1]);
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit comes = take_beat<D>(f, now, in, memory, next);
    const Bit leaves = as("ray_leaves", any<D>(now[come]) & in[ray_taken]);
    next[come] = minus(plus(now[come], comes), leaves);
    next[first_ray] = plus(now[first_ray], leaves);
    next[begun_1] = leaves;
    ask<D>(now, in, leaves, next);
    const Bit puts = put<D>(f, now, in, memory, next);
    store<D>(now, in, puts, next);
    next[failed_1] = in[fetched_valid] & in[fetched_error];
    next[unwritten] = now[unwritten] | (in[stored_valid] & in[stored_error]);
  }

 private:
  static constexpr auto has_room(const auto& now) { return ~bit_at(now[waiting], Width<place_bits>()); }
  /// Asks for four rays if a group of four is there and has room, else for one.
  template <class D>
  static constexpr void ask(const auto& now, const auto& in, const typename D::bit& leaves,
                            const auto& next) {
    using Bit = typename D::bit;
    const Bit stands = accept<D>(now, in, next);
    const auto offered = as("offered", minus(now[accepted], now[asked_for]));
    next[is_offered] = ~Bit(in[rays_offered] == now[asked_for]);
    const auto bit = [&](auto i) { return bit_at(now[held_rays], i); };
    const Bit room_for_one = ~bit(4_w);
    const Bit room_for_four = ~(bit(4_w) | (bit(3_w) & bit(2_w) & (bit(1_w) | bit(0_w))));
    const Bit four = as("four_rays", any<D>(slice(offered, Width<ring_count_bits - 1>(), 2_w)) &
                                         room_for_four & ~any<D>(slice(now[asked_for], 1_w, 0_w)));
    const Bit begins =
        as("fetch_begins", any<D>(offered) & room_for_one & in[lets_fetches] & ~stands & ~now[fetches]);
    const auto count = only(begins, cat(four, D::lit(0, 1_w), Bit(~four)));
    next[asked_for] = plus(now[asked_for], count);
    next[held_rays] = minus(plus(now[held_rays], count), leaves);
    next[fetches] = begins | (now[fetches] & ~in[fetch_ready]);
    next.where(begins)[fetch_place] = place_of_ray<D>(now, in);
    next.where(begins)[fetches_four] = four;
  }
  /// Looks at what is offered, in the cycle after. The host has taken answers that are in memory, no others, so more
  /// rays than places without one have no room. Says whether no more are read.
  template <class D>
  static constexpr typename D::bit accept(const auto& now, const auto& in, const auto& next) {
    using Bit = typename D::bit;
    next[announced] = in[rays_offered];
    next[unanswered] = minus(in[rays_offered], now[in_memory]);
    next[fresh] = minus(in[rays_offered], now[announced]);
    const auto last = in[ring_last];
    const auto doubled = cat(slice(last, Width<ring_count_bits - 2>(), 0_w), D::lit(1, 1_w));
    const auto place_bit = as("place_bit", doubled & ~last);
    const auto has_no_room = [&](const auto& count) {
      const Bit exactly = any<D>(count & place_bit);
      return Bit(any<D>(count & ~doubled) | (exactly & any<D>(count & last)));
    };
    const Bit no_room = has_no_room(now[fresh]) | has_no_room(now[unanswered]) | ~any<D>(now[unanswered]);
    const Bit full = as("full", now[overfull] | (any<D>(now[fresh]) & no_room));
    next[overfull] = full;
    next.where(Bit(~full))[accepted] = now[announced];
    return full | now[unwritten];
  }
  template <class D>
  static constexpr auto place_of_ray(const auto& now, const auto& in) {
    return plus(cat(in[rays_at], D::lit(0, 7_w)),
                cat(as_unsigned(now[asked_for] & in[ring_last]), D::lit(0, 5_w)));
  }
  template <class D>
  static constexpr auto place_of_answer(const auto& now, const auto& in) {
    return plus(cat(in[answers_at], D::lit(0, 7_w)),
                cat(as_unsigned(now[sent] & in[ring_last]), D::lit(0, 4_w)));
  }

  /// A beat of a ray. Says whether the ray has come with it.
  template <class D>
  static constexpr typename D::bit take_beat(const auto& f, const auto& now, const auto& in,
                                             const auto& memory, const auto& next) {
    using Bit = typename D::bit;
    const RingBits bits = f;
    const auto at = plus(now[first_ray], slice(now[come], Width<place_bits - 1>(), 0_w));
    const auto write = [&](auto words, int number, const auto& word) {
      memory[words].write(Bit(in[fetched_valid] & is<D>(now[beat], number)), at, word);
    };
    if (bits.halves()) {
      write(rays_0, 0, in[fetched_0]);
      write(rays_1, 1, in[fetched_0]);
      write(rays_2, 2, in[fetched_0]);
      write(rays_3, 3, in[fetched_0]);
    } else {
      write(rays_0, 0, in[fetched_0]);
      write(rays_1, 0, in[fetched_1]);
      write(rays_2, 1, in[fetched_0]);
      write(rays_3, 1, in[fetched_1]);
    }
    const Bit last = as("last_beat", in[fetched_valid] & is<D>(now[beat], bits.halves() ? 3 : 1));
    const Bit spoilt_now = as("spoilt_now", now[spoils] | (in[fetched_valid] & in[fetched_error]));
    memory[spoilt].write(last, at, spoilt_now);
    next[beat] = plus(now[beat], in[fetched_valid]);
    next[spoils] = spoilt_now & ~last;
    return last;
  }

  /// Takes an answer, and puts the oldest one on the bus. Says whether its last beat is taken.
  template <class D>
  static constexpr typename D::bit put(const auto& f, const auto& now, const auto& in, const auto& memory,
                                       const auto& next) {
    using Bit = typename D::bit;
    const RingBits bits = f;
    const Bit enters = as("answer_enters", in[Hits::valid] & has_room(now));
    const auto at = plus(slice(now[sent], Width<place_bits - 1>(), 0_w),
                         slice(now[waiting], Width<place_bits - 1>(), 0_w));
    memory[answers_kept].write(enters, at, in[Hits::failed], in[Hits::tag], in[Hits::t], in[Hits::number]);
    const Bit beat_taken = as("beat_taken", any<D>(now[left]) & in[put_ready]);
    Bit puts = beat_taken;
    if (bits.halves()) {
      puts = beat_taken & now[second];
      next[second] = now[second] ^ beat_taken;
    }
    next[sent] = plus(now[sent], puts);
    next[waiting] = minus(plus(now[waiting], enters), puts);
    return as("answer_put", puts);
  }

  /// Begins to write when there are four answers, or fewer have waited for long.
  template <class D>
  static constexpr void store(const auto& now, const auto& in, const typename D::bit& puts,
                              const auto& next) {
    using Bit = typename D::bit;
    const Bit aligned = ~any<D>(slice(now[sent], 1_w, 0_w));
    const Bit four = as("four_answers", aligned & any<D>(slice(now[waiting], Width<place_bits>(), 2_w)));
    const Bit some = any<D>(now[waiting]);
    const Bit waited = ~any<D>(~now[patience]);
    const Bit begins = as("store_begins", in[lets_rings] & ~now[unwritten] & ~now[storing] &
                                              (four | (some & (~aligned | waited))));
    const Bit rests = begins | ~some;
    next[patience] = only(Bit(~rests), plus(now[patience], Bit(~waited)));
    next[stores] = begins | (now[stores] & ~in[store_ready]);
    next[storing] = begins | (now[storing] & ~in[stored_valid]);
    next.where(begins)[store_place] = place_of_answer<D>(now, in);
    next.where(begins)[stores_four] = four;
    next[left] = select(begins, cat(four, D::lit(0, 1_w), Bit(~four)), minus(now[left], puts));
    next.where(Bit(in[stored_valid] & ~in[stored_error] & ~now[unwritten]))[in_memory] =
        plus(now[sent], puts);
  }
};

}  // namespace rings

using rings::Rings;

}  // namespace hitpipe::hls
