// What prune() left out of a graph, by which pass, and for which demands.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// Of a canonical graph.
struct Size {
  int nodes = 0;                          ///< components and gates
  int bits = 0;                           ///< of their results, and bits of ports that are read
  std::map<std::string, int> components;  ///< "int_subtract_24", as in the manifest

  friend bool operator==(const Size&, const Size&) = default;
};
[[nodiscard]] Size size_of(const Graph& graph);

/// A port, component or gate that is gone or narrower.
struct Cut {
  std::string name;  ///< from the C++, or made of the name of what reads it
  std::string kind;  ///< "port", "int_subtract", "and"
  int bits_before = 0;
  int bits_after = 0;                  ///< 0: gone
  std::string pass;                    ///< that made it so
  std::vector<std::string> demands{};  ///< without any one of which more of it would be left; empty: each
                                       ///< could do without the others, or none is needed
};

/// What a demand saves beyond all the others.
struct Share {
  std::string demand;
  int nodes = 0;
  int bits = 0;
};

/// A port that is narrower than before, or (0 bits) gone.
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

/// A line each: "d0_x: int_subtract 24 -> 9 bits (narrow; irx in [-5, 5])".
[[nodiscard]] std::string cut_text(const Cut& cut);

/// The values of a graph that a report speaks of, by name: ports with the bits read, components and gates
/// with their width (a multiplier with its wider operand's).
struct Named {
  std::string kind;
  int bits;
};
[[nodiscard]] std::map<std::string, Named> named_values(const Graph& graph);

/// A graph whose components and gates all have names, each its own.
[[nodiscard]] Graph with_names(const Graph& graph);

}  // namespace hitpipe::rtl
