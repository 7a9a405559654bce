#include "rtl_gen/core/axi_plan.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hls/num/bits.hpp"
#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl {

namespace {

std::optional<std::size_t> pin_called(const std::vector<Pin>& pins, std::string_view name) {
  const auto found = std::ranges::find(pins, name, &Pin::name);
  return found == pins.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - pins.begin()));
}

}  // namespace

AxiPlan::AxiPlan(const Core& inside) : core(inside) {
  made_.interface = {axi_module(core),
                     {{axi_clock, Pin::Role::clock, "", true}, {"aresetn", Pin::Role::reset, "", true}}};
  made_.parts.push_back({.name = "core", .format = core.options.bits, .interface = core.interface()});
  join("core", "clk", "", axi_clock);
}

void AxiPlan::add_channel(const AxiChannel& channel) {
  add_pin({channel.before + "valid", Pin::Role::valid, channel.before, channel.is_input});
  add_pin({channel.before + "ready", Pin::Role::ready, channel.before, !channel.is_input});
  for (const auto& [name, width] : channel.data)
    add_pin({channel.before + name, Pin::Role::data, channel.before, channel.is_input, width});
}

void AxiPlan::add_output(std::string_view name, std::string_view part, std::string_view output) {
  add_pin({std::string(name), Pin::Role::data, "", false, all(part, output).width()});
  join("", name, part, output);
}

void AxiPlan::add_machine(std::string_view machine, const Format& format) {
  const Machine& of = *machine_called(machine);
  made_.parts.push_back(machine_part(of, format, fmt::format("{}_{}", core.module, machine)));
  join(machine, "clk", "", axi_clock);
  join(machine, "rst", is_reset());
}

Source AxiPlan::is_reset() const {
  return {.pieces = {{std::nullopt, 1, 1}}, .gates = {gate("", "aresetn")}, .inverted = true};
}

Source AxiPlan::valid_now(const std::string& channel) const {
  Source valid = all("", channel + "valid");
  if (!has_part("epoch")) return valid;
  const PinBits now = gate("epoch", "present").bits;
  PinBits id = gate("", channel + "id").bits;
  id.low = id.width - now.width;
  id.width = now.width;
  return through(valid, {.bits = id, .equals = now});
}

std::optional<std::size_t> AxiPlan::place_of(std::string_view part) const {
  if (part.empty()) return PinBits::outside;
  const auto found = std::ranges::find(made_.parts, part, &Part::name);
  if (found == made_.parts.end()) return std::nullopt;
  return static_cast<std::size_t>(found - made_.parts.begin());
}

AxiPlan::Place AxiPlan::place(std::string_view part, std::string_view pin) const {
  const std::optional<std::size_t> at = place_of(part);
  if (at)
    if (const auto found = pin_called(pins_of(*at), pin)) return {*at, *found};
  throw std::logic_error(fmt::format("core behind AXI: there is no {}.{}", part, pin));
}

const std::vector<Pin>& AxiPlan::pins_of(std::size_t part) const {
  return part == PinBits::outside ? made_.interface.pins : made_.parts[part].interface.pins;
}

bool AxiPlan::has(std::string_view part, std::string_view pin) const {
  const std::optional<std::size_t> at = place_of(part);
  return at && pin_called(pins_of(*at), pin);
}

Source AxiPlan::all(std::string_view part, std::string_view pin) const {
  const Place at = place(part, pin);
  return some(part, pin, 0, pins_of(at.part)[at.pin].width);
}

Source AxiPlan::some(std::string_view part, std::string_view pin, int low, int width) const {
  const Place at = place(part, pin);
  return {.pieces = {{PinBits{at.part, at.pin, low, width}, 0, width}}};
}

Source AxiPlan::beside(const std::vector<Source>& sources) {
  Source made;
  for (const Source& source : sources)
    for (const Source::Piece& piece : source.pieces)
      if (piece.width > 0) made.pieces.push_back(piece);
  return made;
}

Gate AxiPlan::gate(std::string_view part, std::string_view pin) const {
  return {*all(part, pin).pieces[0].bits};
}

void AxiPlan::join(std::string_view part, std::string_view pin, Source from) {
  const Place to = place(part, pin);
  made_.joints.push_back({to.part, to.pin, std::move(from)});
}

void AxiPlan::join_fields(std::string_view part, std::string_view before,
                          const std::vector<StreamField>& fields, std::string_view word) {
  for (const StreamField& field : fields)
    join(part, fmt::format("{}{}", before, field.name), some("", word, field.offset, field.width));
}

void AxiPlan::join_word(std::string_view word, const std::vector<StreamField>& fields, std::string_view part,
                        std::string_view before) {
  std::vector<Source> pieces;
  int at = 0;
  for (const StreamField& field : fields) {
    pieces.push_back(constant(0, field.offset - at));
    pieces.push_back(all(part, fmt::format("{}{}", before, field.name)));
    at = field.offset + field.width;
  }
  const Place to = place("", word);
  pieces.push_back(constant(0, made_.interface.pins[to.pin].width - at));
  join("", word, beside(pieces));
}

void AxiPlan::join_beat(std::string_view part, std::string_view before, std::string_view word) {
  for (int i = 0; has(part, fmt::format("{}_{}", before, i)); ++i)
    join(part, fmt::format("{}_{}", before, i), some("", word, 64 * i, 64));
}

void AxiPlan::join_burst(const std::string& channel, Source length, int beat_bytes) {
  join("", channel + "len", std::move(length));
  join("", channel + "size", constant(static_cast<std::uint64_t>(hls::count_bits(beat_bytes)), 3));
  join("", channel + "burst", constant(1, 2));  // one beat behind the other
  join("", channel + "cache", constant(3, 4));
  join("", channel + "prot", constant(0, 3));
}

bool AxiPlan::is_joined(std::string_view part, std::string_view pin) const {
  const Place to = place(part, pin);
  return made_.source_of(to.part, to.pin) != nullptr;
}

void AxiPlan::join_rest() {
  for (std::size_t to = 0; to < made_.parts.size(); ++to)
    for (const Pin& pin : made_.parts[to].interface.pins) {
      if (!pin.is_input || is_joined(made_.parts[to].name, pin.name)) continue;
      for (const Part& from : made_.parts)
        if (const auto given = pin_called(from.interface.pins, pin.name);
            given && !from.interface.pins[*given].is_input)
          join(made_.parts[to].name, pin.name, from.name, pin.name);
    }
}

Assembly AxiPlan::made() && {
  join_rest();
  if (const std::vector<std::string> broken = verify(made_); !broken.empty())
    throw std::logic_error(fmt::format("core behind AXI: {}", fmt::join(broken, "\n")));
  return std::move(made_);
}

}  // namespace hitpipe::rtl
