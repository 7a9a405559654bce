// The entries of a component library's file. What is wrong is said in one line: where, the entry, what is
// allowed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace hitpipe::rtl {

using FileJson = nlohmann::json;

struct Limits {
  std::int64_t least, most;
};
// Wide enough for any process. Sums and products of such numbers stay within 64 bits.
inline constexpr Limits bits_limits{1, 1024};
inline constexpr Limits area_limits{0, 100'000'000};
inline constexpr Limits delay_limits{1, 1'000'000};
inline constexpr Limits stages_limits{0, 64};

/// All of these throw std::runtime_error.
[[nodiscard]] const FileJson& required(const FileJson& object, const std::string& key,
                                       std::string_view where);
[[nodiscard]] std::string text_of(const FileJson& object, const std::string& key, std::string_view where);
[[nodiscard]] int count_of(const FileJson& object, const std::string& key, std::string_view where,
                           Limits allowed);
[[nodiscard]] bool truth_of(const FileJson& object, const std::string& key, std::string_view where);
/// A text that stands in a comment of the Verilog, so it must be one line.
[[nodiscard]] std::string line_of_text(const FileJson& object, const std::string& key,
                                       std::string_view where);

/// The enumerator whose name, in the order of the enumeration, is the text.
template <class Law, std::size_t N>
[[nodiscard]] Law law_of(const FileJson& object, const std::string& key, std::string_view where,
                         const std::array<std::string_view, N>& laws) {
  const std::string law = text_of(object, key, where);
  const auto found = std::find(laws.begin(), laws.end(), law);
  if (found == laws.end()) {
    throw std::runtime_error(
        fmt::format("{}: \"{}\" is \"{}\", allowed are {}", where, key, law, fmt::join(laws, ", ")));
  }
  return static_cast<Law>(found - laws.begin());
}

}  // namespace hitpipe::rtl
