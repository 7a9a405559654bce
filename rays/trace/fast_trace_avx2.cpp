// The fast tracer's loop with vectors of eight. On x86 this source is compiled for AVX2, without fused
// multiply-add: boxes and filters are proven with two roundings.
#include "rays/trace/fast_walk.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace hitpipe::ref {

#ifdef __AVX2__
namespace {

// These types are this source's own, so are the functions made from them.
struct EightLanes {
  using Floats = float __attribute__((vector_size(32)));
  using Mask = std::int32_t __attribute__((vector_size(32)));
  static constexpr std::size_t count = 8;

  static unsigned bits(const Mask& holds) {
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(holds)));
  }
};
struct FourOfAvx : FourLanes {};

}  // namespace

const FastTraces<8>* fast_traces_of_eight() {
  return __builtin_cpu_supports("avx2") ? &fast_traces<EightLanes, FourOfAvx, 8> : nullptr;
}
#else
const FastTraces<8>* fast_traces_of_eight() {
  return nullptr;
}
#endif

}  // namespace hitpipe::ref
