// The schematic of a pipeline, stage by stage, as Graphviz text: the symbols are the thesis's (section 7.3).
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

/// The pipeline cut where components begin their work, as the thesis cuts its figures: 1-7, 8-12, 13.
[[nodiscard]] std::vector<StageRange> stage_groups(const Pipeline& pipeline);

/// One group, to be laid beside a figure: what comes into it stands by its name wherever it is read.
[[nodiscard]] std::string to_dot(const Pipeline& pipeline, const std::string& title, StageRange range);

}  // namespace hitpipe::rtl
