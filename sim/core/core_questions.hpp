// The questions of a core that has count and next, against software (rays/trace/mesh_crossings.hpp): each ray asks for
// its nearest hit and for any, counts its crossings, and walks through all of them, one after the other.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "rays/mesh/ray.hpp"
#include "rays/world/int_scene.hpp"
#include "sim/core/core_bench.hpp"

namespace hitpipe::sim {

struct QuestionTrace {
  std::uint64_t rays = 0;
  std::uint64_t crossings = 0;  ///< of all rays, in software
  std::uint64_t ties = 0;       ///< hits at an edge or a corner, which count or do not
  std::uint64_t nearests = 0;   ///< answers to nearest
  std::uint64_t anys = 0;       ///< answers to any
  std::uint64_t counts = 0;     ///< answers to count
  std::uint64_t nexts = 0;      ///< answers to next
  std::uint64_t wrong = 0;      ///< answers that are not software's
  std::uint64_t outside = 0;    ///< counts of rays without an end that begin outside of a closed mesh
  std::uint64_t odd = 0;        ///< those of them that are odd

  [[nodiscard]] bool right() const { return wrong == 0 && odd == 0; }
  QuestionTrace& operator+=(const QuestionTrace& later);
  friend bool operator==(const QuestionTrace&, const QuestionTrace&) = default;
};

struct QuestionOptions {
  bool count_alone = false;  ///< else each ray is asked all questions
  /// The mesh is (ref::Closedness::even), so that counts of rays from outside are judged without the rule of ties.
  bool closed = false;
  std::function<void(double)> progress{};  ///< gets the share of the counts that are done
};

/// The bench has a core with questions, and an image of the scene. A ray walks by next from (0, 0), and
/// then from (T, number + 1) of each answer, until there is none, or a wrong one.
[[nodiscard]] QuestionTrace trace_questions(CoreBench& bench, const ref::IntScene& scene,
                                            std::span<const ref::Ray> rays,
                                            const QuestionOptions& options = {});

}  // namespace hitpipe::sim
