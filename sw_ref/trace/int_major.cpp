#include "sw_ref/trace/int_major.hpp"

namespace hitpipe::ref {

MajorDistances::MajorDistances(const IntMajorRaySetup& set_up, hls::MajorBits bits)
    : set_up_(set_up),
      finer_(bits.finer),
      fraction_(bits.fraction),
      mantissa_(bits.mantissa - 1),
      least_(-(std::int64_t{1} << (bits.point() - 1))),
      most_(-least_ - 1) {
  const IntMajorRay& prepared = set_up_.ray();
  for (std::size_t slot = 0; slot < 3; ++slot) {
    slots_[slot] = {static_cast<std::size_t>(prepared.axes[slot]),
                    prepared.backward[slot] ? -1 : 0,
                    prepared.origin[slot],
                    1,
                    1,
                    0};
    if (slot == 0) continue;
    const MajorQuotient& quotient = prepared.quotient[slot - 1];
    slots_[slot].floor = quotient.mantissa_low;
    slots_[slot].ceil = quotient.mantissa_high;
    slots_[slot].exponent = quotient.exponent;
  }
}

}  // namespace hitpipe::ref
