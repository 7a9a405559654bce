#pragma once

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/axi_plan.hpp"

namespace hitpipe::rtl::features::base {

void axi(AxiPlan& plan);
[[nodiscard]] CoreRecords records(const Core& core);

}  // namespace hitpipe::rtl::features::base
