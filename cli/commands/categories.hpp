// Categories of cases by their names.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe::cli {

/// Those of the names; all, if there are none. Throws std::runtime_error, which lists all, for another name.
template <class Category>
std::vector<Category> chosen_of(const std::vector<Category>& all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::vector<Category> chosen;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Category& c) { return c.name == name; });
    if (found == all.end()) {
      std::vector<std::string_view> known;
      for (const Category& c : all) known.push_back(c.name);
      throw std::runtime_error(
          fmt::format("category {}: unknown; there are: {}", host::shortened(name), fmt::join(known, ", ")));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace hitpipe::cli
