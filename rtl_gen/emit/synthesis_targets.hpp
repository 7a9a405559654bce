// The targets of a FuseSoC core that synthesise it. The component library names them, since it is of a chip.
#pragma once

#include <string>
#include <string_view>

#include "rtl_gen/component/library.hpp"

namespace hitpipe::rtl {

/// Lines of the section `targets`; empty for a library that names none. `filesets` is a list in YAML.
[[nodiscard]] std::string synthesis_targets(const Library& library, std::string_view filesets,
                                            std::string_view top);

}  // namespace hitpipe::rtl
