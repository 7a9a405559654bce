#include "sim/fit/fit.hpp"

namespace hitpipe::sim {

rtl::EmittedDesign fitted_files(const FittedUnit& unit, const rtl::Library& library) {
  const rtl::PrunedFrom from{unit.ports, unit.demands, unit.report};
  return rtl::emit(*unit.design, unit.format, library, unit.pipeline,
                   {.pruned_from = unit.demands.empty() ? nullptr : &from});
}

}  // namespace hitpipe::sim
