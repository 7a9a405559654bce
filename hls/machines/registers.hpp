// What the host says to a core and reads of it (docs/core.md): registers behind AXI4-Lite. Words have 32
// bits; an address is that of a word, and its two low bits are ignored. A word that is not in this list reads
// as 0, and to write it changes nothing. A number that is too large for its register becomes the largest there.
//   0x00  identity        0x04  version
//   0x10  base address of the image: low word, a multiple of 32; 0x14: high word, without bits above the bus
//   0x18  number of the image's last block
//   0x1c  records that a ray may test
//   0x20  rays in flight; 0 after a reset, and then no ray begins. Only a reset makes them fewer
//   0x24  counters: a write makes all 0
//   0x40  counters, of two words each, the low one first: cycles, rays that have begun, answers, answers with
//         a hit that have not failed, records that were asked for, triangles that were asked for, cycles without a request, cycles
//         in which memory took no request
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

  constexpr int block() const { return bytes - 5; }
  constexpr bool valid() const { return bytes >= address + 5; }
  friend constexpr bool operator==(const RegisterBits&, const RegisterBits&) = default;
};

namespace registers {

using namespace channels;

constexpr std::int64_t identity = 0x48697470;  ///< "Hitp"
constexpr std::int64_t version = 1;
constexpr int word_place_bits = 6;  ///< words up to 0xfc
/// Of words, not of bytes.
enum Place {
  identity_at,
  version_at,
  base_at = 4,
  high_base_at,
  last_at,
  most_steps_at,
  most_rays_at,
  clear_at
};
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
             Hits::valid, Hits::ready, Hits::number, Hits::failed, request_valid, request_ready, request_id> {
  };
  struct Out : Join<List<awready, wready, bvalid, bresp, arready, rvalid, rdata, rresp>, Settings> {};
  struct State : List<has_place, has_word, write_place, written_word, strobes, written, has_read, gives,
                      read_place, given, base_r, last_r, most_steps_r, most_rays_r, count_cycles, count_rays,
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
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& /*memory*/,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto place_of = [](const auto& address) { return slice(address, 7_w, 2_w); };

    const Bit reads = as("reads", now[has_read] & (~now[gives] | in[rready]));
    next.where(reads)[given] = as("read_word", word_read<D>(now));
    next[gives] = reads | (now[gives] & ~in[rready]);
    next[read_place] = select(now[has_read], now[read_place], place_of(in[araddr]));
    next[has_read] = (now[has_read] & ~reads) | (~now[has_read] & in[arvalid]);

    const Bit writes = as("writes", now[has_place] & now[has_word] & ~now[written]);
    const Bit clears = as("clears", writes & is<D>(now[write_place], clear_at));
    count<D>(now, in, clears, next);
    write<D>(now, writes, next);
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

  /// The word at `read_place`.
  template <class D>
  static constexpr auto word_read(const auto& now) {
    const auto if_at = [&](int place, const auto& word) { return only(is<D>(now[read_place], place), word); };
    const auto low = [&](const auto& x) { return slice(two_words(x), 31_w, 0_w); };
    const auto high = [&](const auto& x) { return slice(two_words(x), 63_w, 32_w); };
    const auto address = cat(now[base_r], D::lit(0, 5_w));
    const auto settings =
        if_at(identity_at, D::lit(identity, 32_w)) | if_at(version_at, D::lit(version, 32_w)) |
        if_at(base_at, low(address)) | if_at(high_base_at, high(address)) | if_at(last_at, low(now[last_r])) |
        if_at(most_steps_at, low(now[most_steps_r])) | if_at(most_rays_at, low(now[most_rays_r]));
    const typename D::bit second = bit_at(now[read_place], 0_w);
    const auto counter = [&](int number, auto field) {
      const auto place = slice(now[read_place], Width<word_place_bits - 1>(), 1_w);
      return only(is<D>(place, counters_at / 2 + number), select(second, high(now[field]), low(now[field])));
    };
    return settings | counter(0, count_cycles) | counter(1, count_rays) | counter(2, count_answers) |
           counter(3, count_hits) | counter(4, count_records) | counter(5, count_triangles) |
           counter(6, count_idle) | counter(7, count_refused);
  }

  template <class D>
  static constexpr void write(const auto& now, const typename D::bit& writes, const auto& next) {
    using Bit = typename D::bit;
    const auto byte = [&](const auto& i) { return spread(Bit(bit_at(now[strobes], i)), 8_w); };
    const auto mask = as("mask", cat(byte(3_w), byte(2_w), byte(1_w), byte(0_w)));
    const auto none = D::lit(0, 32_w);
    const auto masks = [&](int low_at, int high_at) {
      const auto if_at = [&](int place) {
        return select(Bit(writes & is<D>(now[write_place], place)), mask, none);
      };
      return cat(high_at > 0 ? if_at(high_at) : none, if_at(low_at));
    };
    const auto words = cat(now[written_word], now[written_word]);
    const auto changed = [&](const auto& old, const auto& by) { return (old & ~by) | (words & by); };
    const auto address = two_words(cat(now[base_r], D::lit(0, 5_w)));
    next[base_r] = slice(changed(address, masks(base_at, high_base_at)), width_of(now[base_r]) + 4_w, 5_w);
    const auto write_low = [&](auto field, int at) {
      const auto word = changed(two_words(now[field]), masks(at, 0));
      const auto width = width_of(now[field]);
      const Bit above = any<D>(slice(word, 63_w, width));
      next[field] = slice(word, width - 1_w, 0_w) | spread(above, width);
    };
    write_low(last_r, last_at);
    write_low(most_steps_r, most_steps_at);
    write_low(most_rays_r, most_rays_at);
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
    add(count_hits, answers & ~in[Hits::failed] & any<D>(~in[Hits::number]));
    add(count_records, asked & ~triangle);
    add(count_triangles, asked & triangle);
    add(count_idle, ~in[request_valid]);
    add(count_refused, in[request_valid] & ~in[request_ready]);
  }
};

}  // namespace registers

using registers::Registers;

}  // namespace hitpipe::hls
