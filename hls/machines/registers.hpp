// What the host says to a core and reads of it (docs/core.md): registers behind AXI4-Lite. What each word
// says is in register_table.hpp. An address is that of a word, and its two low bits are ignored.
//
// A soft reset takes no new ray, request or answer any more, but what is offered stays until it is taken.
// When all blocks that were asked for have come, the core is reset. Rays that were in flight get no answer. A
// core with a cache does not ask it for blocks any more, and one with rings ends what it reads and writes
// there. A write to the address of the image or to its last block empties the cache.
#pragma once

#include "hls/machines/register_fields.hpp"

namespace hitpipe::hls {
namespace registers {

struct Registers {
  static constexpr const char* name = "registers";
  static constexpr const char* summary = "what the host says to a core and reads of it";
  using Bits = RegisterBits;
  using BuiltIn = FormatList<Fixed<RegisterBits{24, 32, 5, 40}>>;
  struct In
      : List<awvalid, awaddr, wvalid, wdata, wstrb, bready, arvalid, araddr, rready, ray_valid, ray_ready,
             Hits::valid, Hits::ready, Hits::number, Hits::failed, request_valid, request_ready, request_id,
             read_valid, read_error, about_format, about_shape, about_ports, about_limits, hit_happens,
             join_happens, line_asked, answers_there, rings_busy, rings_quiet, rings_flaws> {};
  struct Out : Join<List<awready, wready, bvalid, bresp, arready, rvalid, rdata, rresp>, Settings,
                    List<lets_rays, lets_requests, lets_answers, resets, most_lines_given, empties_given,
                         rays_place, answers_place, last_place, offered, interrupt, lets_rings_given>> {};
  struct State : List<has_place, has_word, write_place, written_word, strobes, written, has_read, gives,
                      read_place, given, base_r, last_r, most_steps_r, most_rays_r, sticky_r, flying, reading,
                      stops, offers_requests, offers_answers, resets_r, count_cycles, count_rays,
                      count_answers, count_hits, count_records, count_triangles, count_idle, count_refused,
                      most_lines_r, empties_r, count_cache_hits, count_joins, count_lines, rays_at_r,
                      answers_at_r, ring_last_r, offered_r, interrupt_r, ring_flaws_r, interrupts_r> {};
  struct Memory : List<> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& /*memory*/, const auto& out) {
    if (has_cache(f)) {
      out[most_lines_given] = now[most_lines_r];
      out[empties_given] = now[empties_r];
    }
    if (has_rings(f)) {
      out[rays_place] = now[rays_at_r];
      out[answers_place] = now[answers_at_r];
      out[last_place] = now[ring_last_r];
      out[offered] = now[offered_r];
      out[interrupt] = now[interrupts_r];
      out[lets_rings_given] = ~now[stops];
    }
    const auto okay = D::lit(0, 2_w);
    out[awready] = ~now[has_place];
    out[wready] = ~now[has_word];
    out[bvalid] = now[written];
    out[bresp] = okay;
    out[arready] = ~now[has_read];
    out[rvalid] = now[gives];
    out[rdata] = now[given];
    out[rresp] = okay;
    out[base] = now[base_r];
    out[last] = now[last_r];
    out[most_steps] = now[most_steps_r];
    out[most_rays] = now[most_rays_r];
    out[lets_rays] = ~now[stops] & any<D>(now[most_rays_r]);
    out[lets_requests] = now[offers_requests];
    out[lets_answers] = now[offers_answers];
    out[resets] = now[resets_r];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& /*memory*/,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto place_of = [](const auto& address) { return slice(address, 7_w, 2_w); };

    const Bit reads = as("reads", now[has_read] & (~now[gives] | in[rready]));
    next.where(reads)[given] = as("read_word", word_read<D>(f, now, in));
    next[gives] = reads | (now[gives] & ~in[rready]);
    next[read_place] = select(now[has_read], now[read_place], place_of(in[araddr]));
    next[has_read] = (now[has_read] & ~reads) | (~now[has_read] & in[arvalid]);

    const Bit writes = as("writes", now[has_place] & now[has_word] & ~now[written]);
    const Bit clears = as("clears", writes & is<D>(now[write_place], at<"CLEAR_COUNTERS">));
    count<D>(f, now, in, clears, next);
    const auto mask = as("mask", mask_of<D>(now, writes));
    write<D>(now, mask, next);
    follow<D>(f, now, in, mask, next);
    if (has_rings(f)) of_rings<D>(now, in, mask, next);
    if (has_cache(f)) of_cache<D>(now, mask, writes, next);
    next[written] = writes | (now[written] & ~in[bready]);
    next[write_place] = select(now[has_place], now[write_place], place_of(in[awaddr]));
    next[written_word] = select(now[has_word], now[written_word], in[wdata]);
    next[strobes] = select(now[has_word], now[strobes], in[wstrb]);
    next[has_place] = (now[has_place] & ~writes) | (~now[has_place] & in[awvalid]);
    next[has_word] = (now[has_word] & ~writes) | (~now[has_word] & in[wvalid]);
  }

 private:
  static constexpr bool has_cache(const RegisterBits& bits) { return bits.cache != 0; }
  static constexpr bool has_rings(const RegisterBits& bits) { return bits.rings != 0; }
  /// x in 64 bits: two words.
  static constexpr auto two_words(const auto& x) { return as_unsigned(resize(x, 64_w)); }

  /// The bits that a write changes; none without one.
  template <class D>
  static constexpr auto mask_of(const auto& now, const typename D::bit& writes) {
    using Bit = typename D::bit;
    const auto byte = [&](const auto& i) { return spread(Bit(Bit(bit_at(now[strobes], i)) & writes), 8_w); };
    return cat(byte(3_w), byte(2_w), byte(1_w), byte(0_w));
  }
  template <class D>
  static constexpr auto mask_at(const auto& now, const auto& mask, int place) {
    return only(is<D>(now[write_place], place), mask);
  }

  /// The word at `read_place`.
  template <class D>
  static constexpr auto word_read(const auto& f, const auto& now, const auto& in) {
    const auto if_at = [&](int place, const auto& word) { return only(is<D>(now[read_place], place), word); };
    const auto low = [&](const auto& x) { return slice(two_words(x), 31_w, 0_w); };
    const auto high = [&](const auto& x) { return slice(two_words(x), 63_w, 32_w); };
    const auto address = cat(now[base_r], D::lit(0, image_zeros));
    const auto status = cat(
        now[sticky_r], cat(D::lit(0, Width<first_sticky - 2>()), cat(now[stops], is_idle<D>(f, now, in))));
    const auto about = if_at(at<"STATUS">, low(status)) | if_at(at<"FORMAT">, in[about_format]) |
                       if_at(at<"SHAPE">, in[about_shape]) | if_at(at<"PORTS">, in[about_ports]) |
                       if_at(at<"LIMITS">, in[about_limits]);
    const auto settings = if_at(at<"IDENTITY">, D::lit(identity, 32_w)) |
                          if_at(at<"VERSION">, D::lit(version, 32_w)) | if_at(at<"BASE_LOW">, low(address)) |
                          if_at(at<"BASE_HIGH">, high(address)) | if_at(at<"LAST_BLOCK">, low(now[last_r])) |
                          if_at(at<"MOST_STEPS">, low(now[most_steps_r])) |
                          if_at(at<"MOST_RAYS">, low(now[most_rays_r]));
    const typename D::bit second = bit_at(now[read_place], 0_w);
    const auto counter = [&](int low_at, auto field) {
      const auto pair = slice(now[read_place], Width<word_place_bits - 1>(), 1_w);
      return only(is<D>(pair, low_at / 2), select(second, high(now[field]), low(now[field])));
    };
    const auto always = about | settings | counter(at<"CYCLES">, count_cycles) |
                        counter(at<"RAYS">, count_rays) | counter(at<"ANSWERS">, count_answers) |
                        counter(at<"HITS">, count_hits) | counter(at<"RECORDS">, count_records) |
                        counter(at<"TRIANGLES">, count_triangles) | counter(at<"IDLE">, count_idle) |
                        counter(at<"REFUSED">, count_refused);
    auto word = always;
    if (has_cache(f))
      word = always | if_at(at<"MOST_LINES">, low(now[most_lines_r])) |
             counter(at<"CACHE_HITS">, count_cache_hits) | counter(at<"CACHE_JOINS">, count_joins) |
             counter(at<"CACHE_LINES">, count_lines);
    if (has_rings(f)) {
      const auto ring = [&](int low_at, auto field) {
        const auto place = cat(now[field], D::lit(0, ring_zeros));
        return if_at(low_at, low(place)) | if_at(low_at + 1, high(place));
      };
      const auto flaws = cat(now[ring_flaws_r], D::lit(0, bit<"STATUS", "ring_error">));
      word = word | ring(at<"RAYS_LOW">, rays_at_r) | ring(at<"ANSWERS_LOW">, answers_at_r) |
             if_at(at<"RING_LAST">, low(now[ring_last_r])) | if_at(at<"OFFERED">, low(now[offered_r])) |
             if_at(at<"INTERRUPT">, low(now[interrupt_r])) | if_at(at<"ANSWERED">, low(in[answers_there])) |
             if_at(at<"STATUS">, low(flaws));
    }
    return word;
  }

  template <class D>
  static constexpr void write(const auto& now, const auto& mask, const auto& next) {
    next[base_r] = changed_address<D, "BASE_LOW">(now, mask, base_r, image_zeros);
    next[last_r] = changed_number<D, "LAST_BLOCK">(now, mask, last_r);
    next[most_steps_r] = changed_number<D, "MOST_STEPS">(now, mask, most_steps_r);
    next[most_rays_r] = changed_number<D, "MOST_RAYS">(now, mask, most_rays_r);
  }

  /// What a write makes of an address, without its low zeros.
  template <class D, Name Low>
  static constexpr auto changed_address(const auto& now, const auto& mask, auto field, const auto& zeros) {
    static_assert(called(Low.text).fit == Fit::cut);
    const int low_at = at<Low>;
    const auto words = cat(now[written_word], now[written_word]);
    const auto old = two_words(cat(now[field], D::lit(0, zeros)));
    const auto by = cat(mask_at<D>(now, mask, low_at + 1), mask_at<D>(now, mask, low_at));
    return slice((old & ~by) | (words & by), width_of(now[field]) + zeros - 1_w, zeros);
  }

  /// Where the rings are, and what they say.
  template <class D>
  static constexpr void of_rings(const auto& now, const auto& in, const auto& mask, const auto& next) {
    using Bit = typename D::bit;
    next[rays_at_r] = changed_address<D, "RAYS_LOW">(now, mask, rays_at_r, ring_zeros);
    next[answers_at_r] = changed_address<D, "ANSWERS_LOW">(now, mask, answers_at_r, ring_zeros);
    next[ring_last_r] = changed_number<D, "RING_LAST">(now, mask, ring_last_r);
    next[offered_r] = changed_number<D, "OFFERED">(now, mask, offered_r);
    next[interrupt_r] = changed_number<D, "INTERRUPT">(now, mask, interrupt_r);
    const auto from = slice(now[interrupt_r], Width<ring_count_bits - 1>(), 0_w);
    const Bit enough = ~sign(minus(in[answers_there], from));
    next[interrupts_r] = as("interrupts", bit_at(now[interrupt_r], Width<ring_count_bits>()) & enough);
    const auto ones = now[written_word] & mask;
    const auto cleared =
        slice(mask_at<D>(now, ones, at<"STATUS">), bit<"STATUS", "overfull">, bit<"STATUS", "ring_error">);
    next[ring_flaws_r] = in[rings_flaws] | (now[ring_flaws_r] & ~cleared);
  }

  /// How a cache is told that the image has changed, and how many lines it may read.
  template <class D>
  static constexpr void of_cache(const auto& now, const auto& mask, const typename D::bit& writes,
                                 const auto& next) {
    using Bit = typename D::bit;
    const auto is_at = [&](int place) { return is<D>(now[write_place], place); };
    const Bit of_image = is_at(at<"BASE_LOW">) | is_at(at<"BASE_HIGH">) | is_at(at<"LAST_BLOCK">);
    const auto ones = now[written_word] & mask;
    const Bit asked_to = bit_at(mask_at<D>(now, ones, at<"CONTROL">), bit<"CONTROL", "empty_cache">);
    next[empties_r] = as("empties", (writes & of_image) | asked_to);
    next[most_lines_r] = changed_number<D, "MOST_LINES">(now, mask, most_lines_r);
  }
  /// What a write and a soft reset make of a register's number, by its rules in the table.
  template <class D, Name Register>
  static constexpr auto changed_number(const auto& now, const auto& mask, auto field) {
    using Bit = typename D::bit;
    constexpr auto& rules = called(Register.text);
    constexpr SoftReset soft = rules.fields.front().soft_reset;
    const auto number = fitting_number<D, rules.fit>(now, mask, field, rules.place);
    if constexpr (soft == SoftReset::holds)
      return only(Bit(~now[stops]), number);
    else if constexpr (soft == SoftReset::clears)
      return only(Bit(~now[resets_r]), number);
    else
      return number;
  }
  template <class D, Fit Rule>
  static constexpr auto fitting_number(const auto& now, const auto& mask, auto field, int at) {
    static_assert(Rule != Fit::cut);
    const auto by = cat(D::lit(0, 32_w), mask_at<D>(now, mask, at));
    const auto words = cat(now[written_word], now[written_word]);
    const auto word = (two_words(now[field]) & ~by) | (words & by);
    const auto width = width_of(now[field]);
    const typename D::bit above = any<D>(slice(word, 63_w, width));
    const auto number = slice(word, width - 1_w, 0_w) | spread(above, width);
    if constexpr (Rule == Fit::from_one)
      return number | resize(~any<D>(number), width);
    else
      return number;
  }

  template <class D>
  static constexpr typename D::bit is_idle(const auto& f, const auto& now, const auto& in) {
    typename D::bit idle = ~any<D>(now[flying]) & ~now[stops];
    if (has_rings(f)) idle = idle & ~in[rings_busy];
    return idle;
  }

  /// Rays and blocks on their way, what has gone wrong, and a soft reset.
  template <class D>
  static constexpr void follow(const auto& f, const auto& now, const auto& in, const auto& mask,
                               const auto& next) {
    using Bit = typename D::bit;
    const Bit goes_on = ~now[resets_r];
    const auto moves = [&](auto field, const Bit& comes, const Bit& leaves) {
      next[field] = only(goes_on, minus(plus(now[field], comes), leaves));
    };
    const Bit answered = in[Hits::valid] & in[Hits::ready];
    moves(flying, in[ray_valid] & in[ray_ready], answered);
    moves(reading, in[request_valid] & in[request_ready], in[read_valid]);

    const auto happens = [&](int failure) { return Bit(answered & is<D>(in[Hits::failed], failure)); };
    const auto ones = now[written_word] & mask;
    const Bit low_base = any<D>(slice(mask_at<D>(now, ones, at<"BASE_LOW">), image_zeros - 1_w, 0_w));
    const auto happened =
        cat(low_base, Bit(in[read_valid] & in[read_error]), happens(unread_block), happens(outside_image),
            happens(too_many_levels), happens(too_many_steps), happens(no_ray));
    const auto cleared =
        slice(mask_at<D>(now, ones, at<"STATUS">), bit<"STATUS", "base_error">, bit<"STATUS", "failed">);
    next[sticky_r] = as("sticky", (now[sticky_r] & ~cleared) | happened);

    const Bit begins =
        as("soft_reset", bit_at(mask_at<D>(now, ones, at<"CONTROL">), bit<"CONTROL", "soft_reset">));
    const Bit stopping = as("stopping", begins | (now[stops] & goes_on));
    // The core gives answers to its rings until they are full, or its reset comes.
    const Bit answers_left = has_rings(f) ? Bit(~in[rings_quiet]) : Bit(now[offers_answers]);
    const Bit still = as("still", now[stops] & ~now[offers_requests] & ~answers_left & ~any<D>(now[reading]));
    // What is offered stays until it is taken.
    next[offers_requests] = ~stopping | (now[offers_requests] & in[request_valid] & ~in[request_ready]);
    next[offers_answers] = ~stopping | (now[offers_answers] & in[Hits::valid] & ~in[Hits::ready]);
    next[resets_r] = still & goes_on;
    next[stops] = stopping;
  }

  template <class D>
  static constexpr void count(const auto& f, const auto& now, const auto& in, const typename D::bit& clears,
                              const auto& next) {
    using Bit = typename D::bit;
    const auto add = [&](auto counter, const Bit& happens) {
      next[counter] = only(Bit(~clears), plus(now[counter], happens));
    };
    const Bit answers = as("answers", in[Hits::valid] & in[Hits::ready]);
    const Bit asked = as("asked", in[request_valid] & in[request_ready]);
    const Bit triangle = sign(in[request_id]);
    add(count_cycles, D::lit(1, 1_w));
    add(count_rays, in[ray_valid] & in[ray_ready]);
    add(count_answers, answers);
    add(count_hits, answers & ~any<D>(in[Hits::failed]) & any<D>(~in[Hits::number]));
    add(count_records, asked & ~triangle);
    add(count_triangles, asked & triangle);
    add(count_idle, ~in[request_valid]);
    add(count_refused, in[request_valid] & ~in[request_ready]);
    if (has_cache(f)) {
      add(count_cache_hits, in[hit_happens]);
      add(count_joins, in[join_happens]);
      add(count_lines, in[line_asked]);
    }
  }
};

}  // namespace registers

using registers::Registers;

}  // namespace hitpipe::hls
