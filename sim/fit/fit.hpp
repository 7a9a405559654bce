// Makes the smallest unit of a design for a scene: it has fewer bits and is pruned by what the scene demands.
// The area that a cut saves is how much larger the unit would be without this one cut.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "area_model/price.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/emit/unit.hpp"
#include "sim/fit/port_demands.hpp"
#include "sim/fit/precision.hpp"

namespace hitpipe::sim {

/// One thing that is left out, why it is not needed, and the area that it would take.
struct LeftOut {
  std::string what;
  std::string why;
  std::int64_t area_um2 = 0;
};

/// How often a fitted unit takes a test.
struct FitRate {
  int interval = 1;  ///< it may begin a test every so many cycles
  /// If positive, the interval is that of the smallest unit that takes so many boxes a second.
  double boxes_per_second = 0;
};

/// A unit without demands is the whole design at another format.
struct FittedUnit : rtl::Unit {
  Format before;
  std::optional<Precision> precision;  ///< only when it was searched for and found
  area::Price price_before;            ///< of the whole design at `before`, account `built`
  area::Price price;
  std::vector<LeftOut> left_out;

  [[nodiscard]] std::int64_t saved_um2() const { return price_before.area_um2 - price.area_um2; }
};

/// Made at the format of `precision`, or at `before` if there is no precision. Throws std::runtime_error, one
/// line, for a rate that a unit with a test in each cycle does not reach.
[[nodiscard]] FittedUnit fit(const rtl::Design& design, const Format& before,
                             const std::optional<Precision>& precision, const ref::SceneDemands& scene,
                             const rtl::Library& library, const FitRate& rate = {});

/// The price of the unit that fit() makes, or with an interval a little more. Nothing when no unit reaches
/// the rate.
[[nodiscard]] std::optional<area::Price> price_of_fit(const rtl::Design& design, const Precision& precision,
                                                      const ref::SceneDemands& scene,
                                                      const rtl::Library& library, const FitRate& rate = {});

}  // namespace hitpipe::sim
