// A unit as `hitpipe fit` or `hitpipe rtl` wrote it to a folder: its Verilog, edited or not, and what its
// manifest demands of rays and boxes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"

namespace hitpipe::sim {

struct WrittenUnit {
  rtl::Format format;
  rtl::Demands demands;          ///< none of a whole unit
  std::vector<rtl::Port> ports;  ///< of the whole design
  rtl::Pipeline pipeline;        ///< what is left of it
  std::string verilog;

  /// The axes whose low bits the demands say are 0.
  [[nodiscard]] ref::CoarseAxes coarse() const;
  /// Unless the demands say that no ray has one.
  [[nodiscard]] bool ends() const;
};

/// Reads NAME.json and NAME.v. Throws std::runtime_error or std::invalid_argument, one line: a file that is
/// missing or damaged, of another design or library.
[[nodiscard]] WrittenUnit read_unit(const std::filesystem::path& folder, const rtl::Design& design,
                                    const rtl::Library& library);

}  // namespace hitpipe::sim
