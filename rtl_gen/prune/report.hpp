// What prune() left out of a graph, in which pass and for which demands.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// The size of a canonical graph.
struct Size {
  int nodes = 0;                          ///< components and gates
  int bits = 0;                           ///< bits of their results, and of ports that are read
  std::map<std::string, int> components;  ///< "int_subtract_24", as in the manifest

  friend bool operator==(const Size&, const Size&) = default;
};
[[nodiscard]] Size size_of(const Graph& graph);

/// A port, component or gate that is gone or narrower.
struct Cut {
  std::string name;  ///< from the C++, or made of its reader's name
  std::string kind;  ///< "port", "int_subtract", "and"
  int bits_before = 0;
  int bits_after = 0;  ///< 0: gone
  std::string pass;    ///< the pass that removed or narrowed it
  /// Each of these is needed: if one is left out, more of the value stays. Empty when no single demand is
  /// needed.
  std::vector<std::string> demands{};
};

/// What one demand saves beyond all the others.
struct Share {
  std::string demand;
  int nodes = 0;
  int bits = 0;
};

/// A port that is narrower than before, or gone (0 bits).
struct PortChange {
  std::string port;
  int bits_before = 0;
  int bits_after = 0;
};

struct PruneReport {
  Size before, after;
  std::vector<Cut> cuts{};
  std::vector<Share> shares{};
  std::vector<PortChange> ports{};

  [[nodiscard]] std::vector<std::string> dropped_ports() const;
};

/// "d0_x: int_subtract 24 -> 9 bits (narrow; irx in [-5, 5])".
[[nodiscard]] std::string cut_text(const Cut& cut);

/// The values of a graph that a report lists, by name. Ports have the number of bits read; components and
/// gates have their width, a multiplier has the width of its wider operand.
struct Named {
  std::string kind;
  int bits;
};
[[nodiscard]] std::map<std::string, Named> named_values(const Graph& graph);

/// The graph with a name of its own for every component and gate.
[[nodiscard]] Graph with_names(const Graph& graph);

}  // namespace hitpipe::rtl
