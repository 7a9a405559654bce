// The schematic of a pipeline as Graphviz text, stage by stage, with the thesis's symbols (section 7.3) and
// the axes from top to bottom. docs/designs.md lists the symbols.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"
#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/pipeline.hpp"

namespace hitpipe::rtl {

/// Stages first..last.
struct StageRange {
  int first;
  int last;
};

/// A group starts at each stage in which some component starts, as in the thesis's figures: 1-7, 8-12, 13.
[[nodiscard]] std::vector<StageRange> stage_groups(const Pipeline& pipeline);

/// One group. A value that comes from an earlier stage stands by its name at each of its readers. Its axes
/// come from `ports`, the design's.
[[nodiscard]] std::string to_dot(const Pipeline& pipeline, const std::vector<Port>& ports,
                                 const std::string& title, StageRange range);

/// A place for every node: 1 for x, 2 for y, 3 for z, as the operands' axes say, and 4 for what has no axis.
/// A value has the mean of its operands' places. Operands without an axis count only where no other has one.
/// `ports` are the design's; the graph may have lost some.
[[nodiscard]] std::vector<double> axis_order(const Graph& graph, const std::vector<Port>& ports);

}  // namespace hitpipe::rtl
