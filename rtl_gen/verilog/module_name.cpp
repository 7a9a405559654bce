#include "rtl_gen/verilog/module_name.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "rtl_gen/verilog/keywords.hpp"

namespace hitpipe::rtl {

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
