// Where values are latched: for every value and every stage boundary it crosses, exactly the bits that are
// read later. A wire is never latched: it is taken as late as its source is live (a sign bit is not latched
// beside its word).
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/schedule.hpp"

namespace hitpipe::rtl {

/// A run of adjacent bits of one value, latched at the end of one stage (boundary 0: the input latches).
struct Register {
  NodeId value;
  int boundary;
  int high;
  int low;

  [[nodiscard]] int width() const { return high - low + 1; }
};

enum class Ports {
  latched,  ///< inputs are latched first, outputs last: a whole pipeline
  direct,   ///< inputs are there in stage 1, outputs leave the last stage unlatched: a component inside one
};

struct Placement {
  std::vector<Register> registers;       ///< by boundary, then by value, then from the low bits up
  std::vector<std::uint64_t> used_bits;  ///< by node: bits of its own, unlatched value that anything reads
};

[[nodiscard]] Placement place_registers(const Graph& graph, const Schedule& schedule, Ports ports);

}  // namespace hitpipe::rtl
