// Small cores that have certain features. All follows from what features say of themselves, so a new one is among them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl {

using Features = std::vector<const Feature*>;

/// In the order of all_features().
struct FeaturePair {
  const Feature *first, *second;

  [[nodiscard]] std::string name() const { return fmt::format("{}_and_{}", first->name, second->name); }
  [[nodiscard]] Features features() const { return {first, second}; }
};
inline void PrintTo(const FeaturePair& pair, std::ostream* out) {
  *out << pair.name();
}

/// Those that a core may do without.
[[nodiscard]] inline Features choices() {
  Features made;
  std::ranges::copy_if(all_features(), std::back_inserter(made),
                       [](const Feature* each) { return !each->is_in(CoreOptions{}); });
  return made;
}

[[nodiscard]] inline std::vector<FeaturePair> feature_pairs() {
  const Features all = choices();
  std::vector<FeaturePair> made;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) made.push_back({all[i], all[j]});
  return made;
}

/// These and what they need, in the order of all_features().
[[nodiscard]] inline Features with_needs(Features features) {
  for (std::size_t i = 0; i < features.size(); ++i)
    for (const Needs& needs : features[i]->needs)
      if (const Feature* const other = &feature_called(needs.feature);
          std::ranges::count(features, other) == 0)
        features.push_back(other);
  std::ranges::sort(features, {},
                    [](const Feature* each) { return std::ranges::find(all_features(), each); });
  return features;
}

/// Two of these of which one excludes the other.
[[nodiscard]] inline std::optional<FeaturePair> exclusion(const Features& features) {
  for (const Feature* const each : features)
    for (const Excludes& excludes : each->excludes)
      if (const Feature* const other = &feature_called(excludes.feature);
          std::ranges::count(features, other) != 0)
        return FeaturePair{each, other};
  return std::nullopt;
}

/// The values that a user may give, words first. Of numbers the least.
[[nodiscard]] inline std::vector<int> values_of(const CoreOption& option) {
  std::vector<int> made;
  for (const auto& [word, value] : option.words) made.push_back(value);
  if (option.has_numbers()) made.push_back(option.least);
  if (option.is_flag) made.push_back(1);
  return made;
}

/// The feature is turned on by one of its options. Throws std::logic_error if none does.
inline void turn_on(CoreOptions& options, const Feature& feature) {
  if (feature.is_in(options)) return;
  for (const CoreOption& option : feature.options)
    for (const int value : values_of(option)) {
      CoreOptions made = options;
      option.set(made, value);
      if (!feature.is_in(made)) continue;
      options = made;
      return;
    }
  throw std::logic_error(fmt::format("no option turns on {}", feature.name));
}

/// A small core with these features. Its bus is the one of this number: each width, and one identifier at a block's.
[[nodiscard]] inline CoreOptions small_core(const Features& features, std::size_t bus = 0) {
  CoreOptions made{.bits = {8, 0, 4, 0, 8, 0}, .rays = 6, .levels = 12, .address_bits = 10, .tag_bits = 8};
  for (const Feature* const each : features) turn_on(made, *each);
  const auto& widths = core_option("--data-bits").words;
  const std::size_t place = bus % (widths.size() + 1);
  made.in_order = place == widths.size();
  if (!made.in_order) made.data_bits = widths[place].second;
  return made;
}

/// A pair that may stand together, and a core that has it.
struct PairedCore {
  FeaturePair pair;
  CoreOptions options;
};
inline void PrintTo(const PairedCore& core, std::ostream* out) {
  *out << core.pair.name();
}

/// Of all pairs that may stand together. The bus differs from pair to pair.
[[nodiscard]] inline std::vector<PairedCore> paired_cores() {
  std::vector<PairedCore> made;
  for (const FeaturePair& pair : feature_pairs())
    if (const Features features = with_needs(pair.features()); !exclusion(features))
      made.push_back({pair, small_core(features, made.size())});
  return made;
}

/// Few of these, with each feature in one or more: first pairs of two that were in none yet, then pairs of one.
[[nodiscard]] inline std::vector<PairedCore> some_paired_cores() {
  std::vector<PairedCore> made;
  Features had;
  for (const std::ptrdiff_t fresh : {2, 1})
    for (const PairedCore& each : paired_cores()) {
      const Features both = each.pair.features();
      const auto is_new = [&](const Feature* one) { return std::ranges::count(had, one) == 0; };
      if (std::ranges::count_if(both, is_new) != fresh) continue;
      made.push_back(each);
      had.insert(had.end(), both.begin(), both.end());
    }
  return made;
}

}  // namespace hitpipe::rtl
