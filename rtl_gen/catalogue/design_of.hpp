// A pipeline of hls/pipelines as a design: its name, formats, operands and results as it states them, its
// graph and its host function from its one template.
#pragma once

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/catalogue/native.hpp"
#include "rtl_gen/catalogue/traced.hpp"

namespace hitpipe::rtl {

/// `name` is the struct's in hitpipe::hls. Without a name no top function for high-level synthesis can be
/// written. Throws as check_kind() does.
template <class Pipeline>
Design design_of(std::string_view name = {}) {
  using Bits = typename Pipeline::Bits;
  Design design{.name = Pipeline::name,
                .summary = Pipeline::summary,
                .kind = Pipeline::kind,
                .conservative = Pipeline::conservative,
                .default_format = Bits{},
                .results_at = [](const Format& format) { return results_of<Pipeline>(format.as<Bits>()); },
                .ports_at = [](const Format& format) { return ports_of<Pipeline>(format.as<Bits>()); },
                .trace_at = [](const Format& format) { return traced<Pipeline>(format.as<Bits>()); },
                .run_at = [](const Format& format) { return native_function<Pipeline>(format.as<Bits>()); },
                .float_unit_run_at =
                    [](const Format& format) { return float_unit_function<Pipeline>(format.as<Bits>()); },
                .source = {name, source_line(Pipeline::header, 0).file}};
  check_kind(design);
  return design;
}

}  // namespace hitpipe::rtl
