// Texts of a target's file with names to fill in.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hitpipe::sim {

/// Puts a value in the place of each "{name}".
[[nodiscard]] inline std::string filled_in(
    std::string text, const std::vector<std::pair<std::string_view, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string place = "{" + std::string(name) + "}";
    for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += value.size())
      text.replace(at, place.size(), value);
  }
  return text;
}

}  // namespace hitpipe::sim
