// How a piece keeps structs in its file: a struct names its members once, and JSON is made and read by that.
#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "sw_ref/judge/interval.hpp"

namespace hitpipe::cli {

/// Specialised for each struct: `static void each(auto& self, const auto& member)` calls member(name, value)
/// for each of its members.
template <class T>
struct Kept;

template <class T>
concept IsKept = requires {
  sizeof(Kept<T>);
};

}  // namespace hitpipe::cli

namespace nlohmann {

template <hitpipe::cli::IsKept T>
struct adl_serializer<T, void> {
  static void to_json(auto& row, const T& value) {
    hitpipe::cli::Kept<T>::each(value, [&](const char* name, const auto& member) { row[name] = member; });
  }
  static void from_json(const auto& row, T& value) {
    hitpipe::cli::Kept<T>::each(value, [&](const char* name, auto& member) { row.at(name).get_to(member); });
  }
};

/// Of none: null.
template <class T>
struct adl_serializer<std::optional<T>, void> {
  static void to_json(auto& row, const std::optional<T>& value) {
    if (value) row = *value;
  }
  static void from_json(const auto& row, std::optional<T>& value) {
    if (!row.is_null()) value = row.template get<T>();
  }
};

template <>
struct adl_serializer<hitpipe::ref::GroupedRatio, void> {
  static void to_json(auto& row, const hitpipe::ref::GroupedRatio& ratio) { row = ratio.sums(); }
  static void from_json(const auto& row, hitpipe::ref::GroupedRatio& ratio) {
    ratio = hitpipe::ref::GroupedRatio::of(row.template get<hitpipe::ref::GroupedRatio::Sums>());
  }
};

}  // namespace nlohmann
