// What the host says to a core and reads of it (docs/core.md): registers behind AXI4-Lite. Words have 32
// bits; an address is that of a word, and its two low bits are ignored. A word that is not in this list reads
// as 0, and to write it changes nothing. A number that is too large for its register becomes the largest there.
//   0x00  identity        0x04  version
//   0x08  status: the bits of Status below. Some stay until software writes a 1 to them
//   0x0c  control: to write 1 begins a soft reset
//   0x10  base address of the image: low word, a multiple of 64; 0x14: high word, without bits above the bus
//   0x18  number of the image's last block
//   0x1c  records that a ray may test
//   0x20  rays in flight; 0 after a reset, and then no ray begins. Only a reset makes them fewer
//   0x24  counters: a write makes all 0
//   0x28  format, 0x2c: shape, 0x30: ports of the core, which are constants (rtl_gen/core/identity.hpp)
//   0x40  counters, of two words each, the low one first: cycles, rays that have begun, answers, answers with
//         a hit that have not failed, records that were asked for, triangles that were asked for, cycles without a
//         request, cycles in which memory took no request
//
// A soft reset takes no new ray, request or answer any more, but what is offered stays until it is taken. When all
// blocks that were asked for have come, the core is reset. Rays that were in flight get no answer.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "aAhHiIcC", for example a24h32i5c40.
struct RegisterBits {
  int address = 24;  ///< A: bits of a block's number
  int bytes = 32;    ///< H: bits of an address, of bytes, at least A + 5
  int ray = 5;       ///< I: bits of a ray's number
  int counter = 40;  ///< C: bits of a counter

  static constexpr FormatField fields[] = {
      {"a", "A", 4, 32}, {"h", "H", 9, 64}, {"i", "I", 1, 8}, {"c", "C", 1, 64}};
  static constexpr const char* condition = "H at least A+5";

  constexpr bool valid() const { return bytes >= address + 5; }
  friend constexpr bool operator==(const RegisterBits&, const RegisterBits&) = default;
};

namespace registers {

using namespace channels;

constexpr std::int64_t identity = 0x48697470;  ///< "Hitp"
constexpr std::int64_t version = 2;
constexpr int word_place_bits = 6;  ///< words up to 0xfc
/// Of words, not of bytes.
enum Place {
  identity_at,
  version_at,
  status_at,
  control_at,
  base_at,
  high_base_at,
  last_at,
  most_steps_at,
  most_rays_at,
  clear_at,
  format_at,
  shape_at,
  ports_at
};
/// Bits of the status. From `failed_bit` on they stay until software clears them.
enum Status {
  idle_bit,                                      ///< no ray is in the core, so the image may change
  resetting_bit,                                 ///< a soft reset is on its way
  failed_bit = 8,                                ///< and a Failure: an answer has failed by it
  bus_bit = failed_bit + int{unread_block} + 1,  ///< a block could not be read
  base_bit  ///< an address of an image was written that is no multiple of 64
};
constexpr int first_sticky = failed_bit + int{no_ray}, sticky_bits = base_bit - first_sticky + 1;
constexpr int counters_at = 16;

constexpr Data<"awvalid"> awvalid;
constexpr Data<"awaddr", word_place_bits + 2> awaddr;
constexpr Data<"wvalid"> wvalid;
constexpr Data<"wdata", 32> wdata;
constexpr Data<"wstrb", 4> wstrb;
constexpr Data<"bready"> bready;
constexpr Data<"arvalid"> arvalid;
constexpr Data<"araddr", word_place_bits + 2> araddr;
constexpr Data<"rready"> rready;
constexpr Data<"awready"> awready;
constexpr Data<"wready"> wready;
constexpr Data<"bvalid"> bvalid;
constexpr Data<"bresp", 2> bresp;
constexpr Data<"arready"> arready;
constexpr Data<"rvalid"> rvalid;
constexpr Data<"rdata", 32> rdata;
constexpr Data<"rresp", 2> rresp;
// What the core is.
constexpr Data<"about_format", 32> about_format;
constexpr Data<"about_shape", 32> about_shape;
constexpr Data<"about_ports", 32> about_ports;
// What passes between the core and its surroundings, and the reset of the core.
constexpr Data<"lets_rays"> lets_rays;
constexpr Data<"lets_requests"> lets_requests;
constexpr Data<"lets_answers"> lets_answers;
constexpr Data<"resets"> resets;

// A write: its address and its word come in any order.
constexpr Control<"has_place"> has_place;
constexpr Control<"has_word"> has_word;
constexpr Data<"write_place", word_place_bits> write_place;
constexpr Data<"written_word", 32> written_word;
constexpr Data<"strobes", 4> strobes;
constexpr Control<"written"> written;  // its answer is given
constexpr Control<"has_read"> has_read;
constexpr Control<"gives"> gives;
constexpr Data<"read_place", word_place_bits> read_place;
constexpr Data<"given", 32> given;
constexpr Control<"base_r", base_bits> base_r;
constexpr Control<"last_r", address_bits> last_r;
constexpr Control<"most_steps_r", step_count_bits, low_mask(step_count_bits)> most_steps_r;
constexpr Control<"most_rays_r", ray_count_bits> most_rays_r;
constexpr Control<"sticky_r", sticky_bits> sticky_r;
/// Some rays wait in front of those in flight.
inline constexpr auto flying_bits = [](const RegisterBits& f) { return f.ray + 5; };
constexpr Control<"flying", flying_bits> flying;       // rays in the core
constexpr Control<"reading", ray_count_bits> reading;  // blocks on their way
constexpr Control<"stops"> stops;                      // a soft reset has begun
constexpr Control<"offers_requests", 1, 1> offers_requests;
constexpr Control<"offers_answers", 1, 1> offers_answers;
constexpr Control<"resets_r"> resets_r;
constexpr Control<"count_cycles", &RegisterBits::counter> count_cycles;
constexpr Control<"count_rays", &RegisterBits::counter> count_rays;
constexpr Control<"count_answers", &RegisterBits::counter> count_answers;
constexpr Control<"count_hits", &RegisterBits::counter> count_hits;
constexpr Control<"count_records", &RegisterBits::counter> count_records;
constexpr Control<"count_triangles", &RegisterBits::counter> count_triangles;
constexpr Control<"count_idle", &RegisterBits::counter> count_idle;
constexpr Control<"count_refused", &RegisterBits::counter> count_refused;

struct Registers {
  static constexpr const char* name = "registers";
  static constexpr const char* summary = "what the host says to a core and reads of it";
  using Bits = RegisterBits;
  using BuiltIn = FormatList<Fixed<RegisterBits{24, 32, 5, 40}>>;
  struct In
      : List<awvalid, awaddr, wvalid, wdata, wstrb, bready, arvalid, araddr, rready, ray_valid, ray_ready,
             Hits::valid, Hits::ready, Hits::number, Hits::failed, request_valid, request_ready, request_id,
             read_valid, read_error, about_format, about_shape, about_ports> {};
  struct Out : Join<List<awready, wready, bvalid, bresp, arready, rvalid, rdata, rresp>, Settings,
                    List<lets_rays, lets_requests, lets_answers, resets>> {};
  struct State : List<has_place, has_word, write_place, written_word, strobes, written, has_read, gives,
                      read_place, given, base_r, last_r, most_steps_r, most_rays_r, sticky_r, flying, reading,
                      stops, offers_requests, offers_answers, resets_r, count_cycles, count_rays,
                      count_answers, count_hits, count_records, count_triangles, count_idle, count_refused> {
  };
  struct Memory : List<> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& /*memory*/, const auto& out) {
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
    out[lets_rays] = ~now[stops];
    out[lets_requests] = now[offers_requests];
    out[lets_answers] = now[offers_answers];
    out[resets] = now[resets_r];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& /*memory*/,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto place_of = [](const auto& address) { return slice(address, 7_w, 2_w); };

    const Bit reads = as("reads", now[has_read] & (~now[gives] | in[rready]));
    next.where(reads)[given] = as("read_word", word_read<D>(now, in));
    next[gives] = reads | (now[gives] & ~in[rready]);
    next[read_place] = select(now[has_read], now[read_place], place_of(in[araddr]));
    next[has_read] = (now[has_read] & ~reads) | (~now[has_read] & in[arvalid]);

    const Bit writes = as("writes", now[has_place] & now[has_word] & ~now[written]);
    const Bit clears = as("clears", writes & is<D>(now[write_place], clear_at));
    count<D>(now, in, clears, next);
    const auto mask = as("mask", mask_of<D>(now, writes));
    write<D>(now, mask, next);
    follow<D>(now, in, mask, next);
    next[written] = writes | (now[written] & ~in[bready]);
    next[write_place] = select(now[has_place], now[write_place], place_of(in[awaddr]));
    next[written_word] = select(now[has_word], now[written_word], in[wdata]);
    next[strobes] = select(now[has_word], now[strobes], in[wstrb]);
    next[has_place] = (now[has_place] & ~writes) | (~now[has_place] & in[awvalid]);
    next[has_word] = (now[has_word] & ~writes) | (~now[has_word] & in[wvalid]);
  }

 private:
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
  static constexpr auto word_read(const auto& now, const auto& in) {
    const auto if_at = [&](int place, const auto& word) { return only(is<D>(now[read_place], place), word); };
    const auto low = [&](const auto& x) { return slice(two_words(x), 31_w, 0_w); };
    const auto high = [&](const auto& x) { return slice(two_words(x), 63_w, 32_w); };
    const auto address = cat(now[base_r], D::lit(0, 6_w));
    const auto status =
        cat(now[sticky_r], cat(D::lit(0, Width<first_sticky - 2>()), cat(now[stops], is_idle<D>(now))));
    const auto about = if_at(status_at, low(status)) | if_at(format_at, in[about_format]) |
                       if_at(shape_at, in[about_shape]) | if_at(ports_at, in[about_ports]);
    const auto settings =
        if_at(identity_at, D::lit(identity, 32_w)) | if_at(version_at, D::lit(version, 32_w)) |
        if_at(base_at, low(address)) | if_at(high_base_at, high(address)) | if_at(last_at, low(now[last_r])) |
        if_at(most_steps_at, low(now[most_steps_r])) | if_at(most_rays_at, low(now[most_rays_r]));
    const typename D::bit second = bit_at(now[read_place], 0_w);
    const auto counter = [&](int number, auto field) {
      const auto place = slice(now[read_place], Width<word_place_bits - 1>(), 1_w);
      return only(is<D>(place, counters_at / 2 + number), select(second, high(now[field]), low(now[field])));
    };
    return about | settings | counter(0, count_cycles) | counter(1, count_rays) | counter(2, count_answers) |
           counter(3, count_hits) | counter(4, count_records) | counter(5, count_triangles) |
           counter(6, count_idle) | counter(7, count_refused);
  }

  template <class D>
  static constexpr void write(const auto& now, const auto& mask, const auto& next) {
    using Bit = typename D::bit;
    const auto words = cat(now[written_word], now[written_word]);
    const auto changed = [&](const auto& old, const auto& by) { return (old & ~by) | (words & by); };
    const auto address = two_words(cat(now[base_r], D::lit(0, 6_w)));
    const auto of_address = cat(mask_at<D>(now, mask, high_base_at), mask_at<D>(now, mask, base_at));
    next[base_r] = slice(changed(address, of_address), width_of(now[base_r]) + 5_w, 6_w);
    const auto changed_field = [&](auto field, int at) {
      const auto word = changed(two_words(now[field]), cat(D::lit(0, 32_w), mask_at<D>(now, mask, at)));
      const auto width = width_of(now[field]);
      const Bit above = any<D>(slice(word, 63_w, width));
      return slice(word, width - 1_w, 0_w) | spread(above, width);
    };
    next[last_r] = changed_field(last_r, last_at);
    next[most_steps_r] = changed_field(most_steps_r, most_steps_at);
    next[most_rays_r] = only(Bit(~now[stops]), changed_field(most_rays_r, most_rays_at));
  }

  template <class D>
  static constexpr typename D::bit is_idle(const auto& now) {
    return ~any<D>(now[flying]) & ~now[stops];
  }

  /// Rays and blocks on their way, what has gone wrong, and a soft reset.
  template <class D>
  static constexpr void follow(const auto& now, const auto& in, const auto& mask, const auto& next) {
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
    const Bit low_base = any<D>(slice(mask_at<D>(now, ones, base_at), 5_w, 0_w));
    const auto happened =
        cat(low_base, Bit(in[read_valid] & in[read_error]), happens(unread_block), happens(outside_image),
            happens(too_many_levels), happens(too_many_steps), happens(no_ray));
    const auto cleared = slice(mask_at<D>(now, ones, status_at), Width<base_bit>(), Width<first_sticky>());
    next[sticky_r] = as("sticky", (now[sticky_r] & ~cleared) | happened);

    const Bit begins = as("soft_reset", bit_at(mask_at<D>(now, ones, control_at), 0_w));
    const Bit stopping = as("stopping", begins | (now[stops] & goes_on));
    const Bit still =
        as("still", now[stops] & ~now[offers_requests] & ~now[offers_answers] & ~any<D>(now[reading]));
    // What is offered stays until it is taken.
    next[offers_requests] = ~stopping | (now[offers_requests] & in[request_valid] & ~in[request_ready]);
    next[offers_answers] = ~stopping | (now[offers_answers] & in[Hits::valid] & ~in[Hits::ready]);
    next[resets_r] = still & goes_on;
    next[stops] = stopping;
  }

  template <class D>
  static constexpr void count(const auto& now, const auto& in, const typename D::bit& clears,
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
  }
};

}  // namespace registers

using registers::Registers;

}  // namespace hitpipe::hls
