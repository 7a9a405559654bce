#include "rtl_gen/core/feature.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hls/num/bits.hpp"

namespace hitpipe::rtl {

namespace {

struct IdentityField {
  std::string_view of, name;  ///< its register and itself
  int low, width;
};

/// Constants that are others in each core.
std::vector<IdentityField> identity_fields() {
  std::vector<IdentityField> made;
  for (const hls::registers::Register& each : hls::registers::table)
    for (const hls::registers::RegisterField& field : each.fields)
      if (field.access == hls::registers::Access::constant && field.reset == 0)
        made.push_back({each.name, field.name, field.low, field.width({})});
  return made;
}

}  // namespace

const Feature& feature_called(std::string_view name) {
  const auto found =
      std::ranges::find_if(all_features(), [&](const Feature* each) { return each->name == name; });
  if (found == all_features().end())
    throw std::logic_error(fmt::format("core: there is no feature {}", name));
  return **found;
}

std::string CoreOption::text(int value) const {
  const auto word = std::ranges::find_if(words, [&](const auto& each) { return each.second == value; });
  return word == words.end() ? fmt::format("{}", value) : word->first;
}

const CoreOption& core_option(std::string_view name) {
  for (const Feature* const each : all_features())
    for (const CoreOption& option : each->options)
      if (option.name == name) return option;
  throw std::logic_error(fmt::format("core: there is no option {}", name));
}

std::vector<const Feature*> features_of(const CoreOptions& options) {
  std::vector<const Feature*> made;
  std::ranges::copy_if(all_features(), std::back_inserter(made),
                       [&](const Feature* each) { return each->is_in(options); });
  return made;
}

CorePlan plan_of(const CoreOptions& options) {
  CorePlan plan;
  for (const Feature* const each : features_of(options))
    if (each->change != nullptr) each->change(plan, options);
  return plan;
}

CoreBus bus_of(const CoreOptions& options) {
  return plan_of(options).bus;
}

Json options_json(const CoreOptions& options) {
  Json json;
  for (const Feature* const each : all_features())
    for (const CoreOption& option : each->options) {
      if (option.json.empty()) continue;
      const int value = option.get(options);
      Json& row = json[std::string(option.json)];
      if (option.is_flag)
        row = value != 0;
      else if (option.has_numbers())
        row = value;
      else
        row = option.text(value);
    }
  return json;
}

void CoreIdentity::put(std::string_view field, int number) {
  const auto fields = identity_fields();
  const auto place = std::ranges::find(fields, field, &IdentityField::name);
  if (place == fields.end()) throw std::logic_error(fmt::format("core: its identity has no field {}", field));
  if (number < 0 || number >> place->width != 0)
    throw std::logic_error(
        fmt::format("core: {} does not fit into {} bits of {}", number, place->width, field));
  if (!numbers_.emplace(place->name, number).second)
    throw std::logic_error(fmt::format("core: its identity says {} twice", field));
}

void CoreIdentity::check() const {
  for (const IdentityField& each : identity_fields())
    if (!numbers_.contains(each.name))
      throw std::logic_error(fmt::format("core: its identity does not say {}", each.name));
}

std::uint32_t CoreIdentity::operator[](std::string_view name) const {
  std::uint32_t word = 0;
  for (const IdentityField& each : identity_fields())
    if (each.of == name && numbers_.contains(each.name)) word |= numbers_.at(each.name) << each.low;
  return word;
}

CoreIdentity identity_of(const CoreOptions& options) {
  CoreIdentity identity;
  for (const Feature* const each : all_features())
    if (each->identify != nullptr) each->identify(identity, options);
  identity.check();
  return identity;
}

void check_core_options(const CoreOptions& options) {
  for (const Feature* const each : features_of(options)) {
    for (const Needs& needs : each->needs)
      if (const Feature& other = feature_called(needs.feature); !other.is_in(options))
        throw std::runtime_error(
            fmt::format("{}: allowed with {}, not with {}", each->what, other.what, needs.otherwise));
    for (const Excludes& excludes : each->excludes)
      if (const Feature& other = feature_called(excludes.feature); other.is_in(options))
        throw std::runtime_error(
            fmt::format("{}: allowed with {}, not with {}", each->what, excludes.instead, other.what));
    if (each->check != nullptr) each->check(options);
  }
}

bool is_core(const CoreOptions& options) {
  try {
    check_core_options(options);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

int CoreOptions::ray_bits() const {
  return std::max(1, hls::count_bits(rays));
}

std::string CoreOptions::module() const {
  const std::string name = "hitpipe_core";
  return bits == CoreOptions{}.bits ? name : fmt::format("{}_{}", name, Format(bits).identifier());
}

}  // namespace hitpipe::rtl
