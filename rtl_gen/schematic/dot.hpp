// The schematic of a pipeline as Graphviz text, stage by stage, with the thesis's symbols (section 7.3):
//   "-" subtract   "x" multiply   "<>" compare   "2:1" multiplexer   "L:24" a 24-bit latch   a bubble inverts
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/pipeline.hpp"

namespace hitpipe::rtl {

[[nodiscard]] std::string to_dot(const Pipeline& pipeline, const std::string& title);

/// Stages first..last.
struct StageRange {
  int first;
  int last;
};

/// A group starts at each stage in which some component starts, as in the thesis's figures: 1-7, 8-12, 13.
[[nodiscard]] std::vector<StageRange> stage_groups(const Pipeline& pipeline);

/// One group, to compare with a figure of the thesis. A value that comes from an earlier stage stands by its
/// name at each of its readers.
[[nodiscard]] std::string to_dot(const Pipeline& pipeline, const std::string& title, StageRange range);

}  // namespace hitpipe::rtl
