#include "rtl_gen/verilog/keywords.hpp"

#include <iterator>
#include <sstream>

namespace hitpipe::rtl {

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

}  // namespace hitpipe::rtl
