// A design for tools of high-level synthesis: a top function with an argument for each port, written from the
// ports that the design states, and what the tools need to simulate and synthesise it.
#pragma once

#include <string>
#include <vector>

#include "host/files.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

struct HlsTop {
  host::File header;                ///< <module>.hpp
  host::File source;                ///< <module>.cpp
  host::File csim;                  ///< <module>_csim.cpp: a program that replays vectors through the top
  std::vector<host::File> scripts;  ///< for Vitis HLS, the unified Vitis compiler, Catapult and Bambu

  [[nodiscard]] std::vector<host::File> files() const;
};

/// The tools are told that a test may begin every `interval` cycles, 1 to 64. Throws std::runtime_error, one
/// line, when the design does not say where its C++ is.
[[nodiscard]] HlsTop hls_top(const Design& design, const Format& format, const std::string& module,
                             int interval = 1);
/// "hitpipe_int_slabs"
[[nodiscard]] std::string hls_function(const std::string& module);

}  // namespace hitpipe::rtl
