// What int_triangle is given (docs/core.md): a triangle that memory gives, and the ray that wanted it. The
// unit takes a test in some cycles only. Till then triangles wait. A test begins every two cycles at most.
// A triangle that is tested again to settle a tie has the ray's origin moved: its lowest bit along slot a or b is the
// other one.
#pragma once

#include "hls/machines/triangle_queue.hpp"

namespace hitpipe::hls {
namespace triangle_feed {

using namespace channels;
namespace queue = triangle_queue;

// The next test of a ray. It is written as the ray begins; ties write it in a cycle in which none does.
constexpr ControlIf<"retests_1", 1, has_questions> retests_1;
constexpr DataIf<"retest_ray_1", ray_bits, has_questions> retest_ray_1;
constexpr DataIf<"retest_is_1", test_bits, has_questions> retest_is_1;
constexpr BlockIf<"tests", &CoreBits::rays, test_bits, has_questions> tests;  // by ray
constexpr BlockIf<"onces", &CoreBits::rays, 1, has_questions> onces;          // by ray: it wants crossings

struct TriangleFeed {
  static constexpr const char* name = "triangle_feed";
  static constexpr const char* summary = "gives triangles and their rays to the triangle unit";
  using Bits = CoreBits;
  using BuiltIn = FormatList<Fixed<CoreBits{{20, 1, 20, 0, 0}, 5}>, Fixed<CoreBits{{20, 1, 20, 0, 0}, 7}>>;
  struct In : Join<queue::In, Begins::Back, List<ray_once>, Retests> {};
  struct Out : Join<TriangleRead, List<unread>, Begins, queue::Origins, queue::Slopes, queue::Corner0,
                    queue::Corner1, queue::Corner2, Testing> {};
  struct State : Join<queue::State, List<retests_1, retest_ray_1, retest_is_1>> {};
  struct Memory : Join<queue::Memory, List<tests, onces>> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& memory, const auto& out) {
    out[reads] = now[queue::reads_1];
    out[read_ray] = now[queue::reader_1];
    out[number] = now[queue::number_1];
    out[unread] = now[queue::unread_1];
    out[begins] = now[queue::ready];
    out[test_ray] = memory[queue::rays].word();
    if (has_questions(CoreBits(f)))
      give_moved<D>(memory, out);
    else
      out.copy(memory[queue::origins].word());
    out.copy(memory[queue::slopes].word());
    out.copy(memory[queue::corners_0].word());
    out.copy(memory[queue::corners_1].word());
    out.copy(memory[queue::corners_2].word());
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    const typename D::bit taken = as("taken", now[queue::ready] & in[unit_takes]);
    queue::step<D>(f, now, in, taken, memory, next);
    if (has_questions(CoreBits(f))) keep_tests<D>(now, in, memory, next);
  }

 private:
  /// The oldest triangle's origin.
  template <class D>
  static constexpr void give_moved(const auto& memory, const auto& out) {
    using Bit = typename D::bit;
    const auto ray = memory[queue::origins].word();
    const auto test = memory[tests].word();
    const Bit low = bit_at(test, 0_w), high = sign(test);
    const Bit along_a = as("along_a", low & ~high), along_b = as("along_b", high & ~low);
    const auto moved = [](const auto& origin, const Bit& moves) {
      return as_signed(
          cat(slice(origin, width_of(origin) - 1_w, 1_w), Bit(Bit(bit_at(origin, 0_w)) ^ moves)));
    };
    out[queue::major_y] = ray[queue::major_y];
    out[queue::major_z] = ray[queue::major_z];
    out[queue::back_m] = ray[queue::back_m];
    out[queue::origin_m] = ray[queue::origin_m];
    out[queue::origin_a] = moved(ray[queue::origin_a], along_a);
    out[queue::origin_b] = moved(ray[queue::origin_b], along_b);
    out[test_is] = test;
    out[test_once] = memory[onces].word();
    out[test_down] =
        select(high, Bit(bit_at(ray[queue::origin_b], 0_w)), Bit(bit_at(ray[queue::origin_a], 0_w)));
  }
  template <class D>
  static constexpr void keep_tests(const auto& now, const auto& in, const auto& memory, const auto& next) {
    using Bit = typename D::bit;
    const Bit begins_one = as("begins_one", in[ray_valid] & in[ray_ready]);
    memory[onces].write(begins_one, in[begun_at], in[ray_once]);
    memory[tests].write(Bit(begins_one | now[retests_1]), select(begins_one, in[begun_at], now[retest_ray_1]),
                        only(Bit(~begins_one), now[retest_is_1]));
    const auto oldest_ray = memory[queue::rays].word();
    memory[tests].ask(oldest_ray);
    memory[onces].ask(oldest_ray);
    next[retests_1] = in[retests] | (now[retests_1] & begins_one);
    next.where(in[retests])[retest_ray_1] = in[retest_ray];
    next.where(in[retests])[retest_is_1] = in[retest_is];
  }
};

}  // namespace triangle_feed

using triangle_feed::TriangleFeed;

}  // namespace hitpipe::hls
