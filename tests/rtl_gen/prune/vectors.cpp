// At least 10^6 random vectors for each design, spread over its demand sets, of the fitted graph against the
// unfitted C++: prune_vectors [VECTORS PER DESIGN]. The target prune_vectors runs it; the tests run fewer.
#include <cstdlib>
#include <exception>

#include <fmt/format.h>

#include "tests/rtl_gen/prune/compare.hpp"

namespace {

using namespace hitpipe;

bool run(const char* name, rtl::Format format, std::size_t vectors) {
  const rtl::Design& design = rtl::find_design(name);
  const std::vector<rtl::DemandSet> sets = rtl::demand_sets(design, format);
  rtl::Seeded random(1907);
  std::size_t compared = 0;
  for (const rtl::DemandSet& set : sets) {
    const rtl::Pruned pruned = rtl::prune(design.trace(format), set.demands, {.shares = false});
    const rtl::Comparison found =
        rtl::compare(design, format, set.demands, pruned.graph, vectors / sets.size() + 1, random);
    compared += found.vectors;
    fmt::print("{} {}, {}: {} vectors, {} hits\n", name, to_string(format), set.name, found.vectors,
               found.hits);
    if (!found.mismatch.empty()) {
      fmt::print("{}\n", found.mismatch);
      return false;
    }
  }
  fmt::print("{} {}: {} vectors agree\n", name, to_string(format), compared);
  return compared >= vectors;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::size_t vectors = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
    bool all = true;
    for (const char* const name : {"int_slabs", "int_plucker"}) {
      all = run(name, rtl::Format(hls::IntBits{24, 24}), vectors) && all;
      all = run(name, rtl::Format(hls::IntBits{20, 24}), vectors) && all;
    }
    for (const char* const name : {"fp_slabs", "fp_plucker"})
      all = run(name, rtl::Format(hls::Binary32{}), vectors) && all;
    return all ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 1;
  }
}
