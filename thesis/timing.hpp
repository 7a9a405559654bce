// The experiment of section 3.5: every variant, in both precisions, on workloads of 0, 50 and 100 % hits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hitpipe::thesis {

struct BoxTestTiming {
  std::string_view variant;  ///< as BoxTestVariant::name
  int precision_bits;        ///< 32: Table 3.1, 64: Table 3.2
  int hit_percent;
  std::uint64_t tests;
  double seconds;  ///< processor time of this process; other work on the machine hardly matters
};

/// Tests `pairs` pairs `repeats` times on one thread; the thesis has 500,000 and 100. The results are ordered
/// by precision, then hit share, then variant. Throws std::logic_error if a variant's number of hits is not
/// the workload's.
[[nodiscard]] std::vector<BoxTestTiming> time_box_tests(std::size_t pairs, int repeats,
                                                        std::uint64_t seed = 2007);

}  // namespace hitpipe::thesis
