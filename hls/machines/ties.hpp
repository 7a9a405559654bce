// Ties of rays that want crossings (docs/integer_world.md, Exactly once). A hit at an edge or a corner of a triangle
// counts if the ray still meets it after a move by eps along slot a and eps^2 along slot b. The unit settles that: the
// same triangle is tested again with the origin moved along slot a, by one unit up or down. A number that was 0, of u,
// v and e0, is now what the move has added to it. If it has the wrong sign the tie does not count; where it is 0 still,
// a test with the origin moved along slot b says. A tie that counts is tested once more as the ray is, and that test is
// a hit. All other tests pass: each test leaves one cycle after it has come.
#pragma once

#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {
namespace ties {

using namespace channels;

// What the unit says, with what the feed has said of the test.
using TestDet = Halves<"det", &CoreBits::determinant>;
using TestNum = Halves<"num", &CoreBits::volume>;
using SettledDet = Halves<"settled_det", &CoreBits::determinant>;
using SettledNum = Halves<"settled_num", &CoreBits::volume>;
constexpr Data<"tie"> tie;
constexpr int edges = 3;
constexpr Data<"zero", edges> zero;
constexpr Data<"inner", edges> inner;
constexpr Data<"tested_is", test_bits> tested_is;
constexpr Data<"tested_once"> tested_once;
constexpr Data<"tested_down"> tested_down;
struct Edges : List<tie, zero, inner, tested_is, tested_once, tested_down> {};

constexpr Control<"there"> there;
struct Numbers : List<TestDet::high, TestDet::low, TestNum::high, TestNum::low> {};
struct SettledNumbers : List<SettledDet::high, SettledDet::low, SettledNum::high, SettledNum::low> {};
struct Kept : Join<List<hit, tester>, Edges, Numbers> {};

constexpr Block<"meets", &CoreBits::rays, edges> meets;  // by ray: what was 0 in all tests so far

// To triangle_feed, as Retests.
constexpr Data<"next_is_other"> next_is_other;
constexpr Data<"next_ray", ray_bits> next_ray;
constexpr Data<"next_is", test_bits> next_is;
struct Next : List<next_is_other, next_ray, next_is> {};

struct Ties {
  static constexpr const char* name = "ties";
  static constexpr const char* summary =
      "settles hits at edges and corners, so that a surface is crossed once";
  using Bits = CoreBits;
  using BuiltIn =
      FormatList<Fixed<CoreBits{{20, 1, 20, 0, 0, 3}, 5}>, Fixed<CoreBits{{20, 1, 20, 0, 0, 3}, 7}>>;
  struct In : Join<Tested, Edges, Numbers> {};
  struct Out : Join<Settled, SettledNumbers, Next> {};
  struct State : Join<List<there>, Held<Kept>> {};
  struct Memory : List<meets> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    using Bit = typename D::bit;
    const auto what = settle<D>(now, memory);
    out[settled] = now[there];
    out[settled_hit] = now[held<hit>] & ~what.again & ~what.moved;
    out[settler] = now[held<tester>];
    out[settled_again] = what.again;
    out[SettledDet::high] = now[held<TestDet::high>];
    out[SettledDet::low] = now[held<TestDet::low>];
    out[SettledNum::high] = now[held<TestNum::high>];
    out[SettledNum::low] = now[held<TestNum::low>];
    // Behind a tie the ray's next triangle has a first test again.
    const Bit last = as("is_last", low_of<D>(now) & high_of<D>(now));
    out[next_is_other] = now[there] & (what.again | what.moved | last);
    out[next_ray] = now[held<tester>];
    const Bit along_a = what.again & ~what.moved;
    const Bit along_b = what.again & what.moved & low_of<D>(now) & what.left;
    const Bit as_it_is = what.again & what.moved & ~along_b;
    out[next_is] = cat(Bit(along_b | as_it_is), Bit(along_a | as_it_is));
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    const auto what = settle<D>(now, memory);
    memory[meets].write(now[there], now[held<tester>], what.zeros);
    memory[meets].ask(in[tester]);
    next[there] = in[tested];
    next.where(in[tested]).hold(in, Kept());
  }

 private:
  template <class D>
  static constexpr typename D::bit low_of(const auto& now) {
    return bit_at(now[held<tested_is>], 0_w);
  }
  template <class D>
  static constexpr typename D::bit high_of(const auto& now) {
    return sign(now[held<tested_is>]);
  }
  template <class D>
  static constexpr auto settle(const auto& now, const auto& memory) {
    using Bit = typename D::bit;
    const auto before = memory[meets].word();
    struct Settles {
      Bit moved;  // the test had the origin moved
      Bit again;  // and another test is needed
      Bit left;   // something is 0 still
      std::remove_cvref_t<decltype(before & now[held<zero>])> zeros;
    };
    const Bit moved = as("moved", low_of<D>(now) ^ high_of<D>(now));
    const Bit first = as("is_first", ~low_of<D>(now) & ~high_of<D>(now));
    const auto same = spread(now[held<tested_down>], Width<edges>());
    const auto outside = as("outside", before & ~now[held<zero>] & ~(now[held<inner>] ^ same));
    const auto still = as("still", before & now[held<zero>]);
    const Bit ties = as("is_tie", first & now[held<tested_once>] & now[held<tie>]);
    const Bit again = as("again", ties | (moved & ~any<D>(outside)));
    return Settles{moved, again, any<D>(still), select(first, now[held<zero>], still)};
  }
};

}  // namespace ties

using ties::Ties;

}  // namespace hitpipe::hls
