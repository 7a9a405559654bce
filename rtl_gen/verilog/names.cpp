#include "rtl_gen/verilog/names.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

/// The name of `value`, or of its nearest reader that the C++ names.
std::string name_downstream(const Graph& graph, NodeId value,
                            const std::vector<std::vector<NodeId>>& readers) {
  for (NodeId at = value;;) {
    if (!graph[at].name.empty()) return graph[at].name;
    if (readers[at].empty()) return graph.name();
    at = readers[at].front();
  }
}

}  // namespace

BitSpan used_span(const Graph& graph, const Placement& placement, NodeId value) {
  const std::uint64_t bits = placement.used_bits[value];
  if (bits == 0) return {graph[value].width - 1, 0};
  return {63 - std::countl_zero(bits), std::countr_zero(bits)};
}

std::vector<std::string> value_names(const Graph& graph, const Placement& placement,
                                     std::set<std::string> taken) {
  const std::set<std::string>& keywords = verilog_keywords();
  taken.insert(keywords.begin(), keywords.end());
  std::vector<std::string> part(graph.size());  // the C++'s name for exactly the used bits
  std::vector<std::vector<NodeId>> readers(graph.size());
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    for (const NodeId arg : n.operands()) readers[arg].push_back(id);
    if (n.op != Op::slice || n.name.empty()) continue;
    const BitSpan used = used_span(graph, placement, n.args[0]);
    if (used.low == n.low && used.width() == n.width) part[n.args[0]] = n.name;
  }
  std::vector<std::string> names(graph.size());
  const auto claim = [&](NodeId id, const std::string& wish) {
    std::string name = wish;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", wish, i);
    names[id] = name;
  };
  // Ports come first, as they must keep their names; then what the C++ names; then the rest.
  for (const NodeId id : graph.inputs()) claim(id, graph[id].name);
  for (const bool named : {true, false}) {
    for (NodeId id = 0; id < graph.size(); ++id) {
      const Node& n = graph[id];
      if (!is_root(n.op) || n.op == Op::input) continue;
      const std::string& own = n.name.empty() ? part[id] : n.name;
      if (own.empty() == named) continue;
      claim(id, named ? own : fmt::format("{}_{}", name_downstream(graph, id, readers), op_name(n.op)));
    }
  }
  return names;
}

namespace {

std::set<std::string> set_of(const char* words) {
  std::istringstream stream(words);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace

const std::set<std::string>& verilog_keywords() {
  static const std::set<std::string> words = set_of(
      "always and assign automatic begin buf bufif0 bufif1 case casex casez cell cmos config deassign "
      "default defparam design disable edge else end endcase endconfig endfunction endgenerate "
      "endmodule endprimitive endspecify endtable endtask event for force forever fork function "
      "generate genvar highz0 highz1 if ifnone incdir include initial inout input instance integer join "
      "large liblist library localparam macromodule medium module nand negedge nmos nor noshowcancelled "
      "not notif0 notif1 or output parameter pmos posedge primitive pull0 pull1 pulldown pullup "
      "pulsestyle_ondetect pulsestyle_onevent rcmos real realtime reg release repeat rnmos rpmos rtran "
      "rtranif0 rtranif1 scalared showcancelled signed small specify specparam strong0 strong1 supply0 "
      "supply1 table task time tran tranif0 tranif1 tri tri0 tri1 triand trior trireg unsigned use "
      "vectored wait wand weak0 weak1 while wire wor xnor xor accept_on alias always_comb always_ff "
      "always_latch assert assume before bind bins binsof bit break byte chandle checker class clocking "
      "const constraint context continue cover covergroup coverpoint cross dist do endchecker endclass "
      "endclocking endgroup endinterface endpackage endprogram endproperty endsequence enum eventually "
      "expect export extends extern final first_match foreach forkjoin global iff ignore_bins "
      "illegal_bins implements implies import inside int interconnect interface intersect join_any "
      "join_none let local logic longint matches modport nettype new nexttime null package packed "
      "priority program property protected pure rand randc randcase randsequence ref reject_on restrict "
      "return s_always s_eventually s_nexttime s_until s_until_with sequence shortint shortreal soft "
      "solve static string strong struct super sync_accept_on sync_reject_on tagged this throughout "
      "timeprecision timeunit type typedef union unique unique0 until until_with untyped uwire var "
      "virtual void wait_order weak wildcard with within");
  return words;
}

const std::set<std::string>& cpp_keywords() {
  static const std::set<std::string> words = set_of(
      "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t "
      "char32_t char8_t class co_await co_return co_yield compl concept const const_cast consteval "
      "constexpr constinit continue decltype default delete do double dynamic_cast else enum "
      "explicit export extern false float for friend goto if inline int long mutable namespace new "
      "noexcept not not_eq nullptr operator or or_eq private protected public register "
      "reinterpret_cast requires return short signed sizeof static static_assert static_cast "
      "struct switch template this thread_local throw true try typedef typeid typename union "
      "unsigned using virtual void volatile wchar_t while xor xor_eq");
  return words;
}

namespace {

// File names have at most 255 bytes, and the longest ending of ours has less than 100.
constexpr std::size_t longest = 128;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_spelled_well(const std::string& name) {
  const auto allowed = [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  // C++ and Verilator reserve two underscores in a row; an ending adds one.
  return !name.empty() && name.size() <= longest && is_letter(name.front()) && name.back() != '_' &&
         std::all_of(name.begin(), name.end(), allowed) && name.find("__") == std::string::npos;
}

}  // namespace

void check_module_name(const std::string& name) {
  if (!is_spelled_well(name))
    throw std::runtime_error(fmt::format(
        "name {}: allowed are letters, digits and single underscores between them, with a letter first, "
        "at most {} characters",
        name, longest));
  const bool verilog = verilog_keywords().contains(name);
  if (verilog || cpp_keywords().contains(name))
    throw std::runtime_error(
        fmt::format("name {}: is a keyword of {}; take another", name, verilog ? "Verilog" : "C++"));
}

}  // namespace hitpipe::rtl
