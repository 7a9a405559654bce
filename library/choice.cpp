#include "library/choice.hpp"

namespace hitpipe::library {

Choice chosen(const char* design_name, const char* format_text) {
  const char* const name = &given(design_name, "design");
  const rtl::Design& design = *or_refuse(HITPIPE_BAD_DESIGN, [&] { return &rtl::find_design(name); });
  if (format_text == nullptr || *format_text == '\0') return {&design, design.default_format};
  return {&design, or_refuse(HITPIPE_BAD_FORMAT, [&] { return design.parse_format(format_text); })};
}

}  // namespace hitpipe::library
