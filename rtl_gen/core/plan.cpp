#include "rtl_gen/core/plan.hpp"

#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

template <class Items, class Which>
auto found(Items& items, std::string_view what, std::string_view name, const Which& which) {
  const auto place = std::ranges::find_if(items, which);
  if (place == items.end()) throw std::logic_error(fmt::format("core: its plan has no {} {}", what, name));
  return place;
}

}  // namespace

PlannedPart& CorePlan::part(std::string_view name) {
  return *found(parts, "part", name, [&](const PlannedPart& each) { return each.name == name; });
}

CorePin& CorePlan::pin(std::string_view name) {
  return *found(pins, "pin", name, [&](const CorePin& each) { return each.name == name; });
}

UnitJoins& CorePlan::unit(std::string_view name) {
  return *found(units, "unit", name, [&](const UnitJoins& each) { return each.unit == name; });
}

void CorePlan::wrong_family(std::string_view part) {
  throw std::logic_error(fmt::format("core: the part {} has a format of another family", part));
}

void CorePlan::add_behind(std::string_view other, const PlannedPart& part) {
  const auto place = found(parts, "part", other, [&](const PlannedPart& each) { return each.name == other; });
  parts.insert(place + 1, part);
}

void CorePlan::remove(std::string_view part) {
  const auto place = found(parts, "part", part, [&](const PlannedPart& each) { return each.name == part; });
  parts.erase(place);
  std::erase_if(links, [&](const Link& each) { return each.from == part || each.to == part; });
  std::erase_if(units, [&](const UnitJoins& each) { return each.feed == part || each.unit == part; });
  std::erase_if(carried, [&](const Carried& each) { return each.unit == part; });
  std::erase_if(wires, [&](const PlannedWire& each) { return each.from == part || each.to == part; });
}

void CorePlan::remove_link(std::string_view from, std::string_view to) {
  links.erase(
      found(links, "link to", to, [&](const Link& each) { return each.from == from && each.to == to; }));
}

void CorePlan::add_pins_behind(std::string_view other, std::vector<CorePin> more) {
  const auto place = found(pins, "pin", other, [&](const CorePin& each) { return each.name == other; });
  pins.insert(place + 1, std::move_iterator(more.begin()), std::move_iterator(more.end()));
}

void CorePlan::replace_pins(const WhichPins& which, std::vector<CorePin> by) {
  const auto first = found(pins, "pin in place of", by.front().name, which);
  const std::ptrdiff_t at = first - pins.begin();
  std::erase_if(pins, which);
  pins.insert(pins.begin() + at, std::move_iterator(by.begin()), std::move_iterator(by.end()));
}

}  // namespace hitpipe::rtl
