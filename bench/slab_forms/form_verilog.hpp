// The distance of one plane, in each way of hls/experiment/slab_forms.hpp, as a Verilog module.
#pragma once

#include <string>
#include <string_view>

#include "hls/box/any_fp_format.hpp"

namespace hitpipe::bench {

/// The file of a unit that calls the module unit_distance, which is divided into so many stages as a float
/// operator is. `form` is "plain", "exact", "short_product", "fused", "separate" or "separate_fused".
/// Throws std::invalid_argument for another one.
[[nodiscard]] std::string form_verilog(std::string_view form, const hls::AnyFpBits& bits, int stages);

}  // namespace hitpipe::bench
