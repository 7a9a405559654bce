// What other files say of the base core.
#pragma once

#include <vector>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/axi_plan.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::base {

void axi(AxiPlan& plan);
[[nodiscard]] CoreRecords records(const Core& core);
[[nodiscard]] std::vector<Promise> promises();

}  // namespace hitpipe::rtl::features::base
