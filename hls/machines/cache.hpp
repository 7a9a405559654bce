// A cache between a core and its memory (docs/core.md). It looks up a block in every cycle and gives one in
// every cycle. Lines come from memory in beats, several lines at a time.
//   hit   the line is there: its block is read from `words_0` to `words_3` and given in the next cycle
//   miss  the line is asked for, in the place of one that was not used lately
//   join  the line has been asked for and is coming: the ray waits for it with others
// Rays that wait for a line are a list, the newest ray first. A ray waits for one block at a time, so each has
// one link, and nothing can overflow. When the line's last beat has come, the rays of its list get their
// blocks, one in a cycle. Meanwhile no beat is taken, so no line is written that is being read.
// A line with an error in a beat does not stay, and the rays that waited for it are told.
#pragma once

#include "hls/machines/cache_fields.hpp"

namespace hitpipe::hls {
namespace cache {

struct Cache {
  static constexpr const char* name = "cache";
  static constexpr const char* summary = "gives blocks again that were read not long ago";
  using Bits = CacheBits;
  using BuiltIn =
      FormatList<Fixed<CacheBits{24, 32, 5, 5, 8, 2, 256, 1}>, Fixed<CacheBits{24, 32, 7, 5, 8, 2, 256, 1}>>;
  struct In : Join<Asks, Request::Back, Beat, List<beat_id, base>, CacheSettings> {};
  struct Out : Join<Asks::Back, Request, Beat::Back, BlockRead, CacheEvents> {};
  struct State : Join<Door::Items, Looked::Items,
                      List<opens, asks_line, line_block, line_id, lines, oldest, beat_count, had_error,
                           filled, fill_place, fill_error, gives_list, list_place, list_error, list_ray,
                           gives, given_id, given_error, will_empty, empties, empty_set, ages_change,
                           aged_set, was_known, was_high, was_low, wanted, left, was_hit, was_join>> {};
  struct Memory
      : List<way_line<0>, way_line<1>, way_line<2>, way_line<3>, way_line<4>, way_line<5>, way_line<6>,
             way_line<7>, way_coming<0>, way_coming<1>, way_coming<2>, way_coming<3>, way_coming<4>,
             way_coming<5>, way_coming<6>, way_coming<7>, way_newest<0>, way_newest<1>, way_newest<2>,
             way_newest<3>, way_newest<4>, way_newest<5>, way_newest<6>, way_newest<7>, ages, links, asked,
             beats, words_0, words_1, words_2, words_3> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& memory, const auto& out) {
    out[granted] = may_enter(now);
    out[request_valid] = now[asks_line];
    out[request_address] = cat(now[line_block], D::lit(0, 5_w));
    out[request_id] = now[line_id];
    typename D::bit ready = takes_beats(now);
    if (writes_twice(f)) ready = ready & now[beat_count];
    out[beat_ready] = ready;
    out[read_valid] = now[gives];
    out[read_id] = now[given_id];
    out[read_error] = now[given_error];
    out[read_word_0] = memory[words_0].word();
    out[read_word_1] = memory[words_1].word();
    out[read_word_2] = memory[words_2].word();
    out[read_word_3] = memory[words_3].word();
    out[cache_hit] = now[was_hit];
    out[cache_join] = now[was_join];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    const auto look = look_up<D>(f, now, in, memory);
    take_request<D>(now, in, look, next);
    ask_for_line<D>(f, now, in, look, next);
    take_beat<D>(f, now, in, memory, look, next);
    give<D>(f, now, memory, look, next);
    change_sets<D>(f, now, memory, look);
    change_ages<D>(f, now, memory, look, next);
    make_empty<D>(now, in, next);
  }

 private:
  /// The door takes a request.
  static constexpr auto may_enter(const auto& now) { return now[opens] & ~now[Door::there]; }
  static constexpr auto takes_beats(const auto& now) { return ~now[gives_list] & ~now[empties]; }
  static constexpr bool writes_twice(const CacheBits& bits) { return bits.data == 512 && bits.blocks == 2; }

  /// What is found for the request that is looked up, and what happens in this cycle.
  template <class D>
  static constexpr auto look_up(const auto& f, const auto& now, const auto& in, const auto& memory) {
    using Bit = typename D::bit;
    const CacheBits bits = f;
    const auto all_ways = number_in<&CacheBits::ways>(f);
    const auto way_bits = number_in<&CacheBits::way>(f);
    const auto block_bits = number_in<&CacheBits::block_bits>(f);
    const auto block = now[Looked::block];
    const auto set = slice(block, block_bits + number_in<&CacheBits::set>(f) - 1_w, block_bits);
    const auto own_tag = slice(block, width_of(block) - 1_w, block_bits + number_in<&CacheBits::set>(f));

    const Ways<D> match(bits, [&](auto way) {
      const auto line = memory[way_line<way>].read(set);
      return Bit(line[valid]) & Bit(line[tag] == own_tag);
    });
    const Ways<D> awaited(bits, [&](auto way) { return Bit(memory[way_coming<way>].read(set)); });
    const Ways<D> match_here(bits, [&](auto way) { return Bit(match.is[way] & ~awaited.is[way]); });
    const Ways<D> match_coming(bits, [&](auto way) { return Bit(match.is[way] & awaited.is[way]); });
    const Bit known = as("known", match.any());
    // The first of the oldest lines that are not on their way makes room.
    const auto age = memory[ages].read(set);
    const auto old = age[age_high] & age[age_low] & ~awaited.word(all_ways);
    const auto leaving_word = as("leaving", old & plus(~old, D::lit(1, 1_w)));
    const Ways<D> leaving(bits, [&](auto way) { return Bit(bit_at(leaving_word, way)); });
    const Ways<D> chosen(bits, [&](auto way) { return Bit(match.is[way] | Bit(~known & leaving.is[way])); });

    // A line that has come is no longer on its way, and the newest of those who wait for it is read. In this
    // cycle a hit may leave, and nothing else.
    const Bit fills = as("fills", now[filled] & ~now[gives_list]);
    const Ways<D> filling(
        bits, [&](auto way) { return Bit(fills & is<D>(slice(now[fill_place], way_bits - 1_w, 0_w), way)); });
    const auto fill_set = slice(now[fill_place], width_of(now[fill_place]) - 1_w, way_bits);
    const auto change_set = as("change_set", select(fills, fill_set, set));

    const Bit holds_line = as("holds_line", now[asks_line] & ~in[request_ready]);
    const Bit may_hit = as("may_hit", now[Looked::there] & ~now[gives_list]);
    const Bit may_join = as("may_join", now[Looked::there] & ~fills);
    const Bit has_room = as("has_room", any<D>(old) & has_few<D>(f, now[lines], in[most_lines]));
    const Bit may_miss = as("may_miss", Bit(may_join & ~holds_line) & has_room);
    const Bit hits = as("hits", match_here.any() & may_hit);
    const Bit joins = as("joins", match_coming.any() & may_join);
    const Bit misses = as("misses", ~known & may_miss);
    const Bit leaves = as("leaves", hits | joins | misses);
    const Bit waits = as("waits", now[Looked::there] & ~leaves);
    const auto place = as("place", cat(set, chosen.number(way_bits)));

    struct Lookup {
      Bit known, hits, joins, misses, leaves, waits, fills, holds_line;
      Ways<D> match, leaving, filling;
      decltype(own_tag) tag;
      decltype(place) found;         // in the cache
      decltype(change_set) changed;  // the set whose lines change
      decltype(age) ages;
      decltype(leaving_word) left;
      decltype(set) own_set;
      decltype(slice(block, 0_w, 0_w)) half;
    };
    return Lookup{known, hits,       joins, misses,       leaves,  waits,
                  fills, holds_line, match, leaving,      filling, own_tag,
                  place, change_set, age,   leaving_word, set,     slice(block, 0_w, 0_w)};
  }
  template <class D>
  static constexpr typename D::bit has_few(const auto& f, const auto& count, const auto& most) {
    const auto bits = max(Width<line_count_bits>(), number_in<ray_count_bits>(f));
    return typename D::bit(resize(count, bits) < resize(most, bits));
  }

  /// The door keeps a request that cannot be looked up yet.
  template <class D>
  static constexpr void take_request(const auto& now, const auto& in, const auto& look, const auto& next) {
    using Bit = typename D::bit;
    const Bit enters = as("enters", in[asks] & may_enter(now));
    const Bit from_door = now[Door::there];
    const Bit some = from_door | enters;
    next[Door::there] = look.waits & some;
    next.where(enters)[Door::block] = in[asked_block];
    next.where(enters)[Door::ray] = in[asker];
    next.where(enters)[Door::triangle] = in[triangle];
    const Bit moves = ~look.waits;
    next[Looked::there] = look.waits | some;
    next.where(moves)[Looked::block] = select(from_door, now[Door::block], in[asked_block]);
    next.where(moves)[Looked::ray] = select(from_door, now[Door::ray], in[asker]);
    next.where(moves)[Looked::triangle] = select(from_door, now[Door::triangle], in[triangle]);
  }

  template <class D>
  static constexpr void ask_for_line(const auto& f, const auto& now, const auto& in, const auto& look,
                                     const auto& next) {
    const CacheBits bits = f;
    const auto block = now[Looked::block];
    const auto first = as("first_block", block & ~D::lit(bits.block_bits(), width_of(block)));
    next[asks_line] = look.misses | look.holds_line;
    next.where(look.misses)[line_block] = plus(cat(in[base], D::lit(0, 1_w)), first);
    next.where(look.misses)[line_id] = cat(now[Looked::triangle], now[Looked::ray]);
  }

  template <class D>
  static constexpr void take_beat(const auto& f, const auto& now, const auto& in, const auto& memory,
                                  const auto& look, const auto& next) {
    using Bit = typename D::bit;
    const CacheBits bits = f;
    const Bit takes_one = as("takes_beat", in[beat_valid] & takes_beats(now));
    // The place of a line in the cache waits in the queue, or with the ray that asked for it.
    auto asked_at = now[Looked::ray];
    auto front = now[Looked::ray];
    if (bits.in_order()) {
      front = now[oldest];
      asked_at = plus(now[oldest], slice(now[lines], width_of(front) - 1_w, 0_w));
    } else {
      front = slice(in[beat_id], width_of(front) - 1_w, 0_w);
    }
    memory[asked].write(look.misses, asked_at, look.found);
    const auto place = as("beat_place", memory[asked].read(front));

    auto count = D::lit(0, came.width(f));
    Bit failed_before = D::lit(0, 1_w);
    if (bits.counts_in_order()) {
      count = now[beat_count];
      failed_before = now[had_error];
    }
    if (bits.counts_by_ray()) {
      const auto before = memory[beats].read(front);
      count = before[came];
      failed_before = before[error_before];
    }
    const Bit ends = as("ends_line", takes_one & is<D>(count, bits.beats() - 1));
    const Bit failed = as("beat_failed", in[beat_error] | failed_before);
    const auto later = plus(count, D::lit(1, 1_w));
    if (bits.counts_in_order()) {
      next.where(takes_one)[beat_count] = later;
      next.where(takes_one)[had_error] = failed & ~ends;
    }
    if (bits.counts_by_ray()) {
      const Bit empty = now[empties];
      const auto cleared = slice(now[empty_set], width_of(front) - 1_w, 0_w);
      memory[beats].write(Bit(takes_one | empty), select(empty, cleared, front), only(Bit(~empty), later),
                          Bit(failed & ~ends & ~empty));
    }
    write_words<D>(f, in, memory, takes_one, place, count);
    next[filled] = ends | (now[filled] & now[gives_list]);
    next.where(ends)[fill_place] = place;
    next.where(ends)[fill_error] = failed;

    const auto rest = minus(now[lines], ends);
    next[lines] = select(look.misses, plus(rest, D::lit(1, 1_w)), rest);  // `misses` comes late
    if (bits.in_order()) next[oldest] = plus(now[oldest], ends);
  }

  /// A beat has some of a block's words, or all; one of 512 bits has two blocks.
  template <class D>
  static constexpr void write_words(const auto& f, const auto& in, const auto& memory,
                                    const typename D::bit& writes, const auto& place, const auto& count) {
    using Bit = typename D::bit;
    const CacheBits bits = f;
    const auto counted = resize(count, 3_w);
    const Bit digits[] = {Bit(bit_at(counted, 0_w)), Bit(bit_at(counted, 1_w)), Bit(bit_at(counted, 2_w))};
    // The number of a beat is that of the block in the line, and below it that of the words in the block.
    const int below = bits.count() - bits.block_bits();
    const Bit upper = digits[below];
    const auto both = cat(place, upper);
    const auto word_place =
        as("word_place", slice(both, width_of(both) - 1_w, 1_w - number_in<&CacheBits::block_bits>(f)));
    using Part = std::remove_cvref_t<decltype(in[beat_0])>;
    const Part came_words[] = {in[beat_0], in[beat_1], in[beat_2], in[beat_3],
                               in[beat_4], in[beat_5], in[beat_6], in[beat_7]};
    const Bit upper_half = bits.blocks == 2 ? upper : Bit(bit_at(place, number_in<&CacheBits::way>(f)));
    const auto write = [&](auto words, int k) {
      Bit is_in = writes;
      for (int digit = 0; digit < below; ++digit)
        is_in = is_in & Bit((k >> (2 - below + digit) & 1) != 0 ? digits[digit] : Bit(~digits[digit]));
      const int lanes = bits.data / 64;
      memory[words].write(
          is_in, word_place,
          lanes == 8 ? select(upper_half, came_words[k + 4], came_words[k]) : came_words[k % lanes]);
    };
    write(words_0, 0);
    write(words_1, 1);
    write(words_2, 2);
    write(words_3, 3);
  }

  /// A block is read, and given in the next cycle: to a ray of the list, or to one that hits.
  template <class D>
  static constexpr void give(const auto& f, const auto& now, const auto& memory, const auto& look,
                             const auto& next) {
    using Bit = typename D::bit;
    const CacheBits bits = f;
    // Of a line that has come, or of that which a ray joins.
    const auto newest_of = [&](const Ways<D>& ways) {
      const auto nobody = D::lit(0, list_ray.width(f));
      std::remove_const_t<decltype(nobody)> found[most_ways];
      for (auto& each : found) each = nobody;
      for_each_way(bits, [&](auto way) {
        found[way] = only(ways.is[way], memory[way_newest<way>].read(look.changed));
      });
      return or_of(found);
    };
    const auto link = memory[links].read(now[list_ray]);
    memory[links].write(Bit(look.joins | look.misses), now[Looked::ray], newest_of(look.match),
                        Bit(~look.known), look.half, now[Looked::triangle]);
    next[gives_list] = look.fills | (now[gives_list] & ~link[is_last]);
    next.where(look.fills)[list_place] = now[fill_place];
    next.where(look.fills)[list_error] = now[fill_error];
    const Bit list_moves = look.fills | now[gives_list];
    next.where(list_moves)[list_ray] = select(look.fills, newest_of(look.filling), link[next_ray]);

    const auto place = as(
        "read_place", select(now[gives_list], cat(now[list_place], link[half]), cat(look.found, look.half)));
    const auto word_place = slice(place, width_of(place) - 1_w, 1_w - number_in<&CacheBits::block_bits>(f));
    memory[words_0].ask(word_place);
    memory[words_1].ask(word_place);
    memory[words_2].ask(word_place);
    memory[words_3].ask(word_place);
    const Bit gives_one = now[gives_list] | look.hits;
    next[gives] = gives_one;
    next.where(gives_one)[given_id] = select(now[gives_list], cat(link[of_triangle], now[list_ray]),
                                             cat(now[Looked::triangle], now[Looked::ray]));
    next[given_error] = now[gives_list] & now[list_error];
    next[was_hit] = look.hits;
    next[was_join] = look.joins;
  }

  /// What the sets hold.
  template <class D>
  static constexpr void change_sets(const auto& f, const auto& now, const auto& memory, const auto& look) {
    using Bit = typename D::bit;
    const Bit empty = now[empties];
    const auto empty_at = slice(now[empty_set], width_of(look.own_set) - 1_w, 0_w);
    const auto line_set = as("line_set", select(empty, empty_at, look.changed));
    for_each_way(f, [&](auto way) {
      const Bit enters_line = look.misses & look.leaving.is[way];
      const Bit fails = look.filling.is[way] & now[fill_error];
      memory[way_line<way>].write(Bit(enters_line | Bit(empty | fails)), line_set, look.misses, look.tag);
      memory[way_coming<way>].write(Bit(enters_line | Bit(empty | look.filling.is[way])), line_set,
                                    look.misses);
      memory[way_newest<way>].write(Bit(enters_line | Bit(look.joins & look.match.is[way])), look.changed,
                                    now[Looked::ray]);
    });
  }

  /// The age of a line that a ray wants again is 0, that of a new one 2. Then all get older alike, until the oldest
  /// have 3.
  template <class D>
  static constexpr void change_ages(const auto& f, const auto& now, const auto& memory, const auto& look,
                                    const auto& next) {
    using Bit = typename D::bit;
    const auto all_ways = number_in<&CacheBits::ways>(f);
    next[ages_change] = look.leaves;
    const auto kept = next.where(look.leaves);
    kept[aged_set] = look.own_set;
    kept[was_known] = look.known;
    kept[was_high] = look.ages[age_high];
    kept[was_low] = look.ages[age_low];
    kept[wanted] = look.match.word(all_ways);
    kept[left] = look.left;

    const Bit known = now[was_known];
    const auto high = now[was_high] & ~now[wanted];
    const auto others_low = now[was_low] & ~now[wanted];
    const Bit some_one = any<D>(others_low), some_two = any<D>(high), some_three = any<D>(high & others_low);
    const Bit other_old = any<D>(now[was_high] & now[was_low] & ~now[left]);
    const Bit by_two = as("older_by_two", known & ~some_two);
    const Bit by_one =
        as("older_by_one", select(known, Bit(~some_three & (some_two | ~some_one)), Bit(~other_old)));
    const auto low = now[was_low] & ~select(known, now[wanted], now[left]);
    const auto ones = spread(by_one, all_ways);
    const Bit empty = now[empties];
    const auto empty_at = slice(now[empty_set], width_of(now[aged_set]) - 1_w, 0_w);
    memory[ages].write(Bit(now[ages_change] | empty), select(empty, empty_at, now[aged_set]),
                       (high ^ spread(by_two, all_ways) ^ (low & ones)) | spread(empty, all_ways),
                       (low ^ ones) | spread(empty, all_ways));
  }

  /// The cache is emptied set by set, when nothing is on its way.
  template <class D>
  static constexpr void make_empty(const auto& now, const auto& in, const auto& next) {
    using Bit = typename D::bit;
    const Bit empty = now[empties];
    const Bit asked_to = as("asked_to_empty", now[will_empty] | in[empties_cache]);
    const Bit is_still = ~now[opens] & ~now[Door::there] & ~now[Looked::there] & ~now[filled] &
                         ~now[gives_list] & ~any<D>(now[lines]);
    const Bit begins = as("begins_to_empty", now[will_empty] & is_still);
    next[will_empty] = asked_to & ~begins;
    next[empties] = begins | (empty & any<D>(~now[empty_set]));
    next[empty_set] = plus(now[empty_set], empty);
    next[opens] = in[lets_asks] & ~asked_to & ~begins & ~empty;
  }
};

}  // namespace cache

using cache::Cache;

}  // namespace hitpipe::hls
