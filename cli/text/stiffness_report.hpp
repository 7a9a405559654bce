// What a stiffness report prints: rows for CSV and JSON, tables of 80 columns.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/check/stiffness.hpp"

namespace hitpipe::cli {

struct Measured {
  Format format;
  std::vector<sim::StiffBoxes> boxes;
  std::vector<sim::StiffBoxes> all_boxes;
  std::vector<sim::StiffTraversals> traversals;  ///< empty without a scene
};

struct MeasuredDesign {
  const rtl::Design* design;
  std::vector<Measured> formats;
};

/// A row for each kind of box, and one for the scene if one was traversed. log2_ratio is "inf" where a
/// component is zero.
[[nodiscard]] std::vector<Row> stiffness_rows(const std::vector<MeasuredDesign>& designs,
                                              const std::string& scene);

/// Tables for each design, and for the scene, with a row for each ratio and a column for each format; the
/// number of samples below.
[[nodiscard]] std::string stiffness_text(const std::vector<MeasuredDesign>& designs,
                                         const std::string& scene);

/// False misses and other triangles of conservative designs. There must be none.
[[nodiscard]] std::uint64_t wrong_answers(const std::vector<MeasuredDesign>& designs);

}  // namespace hitpipe::cli
