// A ray along +x from the origin meets the box [100, 200] x [-1, 1] x [-1, 1] at 20/24, and not when it is
// moved aside. What tops for high-level synthesis share is installed too.
#include <hls/num/domain.hpp>
#include <hls/pipelines/int_slabs.hpp>
#include <hls/top/csim.hpp>

namespace hls = hitpipe::hls;
using Format = hls::IntFormat<20, 24>;
using Operands = hls::IntSlabs::Operands<hls::Native, Format>;

constexpr Operands aimed_at(int ymin, int ymax) {
  Operands in;
  in.irx = in.iry = in.irz = 0;
  in.irlen = 0;
  in.rinf = 1;
  // Direction (1, 2^-8, 2^-8): the largest IRDVCs belong to the smallest components.
  constexpr int largest = (1 << 19) - 1;
  in.iri_floor = largest >> 8;
  in.iri_ceil = (largest >> 8) + 1;
  in.irj_floor = in.irj_ceil = largest;
  in.irk_floor = in.irk_ceil = largest;
  in.ixmin = 100;
  in.ixmax = 200;
  in.iymin = ymin;
  in.iymax = ymax;
  in.izmin = -1;
  in.izmax = 1;
  return in;
}

int main() {
  const bool hit = hls::IntSlabs::test(Format(), aimed_at(-1, 1)).hit.to_bool();
  const bool miss = hls::IntSlabs::test(Format(), aimed_at(50, 60)).hit.to_bool();
  std::mt19937_64 random(1);
  const bool drawn = hls::top::random_operands<hls::IntSlabs, Format>(random).size() == 17;
  return hit && !miss && drawn ? 0 : 1;
}
