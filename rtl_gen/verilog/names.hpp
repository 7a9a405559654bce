// Names in the emitted files: of values, registers and modules, and the words that cannot be names.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl {

/// One range that holds all bits of a value that anything reads.
struct BitSpan {
  int high = 0;
  int low = 0;
  [[nodiscard]] int width() const { return high - low + 1; }
};
[[nodiscard]] BitSpan used_span(const Graph& graph, const Placement& placement, NodeId value);

struct ValueName {
  std::string name;
  SourceLine source{};  ///< line 0: unknown
  bool is_own = false;  ///< false: the C++ gives the name and the line to a value that is made of this one
};

/// A name for every input, component and gate; wires and constants have none. Names are unique, and none is
/// a Verilog keyword. A value has its name from the C++. Where the C++ names only a part of it (a trimmed
/// product) and nothing else of it is used, it takes the name of the smallest such part. Where the C++ names
/// nothing, the name says for what the value is and which operation makes it. It is for the next named values
/// that read it; of several names it takes the words that they share, or the graph's name.
[[nodiscard]] std::vector<ValueName> value_names(const Graph& graph, const Placement& placement,
                                                 std::set<std::string> taken);

/// The words that all names share, in the order of the first, joined by underscores; may be empty.
[[nodiscard]] std::string shared_name(const std::vector<std::string>& names);

/// Of Verilog (IEEE 1364-2001) and of SystemVerilog (IEEE 1800-2012): some tools read every design as
/// SystemVerilog.
[[nodiscard]] const std::set<std::string>& verilog_keywords();
/// Of C++20.
[[nodiscard]] const std::set<std::string>& cpp_keywords();

/// The name also begins the names of files, of other modules, of C++ functions and of what Verilator makes.
/// It has letters, digits and single underscores, begins with a letter, and is no keyword of Verilog,
/// SystemVerilog or C++. Throws std::runtime_error, one line, for any other.
void check_module_name(const std::string& name);

}  // namespace hitpipe::rtl
