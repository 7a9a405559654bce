// What the host says to a core and reads of it (docs/core.md): registers behind AXI4-Lite. Words have 32
// bits; an address is that of a word, and its two low bits are ignored. A word that is not in this list reads
// as 0, and to write it changes nothing.
//   0x00  identity        0x04  version
//   0x10  base address of the image: low word, a multiple of 32; 0x14: high word
//   0x18  number of the image's last block
//   0x1c  records that a ray may test
//   0x20  rays in flight; 0 after a reset, and then no ray begins. Only a reset makes them fewer
//   0x24  counters: a write makes all 0
//   0x40  counters, of two words each, the low one first: cycles, rays that have begun, answers, answers with
//         a hit, records that were asked for, triangles that were asked for, cycles without a request, cycles
//         in which memory took no request
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/machine.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {

/// The format "aAhHiIcC", for example a24h32i5c40.
///   A  bits of a block's number
///   H  bits of an address, of bytes, at least A + 5
///   I  bits of a ray's number
///   C  bits of a counter
struct RegisterBits {
  int address = 24;  ///< A
  int bytes = 32;    ///< H
  int ray = 5;       ///< I
  int counter = 40;  ///< C

  static constexpr FormatField fields[] = {
      {"a", "A", 4, 32}, {"h", "H", 9, 64}, {"i", "I", 1, 8}, {"c", "C", 1, 64}};
  static constexpr const char* condition = "H at least A+5";
  static constexpr const char* type = "RegisterFormat";

  constexpr bool valid() const { return bytes >= address + 5; }
  friend constexpr bool operator==(const RegisterBits& a, const RegisterBits& b) {
    return a.address == b.address && a.bytes == b.bytes && a.ray == b.ray && a.counter == b.counter;
  }
};
template <int Address, int Bytes, int Ray, int Counter>
struct RegisterFormat {
  static constexpr RegisterBits bits{Address, Bytes, Ray, Counter};
  static_assert(bits.valid(), "there is no such format aAhHiIcC");
  Width<Address> address{};
  Width<Bytes> bytes{};
  Width<Ray> ray{};
  Width<Counter> counter{};
  constexpr operator RegisterBits() const { return bits; }
};

namespace registers {

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

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto word_of(const F& f) { return f.ray * 0_w + 32_w; }

  using Place = decltype(format.ray * 0_w + Width<word_place_bits>());
  using Bits32 = decltype(word_of(format));
  using Strobes = decltype(format.ray * 0_w + 4_w);
  using Pair = decltype(format.ray * 0_w + 2_w);
  using Byte = decltype(format.ray * 0_w + 8_w);
  using Block = decltype(format.bytes - 5_w);
  using Address = decltype(format.address + 0_w);
  using Steps = decltype(format.ray * 0_w + Width<step_count_bits>());
  using Rays = decltype(format.ray + 1_w);
  using Id = decltype(format.ray + 1_w);
  using Counter = decltype(format.counter + 0_w);
};

template <class D, class F>
struct State {
  using W = Widths<F>;
  using bit = typename D::bit;

  // A write: its address and its word come in any order.
  bit has_place, has_word;
  Word<D, typename W::Place> write_place;
  Word<D, typename W::Bits32> word;
  Word<D, typename W::Strobes> strobes;
  bit written;  ///< its answer is given
  bit has_read, gives;
  Word<D, typename W::Place> read_place;
  Word<D, typename W::Bits32> given;
  Word<D, typename W::Block> base;
  Word<D, typename W::Address> last;
  Word<D, typename W::Steps> most_steps;
  Word<D, typename W::Rays> most_rays;
  Word<D, typename W::Counter> cycles, rays, answers, hits, records, triangles, idle, refused;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const RegisterBits bits = format;
    visit(control_field("has_place", 1), self.has_place);
    visit(control_field("has_word", 1), self.has_word);
    visit(data_field("write_place", word_place_bits), self.write_place);
    visit(data_field("written_word", 32), self.word);
    visit(data_field("strobes", 4), self.strobes);
    visit(control_field("written", 1), self.written);
    visit(control_field("has_read", 1), self.has_read);
    visit(control_field("gives", 1), self.gives);
    visit(data_field("read_place", word_place_bits), self.read_place);
    visit(data_field("given", 32), self.given);
    visit(control_field("base_r", bits.bytes - 5), self.base);
    visit(control_field("last_r", bits.address), self.last);
    visit(control_field("most_steps_r", step_count_bits, low_mask(step_count_bits)), self.most_steps);
    visit(control_field("most_rays_r", bits.ray + 1), self.most_rays);
    visit(control_field("count_cycles", bits.counter), self.cycles);
    visit(control_field("count_rays", bits.counter), self.rays);
    visit(control_field("count_answers", bits.counter), self.answers);
    visit(control_field("count_hits", bits.counter), self.hits);
    visit(control_field("count_records", bits.counter), self.records);
    visit(control_field("count_triangles", bits.counter), self.triangles);
    visit(control_field("count_idle", bits.counter), self.idle);
    visit(control_field("count_refused", bits.counter), self.refused);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit awvalid;
  Word<D, typename W::Byte> awaddr;
  bit wvalid;
  Word<D, typename W::Bits32> wdata;
  Word<D, typename W::Strobes> wstrb;
  bit bready, arvalid;
  Word<D, typename W::Byte> araddr;
  bit rready;
  // What is counted: ports of the core.
  bit ray_valid, ray_ready, hit_valid, hit_ready;
  Word<D, typename W::Bits32> hit_number;
  bit request_valid, request_ready;
  Word<D, typename W::Id> request_id;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const RegisterBits bits = format;
    visit(data_field("awvalid", 1), self.awvalid);
    visit(data_field("awaddr", word_place_bits + 2), self.awaddr);
    visit(data_field("wvalid", 1), self.wvalid);
    visit(data_field("wdata", 32), self.wdata);
    visit(data_field("wstrb", 4), self.wstrb);
    visit(data_field("bready", 1), self.bready);
    visit(data_field("arvalid", 1), self.arvalid);
    visit(data_field("araddr", word_place_bits + 2), self.araddr);
    visit(data_field("rready", 1), self.rready);
    visit(data_field("ray_valid", 1), self.ray_valid);
    visit(data_field("ray_ready", 1), self.ray_ready);
    visit(data_field("hit_valid", 1), self.hit_valid);
    visit(data_field("hit_ready", 1), self.hit_ready);
    visit(data_field("hit_number", triangle_number_bits), self.hit_number);
    visit(data_field("request_valid", 1), self.request_valid);
    visit(data_field("request_ready", 1), self.request_ready);
    visit(data_field("request_id", bits.ray + 1), self.request_id);
  }
};

template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit awready, wready, bvalid;
  Word<D, typename W::Pair> bresp;
  bit arready, rvalid;
  Word<D, typename W::Bits32> rdata;
  Word<D, typename W::Pair> rresp;
  Word<D, typename W::Block> base;
  Word<D, typename W::Address> last;
  Word<D, typename W::Steps> most_steps;
  Word<D, typename W::Rays> most_rays;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const RegisterBits bits = format;
    visit(data_field("awready", 1), self.awready);
    visit(data_field("wready", 1), self.wready);
    visit(data_field("bvalid", 1), self.bvalid);
    visit(data_field("bresp", 2), self.bresp);
    visit(data_field("arready", 1), self.arready);
    visit(data_field("rvalid", 1), self.rvalid);
    visit(data_field("rdata", 32), self.rdata);
    visit(data_field("rresp", 2), self.rresp);
    visit(data_field("base", bits.bytes - 5), self.base);
    visit(data_field("last", bits.address), self.last);
    visit(data_field("most_steps", step_count_bits), self.most_steps);
    visit(data_field("most_rays", bits.ray + 1), self.most_rays);
  }
};

template <class Memory>
struct Memories {
  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format&, Self&, Visit&&) {}
};

struct Registers {
  static constexpr const char* name = "registers";
  static constexpr const char* summary = "what the host says to a core and reads of it";
  static constexpr const char* header = __FILE__;
  using Bits = RegisterBits;
  using BuiltIn = FormatList<RegisterFormat<24, 32, 5, 40>>;
  template <class D, class F>
  using State = registers::State<D, F>;
  template <class D, class F>
  using Inputs = registers::Inputs<D, F>;
  template <class D, class F>
  using Outputs = registers::Outputs<D, F>;
  template <class Memory>
  using Memories = registers::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state, Memories<Memory>&) {
    const auto okay = D::lit(0, 2_w + format.ray * 0_w);
    using Bit = typename D::bit;
    return {Bit(~state.has_place), Bit(~state.has_word), state.written, okay,       Bit(~state.has_read),
            state.gives,           state.given,          okay,          state.base, state.last,
            state.most_steps,      state.most_rays};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in, Memories<Memory>&) {
    using Bit = typename D::bit;
    const auto place_of = [](const auto& address) { return slice(address, 7_w, 2_w); };

    // Reads, before anything changes.
    const Bit reads = as("reads", state.has_read & (~state.gives | in.rready));
    const auto read_word = as("read_word", word_at<D>(format, state));
    state.given = select(reads, read_word, state.given);
    state.gives = reads | (state.gives & ~in.rready);
    state.read_place = select(state.has_read, state.read_place, place_of(in.araddr));
    state.has_read = (state.has_read & ~reads) | (~state.has_read & in.arvalid);

    const Bit writes = as("writes", state.has_place & state.has_word & ~state.written);
    const Bit clears = as("clears", writes & is_at<D>(state.write_place, clear_at));
    count<D>(format, state, in, clears);
    write<D>(format, state, writes);
    state.written = writes | (state.written & ~in.bready);
    state.write_place = select(state.has_place, state.write_place, place_of(in.awaddr));
    state.word = select(state.has_word, state.word, in.wdata);
    state.strobes = select(state.has_word, state.strobes, in.wstrb);
    state.has_place = (state.has_place & ~writes) | (~state.has_place & in.awvalid);
    state.has_word = (state.has_word & ~writes) | (~state.has_word & in.wvalid);
  }

 private:
  template <class D, class X>
  static constexpr typename D::bit is_at(const X& place, int word) {
    return typename D::bit(place == D::lit(word, width_of(place)));
  }

  /// x in 64 bits: two words.
  template <class F, class X>
  static constexpr auto two_words(const F& format, const X& x) {
    return as_unsigned(resize(x, 64_w + format.ray * 0_w));
  }

  template <class D, class F>
  static constexpr auto word_at(const F& format, const State<D, F>& s) {
    using Bit = typename D::bit;
    const auto w = Widths<F>::word_of(format);
    const auto if_at = [&](int place, const auto& word) {
      return word & spread(is_at<D>(s.read_place, place), w);
    };
    const auto low = [&](const auto& x) { return slice(two_words(format, x), 31_w, 0_w); };
    const auto high = [&](const auto& x) { return slice(two_words(format, x), 63_w, 32_w); };
    const auto address = cat(s.base, D::lit(0, 5_w));
    const auto settings = if_at(identity_at, D::lit(identity, w)) | if_at(version_at, D::lit(version, w)) |
                          if_at(base_at, low(address)) | if_at(high_base_at, high(address)) |
                          if_at(last_at, low(s.last)) | if_at(most_steps_at, low(s.most_steps)) |
                          if_at(most_rays_at, low(s.most_rays));
    const Bit second = bit_at(s.read_place, 0_w);
    const auto counter = [&](int number, const auto& x) {
      const auto place = slice(s.read_place, Width<word_place_bits - 1>(), 1_w);
      return select(second, high(x), low(x)) & spread(is_at<D>(place, counters_at / 2 + number), w);
    };
    return settings | counter(0, s.cycles) | counter(1, s.rays) | counter(2, s.answers) | counter(3, s.hits) |
           counter(4, s.records) | counter(5, s.triangles) | counter(6, s.idle) | counter(7, s.refused);
  }

  template <class D, class F>
  static constexpr void write(const F& format, State<D, F>& s, const typename D::bit& writes) {
    using Bit = typename D::bit;
    const auto byte = [&](const auto& i) {
      return spread(Bit(bit_at(s.strobes, i)), 8_w + format.ray * 0_w);
    };
    const auto mask = as("mask", cat(cat(byte(3_w), byte(2_w)), cat(byte(1_w), byte(0_w))));
    const auto none = D::lit(0, Widths<F>::word_of(format));
    const auto masks = [&](int low_at, int high_at) {
      const auto if_at = [&](int place) {
        return select(Bit(writes & is_at<D>(s.write_place, place)), mask, none);
      };
      return cat(high_at > 0 ? if_at(high_at) : none, if_at(low_at));
    };
    const auto words = cat(s.word, s.word);
    const auto changed = [&](const auto& old, const auto& by) { return (old & ~by) | (words & by); };
    const auto address = two_words(format, cat(s.base, D::lit(0, 5_w)));
    s.base = slice(changed(address, masks(base_at, high_base_at)), format.bytes - 1_w, 5_w);
    const auto low_part = [&](const auto& old, int at, const auto& width) {
      return slice(changed(two_words(format, old), masks(at, 0)), width - 1_w, 0_w);
    };
    s.last = low_part(s.last, last_at, format.address);
    s.most_steps = low_part(s.most_steps, most_steps_at, Width<step_count_bits>());
    s.most_rays = low_part(s.most_rays, most_rays_at, format.ray + 1_w);
  }

  template <class D, class F>
  static constexpr void count(const F& format, State<D, F>& s, const Inputs<D, F>& in,
                              const typename D::bit& clears) {
    using Bit = typename D::bit;
    const auto add = [&](auto& counter, const Bit& happens) {
      const auto sum = as_unsigned(resize(counter + happens, format.counter));
      counter = sum & spread(Bit(~clears), format.counter);
    };
    const Bit answers = as("answers", in.hit_valid & in.hit_ready);
    const Bit asked = as("asked", in.request_valid & in.request_ready);
    const Bit triangle = bit_at(in.request_id, format.ray);
    add(s.cycles, D::lit(1, 1_w));
    add(s.rays, in.ray_valid & in.ray_ready);
    add(s.answers, answers);
    add(s.hits, answers & any<D>(~in.hit_number));
    add(s.records, asked & ~triangle);
    add(s.triangles, asked & triangle);
    add(s.idle, ~in.request_valid);
    add(s.refused, in.request_valid & ~in.request_ready);
  }
};

}  // namespace registers

using registers::Registers;

}  // namespace hls
}  // namespace hitpipe
