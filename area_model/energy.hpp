// What a test costs in energy, by the toggles of the unit's own values: the clock of its registers, and the
// area of components for the share of their operands' bits that change. A component that operations share
// costs more, for the multiplexers before it. The constants are fitted to netlists of OSU cells that OpenSTA
// has priced (docs/chips.md, "Energy of a box"), so the result is an estimate for those cells. It says how
// units compare.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"

namespace hitpipe::area {

/// What a test does to a unit, on average.
struct Toggles {
  double register_bits = 0;  ///< the clock reaches each in each cycle
  double pipelined_um2 = 0;  ///< area of components with stages, which have registers of their own
  double logic_um2 = 0;      ///< area of components, each times the share of its operands' bits that change
  double shared_um2 = 0;     ///< the same of components that operations share
};

/// `tests` are the operands of consecutive tests, in port order: at least two. The library says areas.
/// Throws std::invalid_argument for fewer, and as rtl::Library::area() does.
[[nodiscard]] Toggles toggles_of(const rtl::Pipeline& pipeline, const rtl::Library& library,
                                 std::span<const std::vector<std::int64_t>> tests);

/// In pJ, of a test that has so many cycles for itself: the interval of a full unit, more if it is not full.
[[nodiscard]] double energy_pj(const Toggles& toggles, double cycles_per_test);

}  // namespace hitpipe::area
