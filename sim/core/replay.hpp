// An answer that somebody recorded, judged by the definition of the integer world (docs/integer_world.md): the exact
// test of each triangle, the least T, and of equal T the lowest number. It does not matter what answered: a board,
// firmware, or another tracer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hls/machines/failure.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_scene.hpp"
#include "sim/operands/ray_list.hpp"

namespace hitpipe::sim {

/// What was recorded of one ray.
struct RecordedAnswer {
  bool given = true;                        ///< false: there is no answer
  hls::Failure failed = hls::not_failed;    ///< why there is none, if it was recorded
  std::optional<std::uint32_t> triangle{};  ///< its number; nothing: the answer is that there is no hit
  std::optional<std::int64_t> t{};          ///< of the hit; nothing: it was not recorded
};

/// T is the recorded one, or without it that of the recorded triangle. The right T is that of the definition.
enum class Verdict : std::uint8_t {
  same,       ///< no hit and right; or the right triangle and T; or for any hit a triangle that the ray meets
  exact_tie,  ///< another triangle, which the ray meets at exactly the right distance, before T is rounded down
  near_tie,  ///< another triangle, with the right T, at another distance
  nearer,    ///< T is less than the right one, or there is a hit and none is right
  farther,   ///< T is more than the right one, or there is no hit and one is right
  failed,    ///< there is no answer, or one that no ray can have; Judgement::reason says why
};
inline constexpr std::array<std::string_view, 6> verdict_names{"same",   "exact tie", "near tie",
                                                               "nearer", "farther",   "failed"};

struct Judgement {
  Verdict verdict = Verdict::same;
  std::string_view reason{};  ///< of `failed`; it is a sentence

  /// An exact tie is another rule for which of two equal hits counts, and nothing is lost by it.
  [[nodiscard]] bool good() const { return verdict == Verdict::same || verdict == Verdict::exact_tie; }
  friend bool operator==(const Judgement&, const Judgement&) = default;
};

/// What the definition says of a ray.
struct RightAnswer {
  std::optional<std::uint32_t> triangle{};  ///< its number; nothing: no hit
  std::int64_t t = 0;                       ///< of the hit
};

/// `right` is that of the nearest hit, whatever the query. T of an answer to Query::any is not judged: a core does not
/// promise one. Answers that name a triangle which the scene lacks, or which the ray does not meet at T, are failed
/// where T is right, where it is not known, and for any hit.
[[nodiscard]] Judgement judge(const ref::IntScene& scene, const ref::IntRay& ray, ref::Query query,
                              const RecordedAnswer& recorded, const RightAnswer& right);

/// By ray, of the nearest hit, through a hierarchy that is built here and with exact boxes. So they do not depend on the
/// hierarchy of an image. Triangles have their numbers in the source of the mesh, which has a triangle. `progress`
/// gets the finished share from any thread.
[[nodiscard]] std::vector<RightAnswer> right_answers(
    const ref::IntScene& scene, std::span<const AskedRay> rays, int threads,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace hitpipe::sim
