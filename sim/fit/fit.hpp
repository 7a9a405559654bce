// The smallest unit of a design for a scene: fewer bits, then pruned by what the scene demands. What each cut
// saves is its own share: how much larger the unit would be without it alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "area_model/price.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "sim/fit/port_demands.hpp"
#include "sim/fit/precision.hpp"

namespace hitpipe::sim {

/// One thing that is left out, why, and the area that it would take.
struct LeftOut {
  std::string what;
  std::string why;
  std::int64_t area_um2 = 0;
};

struct FittedUnit {
  const rtl::Design* design;
  rtl::Format before;
  rtl::Format format;
  std::optional<Precision> precision;  ///< when it was searched for and found
  area::Price price_before;            ///< account built, of the whole design at `before`
  area::Price price;
  rtl::Demands demands;
  std::vector<rtl::Port> ports;  ///< the design's at `format`, in the order of the set-up's operands
  rtl::PruneReport report;
  rtl::Pipeline pipeline;
  std::vector<LeftOut> left_out;

  [[nodiscard]] std::int64_t saved_um2() const { return price_before.area_um2 - price.area_um2; }
  [[nodiscard]] bool ends() const { return !precision || precision->ends; }
  [[nodiscard]] ref::CoarseAxes coarse() const { return precision ? precision->coarse : ref::CoarseAxes{}; }
};

/// At `precision`, or at `before`.
[[nodiscard]] FittedUnit fit(const rtl::Design& design, const rtl::Format& before,
                             const std::optional<Precision>& precision, const ref::SceneDemands& scene,
                             const rtl::Library& library);

/// The files of the fitted unit: Verilog with a check block, a module that checks operands as they come from
/// the set-up, a manifest that lists the demands, and vectors that meet them. A unit without demands has the
/// files of the whole design.
[[nodiscard]] rtl::EmittedDesign fitted_files(const FittedUnit& unit, const rtl::Library& library);

/// Of a node whose boxes are stored as the design reads them, on coarser axes without their low bits.
[[nodiscard]] std::size_t bytes_per_node(const rtl::Design& design, const rtl::Format& format,
                                         const ref::CoarseAxes& coarse = {});

}  // namespace hitpipe::sim
