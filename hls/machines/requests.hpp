// Requests to memory, on their way out (docs/core.md). Two have room here, so a request can leave in every
// cycle although the reader is told a cycle before that one is granted.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

/// The format "aAhHiI", for example a24h32i5.
///   A  bits of a block's number;  H  bits of an address, of bytes, at least A + 5;  I  bits of a ray's
///   number
struct RequestBits {
  int address = 24;  ///< A
  int bytes = 32;    ///< H
  int ray = 5;       ///< I

  static constexpr FormatField fields[] = {{"a", "A", 4, 32}, {"h", "H", 9, 64}, {"i", "I", 1, 8}};
  static constexpr const char* condition = "H at least A+5";
  static constexpr const char* type = "RequestFormat";

  constexpr bool valid() const { return bytes >= address + 5; }
  friend constexpr bool operator==(const RequestBits& a, const RequestBits& b) {
    return a.address == b.address && a.bytes == b.bytes && a.ray == b.ray;
  }
};
template <int Address, int Bytes, int Ray>
struct RequestFormat {
  static constexpr RequestBits bits{Address, Bytes, Ray};
  static_assert(bits.valid(), "there is no such format aAhHiI");
  Width<Address> address{};
  Width<Bytes> bytes{};
  Width<Ray> ray{};
  constexpr operator RequestBits() const { return bits; }
};

namespace requests {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  using Ray = decltype(format.ray + 0_w);
  using Id = decltype(format.ray + 1_w);
  using Address = decltype(format.address + 0_w);
  using Block = decltype(format.bytes - 5_w);
  using Bytes = decltype(format.bytes + 0_w);
};

template <class D, class F>
struct Request {
  using W = Widths<F>;
  typename D::bit there;
  Word<D, typename W::Block> block;
  Word<D, typename W::Id> id;
};
/// One of two requests.
template <class D, class F>
constexpr Request<D, F> select(const typename D::bit& bit, const Request<D, F>& a, const Request<D, F>& b) {
  return {select(bit, a.there, b.there), select(bit, a.block, b.block), select(bit, a.id, b.id)};
}

template <class D, class F>
struct State {
  Request<D, F> first, second;  ///< the first one is asked for

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const RequestBits bits = format;
    visit(control_field("there_1", 1), self.first.there);
    visit(data_field("block_1", bits.bytes - 5), self.first.block);
    visit(data_field("id_1", bits.ray + 1), self.first.id);
    visit(control_field("there_2", 1), self.second.there);
    visit(data_field("block_2", bits.bytes - 5), self.second.block);
    visit(data_field("id_2", bits.ray + 1), self.second.id);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit asks;  ///< the reader's
  Word<D, typename W::Address> wanted;
  Word<D, typename W::Ray> asker;
  bit triangle;
  Word<D, typename W::Block> base;  ///< the image's address, divided by 32; constant while rays are in flight
  bit taken;                        ///< memory takes the request that is given

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const RequestBits bits = format;
    visit(data_field("asks", 1), self.asks);
    visit(data_field("wanted", bits.address), self.wanted);
    visit(data_field("asker", bits.ray), self.asker);
    visit(data_field("triangle", 1), self.triangle);
    visit(data_field("base", bits.bytes - 5), self.base);
    visit(data_field("request_ready", 1), self.taken);
  }
};

template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit granted;  ///< to the reader
  bit there;
  Word<D, typename W::Bytes> bytes;  ///< the address, a multiple of 32
  Word<D, typename W::Id> id;        ///< the ray, and above it 1 for a triangle

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const RequestBits bits = format;
    visit(data_field("granted", 1), self.granted);
    visit(data_field("request_valid", 1), self.there);
    visit(data_field("request_address", bits.bytes), self.bytes);
    visit(data_field("request_id", bits.ray + 1), self.id);
  }
};

template <class Memory>
struct Memories {
  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format&, Self&, Visit&&) {}
};

struct Requests {
  static constexpr const char* name = "requests";
  static constexpr const char* summary = "requests to memory, with their addresses";
  static constexpr const char* header = __FILE__;
  using Bits = RequestBits;
  using BuiltIn = FormatList<RequestFormat<24, 32, 5>, RequestFormat<24, 32, 7>>;
  template <class D, class F>
  using State = requests::State<D, F>;
  template <class D, class F>
  using Inputs = requests::Inputs<D, F>;
  template <class D, class F>
  using Outputs = requests::Outputs<D, F>;
  template <class Memory>
  using Memories = requests::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state, Memories<Memory>&) {
    return {typename D::bit(~state.second.there), state.first.there,
            cat(state.first.block, D::lit(0, 5_w + format.ray * 0_w)), state.first.id};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in, Memories<Memory>&) {
    using Bit = typename D::bit;
    const Request<D, F> fresh{in.asks,
                              as("block", as_unsigned(resize(in.base + in.wanted, format.bytes - 5_w))),
                              cat(in.triangle, in.asker)};
    const Bit holds = as("holds", state.first.there & ~in.taken);
    const Request<D, F> next = select(state.second.there, state.second, fresh);
    const Bit waits = as("waits", holds & next.there);
    state.first = select(holds, state.first, next);
    state.second = next;
    state.second.there = waits;
  }
};

}  // namespace requests

using requests::Requests;

}  // namespace hls
}  // namespace hitpipe
