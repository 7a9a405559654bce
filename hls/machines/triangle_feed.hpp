// What int_triangle is given (docs/core.md): a triangle that memory gives, and the ray that wanted it. The
// unit takes a test in some cycles only. Till then triangles wait. A test begins every two cycles at most.
#pragma once

#include "hls/machines/triangle_queue.hpp"

namespace hitpipe::hls {
namespace triangle_feed {

using namespace channels;
namespace queue = triangle_queue;

struct TriangleFeed {
  static constexpr const char* name = "triangle_feed";
  static constexpr const char* summary = "gives triangles and their rays to the triangle unit";
  using Bits = CoreBits;
  using BuiltIn = FormatList<Fixed<CoreBits{{20, 1, 20, 0, 0}, 5}>, Fixed<CoreBits{{20, 1, 20, 0, 0}, 7}>>;
  struct In : Join<queue::In, Begins::Back> {};
  struct Out : Join<TriangleRead, List<unread>, Begins, queue::Origins, queue::Slopes, queue::Corner0,
                    queue::Corner1, queue::Corner2> {};
  using State = queue::State;
  using Memory = queue::Memory;

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    out[reads] = now[queue::reads_1];
    out[read_ray] = now[queue::reader_1];
    out[number] = now[queue::number_1];
    out[unread] = now[queue::unread_1];
    out[begins] = now[queue::ready];
    out[test_ray] = memory[queue::rays].word();
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
  }
};

}  // namespace triangle_feed

using triangle_feed::TriangleFeed;

}  // namespace hitpipe::hls
