// Faults of a datapath: its traced graph is copied, a fault replaces some nodes, and the copy is evaluated.
#pragma once

#include <memory>
#include <span>

#include "rtl_gen/graph/graph.hpp"
#include "sim/check/box_test.hpp"

namespace hitpipe::sim {

/// What replaces `node` in the faulty graph `to`; rtl::no_node keeps the node. `args` are its operands there.
using GraphFault = rtl::NodeId (*)(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);

/// The design with a fault in its datapath. Throws std::logic_error if the fault changes nothing.
[[nodiscard]] std::unique_ptr<BoxTest> mutated_datapath(const rtl::Design& design, const rtl::Format& format,
                                                        GraphFault fault);

// Slabs.
/// The near distance of x is a product with the IRDVC's ceiling, whatever sign the difference has.
rtl::NodeId near_floor_dropped(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);
rtl::NodeId near_operands_swapped(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);
/// The far distance of y is a distance to the near plane.
rtl::NodeId far_from_the_near_plane(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);

// Pluecker.
rtl::NodeId edge_bound_off_by_one(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);
/// p - q has t bits.
rtl::NodeId side_bit_dropped(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);
/// A plane of edge 0 is the other plane of its axis.
rtl::NodeId edge_planes_swapped(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);
/// The ray's end is compared with the far plane of z.
rtl::NodeId last_plane_for_the_first(rtl::Graph& to, const rtl::Node& node,
                                     std::span<const rtl::NodeId> args);

// No fault: a node is made again.
rtl::NodeId made_again(rtl::Graph& to, const rtl::Node& node, std::span<const rtl::NodeId> args);

}  // namespace hitpipe::sim
