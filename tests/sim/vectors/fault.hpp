// Faults to plant in a graph: one node gives what a slip of the pen would make of it, a comparison of the
// wrong kind, arms exchanged, a bit too few, a sign that is not read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rtl_gen/graph/graph_lanes.hpp"

namespace hitpipe::sim {

/// A node with the values of its operands and the value that it should have. The rest of a wrong value above
/// the node's width is cut off.
struct Site {
  const rtl::Node& node;
  rtl::Word a, b, c;
  int width_a, width_b;
  rtl::Word right;
  int bit;  ///< of a fault in one bit of an input
};

struct Fault {
  rtl::NodeId node;
  const char* what;
  rtl::Word (*wrong)(const Site& site);
  int bit = 0;
};

/// Every fault that each node can have, but none that is none: of equal operands it does not matter which is
/// chosen, a word widened by zeros has no sign, and the sign of a float's zero may be read by nobody.
[[nodiscard]] std::vector<Fault> faults_of(const rtl::Graph& graph);

/// What each node is called. One without a name has the name of the next node with a name, and its number
/// among the nodes of its kind that lead there: of two xors of s_far_b the second is "2 of s_far_b".
[[nodiscard]] std::vector<std::string> node_names(const rtl::Graph& graph);
/// "cmp apart: as <=", "input irx bit 3: always 1", "xor 2 of s_far_b: as |".
[[nodiscard]] std::string to_text(const rtl::Graph& graph, const std::vector<std::string>& names,
                                  const Fault& fault);

}  // namespace hitpipe::sim
