#include "sim/core/ray_fields.hpp"

#include <bit>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <vector>

#include "rays/world/int_ray.hpp"
#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

using rtl::Word;

std::vector<Word> ray_fields(const rtl::Core& core, const CoreJob& job) {
  const auto flag = [](bool is) -> Word { return is ? 1 : 0; };
  std::vector<Word> fields{flag(job.any)};
  if (has_questions(core))
    for (const Word of_question : {flag(job.once), static_cast<Word>(job.from_t), Word{job.from_number}})
      fields.push_back(of_question);
  if (!core.place_of(hls::channels::ray_error)) {
    for (const glm::vec3& vector : {job.ray.origin, job.ray.direction})
      for (int axis = 0; axis < 3; ++axis) fields.push_back(std::bit_cast<std::uint32_t>(vector[axis]));
    const float length = job.none ? std::numeric_limits<float>::quiet_NaN() : job.ray.length;
    fields.push_back(std::bit_cast<std::uint32_t>(length));
    return fields;
  }
  const hls::RayBits& bits = core.options.bits;
  const ref::IntRay ray = ref::int_ray(job.ray, bits.world());
  const ref::IntMajorRay box_ray = ref::major_ray(ray, bits.boxes());
  const auto m = static_cast<std::size_t>(box_ray.axes[0]), a = static_cast<std::size_t>(box_ray.axes[1]),
             b = static_cast<std::size_t>(box_ray.axes[2]);
  const auto origin = [&](std::size_t axis) {
    return static_cast<Word>(ray.origin[axis]) & rtl::ones_below(bits.point());
  };
  const auto slope = [&](std::size_t axis) { return static_cast<Word>(std::abs(ray.direction[axis])); };
  const ref::MajorQuotient &of_a = box_ray.quotient[0], &of_b = box_ray.quotient[1];
  for (const Word of_ray : std::initializer_list<Word>{
           flag(job.none), flag(m == 1), flag(m == 2), flag(ray.negative[m]), flag(ray.negative[a]),
           flag(ray.negative[b]), origin(m), origin(a), origin(b), slope(a), slope(b), of_a.mantissa_low,
           of_a.mantissa_high, static_cast<Word>(of_a.exponent), of_b.mantissa_low, of_b.mantissa_high,
           static_cast<Word>(of_b.exponent), static_cast<Word>(ray.length)})
    fields.push_back(of_ray);
  return fields;
}

}  // namespace hitpipe::sim
