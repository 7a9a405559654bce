#include "cli/report/column_heading.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hitpipe::cli {

namespace {

using Words = std::pair<std::string_view, std::string_view>;

/// The longest endings first.
constexpr std::array<Words, 10> unit_words{{{"_mm2_ns", ", mm² ns"},
                                            {"_mm2_ms", ", mm² ms"},
                                            {"_lut_ms", ", LUT ms"},
                                            {"_lut", ", LUT"},
                                            {"_per_million", " in a million"},
                                            {"_mm2", ", mm²"},
                                            {"_mhz", ", MHz"},
                                            {"_pct", ", %"},
                                            {"_ns", ", ns"},
                                            {"_ms", ", ms"}}};

constexpr std::array<Words, 5> heading_words{{{"stage delay", "clock period"},
                                              {"area delay", "area × clock period"},
                                              {"area run time", "area × run time"},
                                              {"area per box", "area for each box"},
                                              {"rtl", "RTL"}}};

}  // namespace

std::string column_heading(std::string_view column) {
  std::string unit;
  for (const auto& [ending, text] : unit_words) {
    if (!column.ends_with(ending)) continue;
    unit = text;
    column.remove_suffix(ending.size());
    break;
  }
  std::string heading(column);
  std::replace(heading.begin(), heading.end(), '_', ' ');
  for (const auto& [name, text] : heading_words) {
    if (const std::size_t at = heading.find(name); at != std::string::npos)
      heading.replace(at, name.size(), text);
  }
  return heading + unit;
}

}  // namespace hitpipe::cli
