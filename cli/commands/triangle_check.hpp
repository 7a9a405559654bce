// `check` of a triangle unit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/design_options.hpp"
#include "cli/text/table.hpp"

namespace hitpipe::cli {

struct TriangleCheck {
  DesignChoice choice;
  std::vector<std::string> categories;
  std::uint64_t tests;
  std::uint64_t seed;
  int threads;
  bool rtl;
  int interval;
  OutputFormat format;
};

/// Prints the table and returns the exit code.
[[nodiscard]] int check_triangle_unit(const TriangleCheck& command);

}  // namespace hitpipe::cli
