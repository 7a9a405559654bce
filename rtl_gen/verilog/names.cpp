#include "rtl_gen/verilog/names.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe::rtl {

namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& name) {
  Words words;
  std::istringstream stream(name);
  for (std::string word; std::getline(stream, word, '_');) words.push_back(word);
  return words;
}

/// The words of `a` that are also in `b`, in the same order.
Words shared_words(const Words& a, const Words& b) {
  Words shared;
  auto from = b.begin();
  for (const std::string& word : a) {
    const auto found = std::find(from, b.end(), word);
    if (found == b.end()) continue;
    shared.push_back(word);
    from = found + 1;
  }
  return shared;
}

/// What the next named readers of a value have in common.
struct Purpose {
  bool is_known = false;
  Words words{};
  SourceLine source{};  ///< line 0: they come from several lines

  void add(const Purpose& other) {
    if (!other.is_known) return;
    if (!is_known) {
      *this = other;
      return;
    }
    words = shared_words(words, other.words);
    if (source.file != other.source.file || source.line != other.source.line) source = {};
  }
};

/// The smallest part that has a name and holds all used bits, or null.
const NamedPart* used_part(const Node& n, BitSpan used) {
  const NamedPart* best = nullptr;
  for (const NamedPart& part : n.parts) {
    if (part.high < used.high || part.low > used.low) continue;
    if (best == nullptr || part.high - part.low < best->high - best->low) best = &part;
  }
  return best;
}

}  // namespace

BitSpan used_span(const Graph& graph, const Placement& placement, NodeId value) {
  const Word bits = placement.used_bits[value];
  if (bits == 0) return {graph[value].width - 1, 0};
  return {width_of_bits(bits) - 1, low_zeros(bits)};
}

std::vector<ValueName> value_names(const Graph& graph, const Placement& placement,
                                   std::set<std::string> taken) {
  const std::set<std::string>& keywords = verilog_keywords();
  taken.insert(keywords.begin(), keywords.end());
  std::vector<ValueName> names(graph.size());
  std::vector<Purpose> purposes(graph.size());
  for (NodeId id = graph.size(); id-- > 0;) {
    const Node& n = graph[id];
    ValueName& own = names[id];
    own = {.name = n.name, .source = n.source, .is_own = !n.name.empty()};
    if (n.name.empty() && is_root(n.op)) {
      if (const NamedPart* const part = used_part(n, used_span(graph, placement, id)))
        own = {.name = part->name, .source = part->source, .is_own = true};
    }
    const Purpose of_this{true, words_of(own.name), own.source};
    for (const NodeId arg : n.operands()) purposes[arg].add(own.is_own ? of_this : purposes[id]);
  }
  const auto claim = [&](NodeId id, const std::string& wish) {
    std::string name = wish;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", wish, i);
    names[id].name = name;
  };
  // Ports come first, as they must keep their names; then what the C++ names; then the rest.
  for (const NodeId id : graph.inputs()) claim(id, graph[id].name);
  for (const bool named : {true, false}) {
    for (NodeId id = 0; id < graph.size(); ++id) {
      const Node& n = graph[id];
      if (n.op == Op::input || names[id].is_own != named) continue;
      if (!is_root(n.op)) {
        names[id] = {};
        continue;
      }
      if (!named) names[id].source = purposes[id].source;
      const Words& words = purposes[id].words;
      const std::string purpose = words.empty() ? graph.name() : fmt::format("{}", fmt::join(words, "_"));
      claim(id, named ? names[id].name : fmt::format("{}_{}", purpose, op_name(n.op)));
    }
  }
  return names;
}

std::string shared_name(const std::vector<std::string>& names) {
  Words words = words_of(names.front());
  for (const std::string& name : names) words = shared_words(words, words_of(name));
  return fmt::format("{}", fmt::join(words, "_"));
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
        host::shortened(name), longest));
  const bool verilog = verilog_keywords().contains(name);
  if (verilog || cpp_keywords().contains(name))
    throw std::runtime_error(
        fmt::format("name {}: is a keyword of {}; take another", name, verilog ? "Verilog" : "C++"));
}

}  // namespace hitpipe::rtl
