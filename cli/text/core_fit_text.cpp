#include "cli/text/core_fit_text.hpp"

#include <algorithm>

#include "area_model/figure.hpp"
#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::cli {

Row core_row(const rtl::CoreOptions& core, const area::CorePartPrice& price, const sim::CoreRate& rate,
             const rtl::Library& library) {
  Row row{{"bits", rtl::to_string(rtl::Format(core.bits))},
          {"rays_in_flight", core.rays},
          {"triangle_ii", core.serial() ? Row("serial") : Row(core.triangle_interval)},
          {"stack", 1 << core.stack_bits},
          {"cache_kib", core.cache_kib},
          {"levels", core.levels},
          {"block_bits", core.address_bits},
          {"address_bits", core.byte_bits},
          {"tag_bits", core.tag_bits},
          {"number_bits", core.number_bits},
          {"leaf_bits", core.leaf_bits},
          {"step_bits", core.step_bits}};
  if (library.chip() == nullptr) {
    row["area_mm2"] = area::area_mm2(price.area_um2);
  } else {
    row["lut"] = price.taken.luts;
    row["ff"] = price.taken.registers;
    row["dsp"] = price.taken.blocks;
  }
  row["memory_bits"] = price.memory_bits;
  row["clock_ps"] = rate.clock_ps;
  row["cycles_a_ray"] = *std::max_element(rate.cycles_a_ray.begin(), rate.cycles_a_ray.end());
  row["mrays_s"] = rate.rays_per_second() / 1e6;
  return row;
}

}  // namespace hitpipe::cli
