// What tools of high-level synthesis need beside the C++ of a top function.
#pragma once

#include <string>
#include <vector>

#include "host/files.hpp"

namespace hitpipe::rtl {

/// Scripts for Vitis HLS (<module>_vitis_hls.tcl), for the unified Vitis compiler (<module>_hls.cfg) and for
/// Catapult (<module>_catapult.tcl). `title` is the design with its format. None of the tools was ever run on
/// them here.
[[nodiscard]] std::vector<host::File> hls_scripts(const std::string& title, const std::string& module);

}  // namespace hitpipe::rtl
