#include "rtl_gen/core/core.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "hls/machines/channels.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/core/feature.hpp"
#include "rtl_gen/machine/module.hpp"

namespace hitpipe::rtl {

namespace {

/// Pipelines of units by one library, each made once.
class Units {
 public:
  explicit Units(const Library& library) : library_(library) {}

  /// For this clock, or for the unit's shortest one if that is longer.
  const Pipeline& pipeline(const Design& design, const Format& format, int interval, int clock_ps) {
    const Key key{design.name, to_string(format), interval, clock_ps};
    const auto made = made_.find(key);
    if (made != made_.end()) return made->second;
    const Graph graph = design.trace(format);
    const int clock = std::max(clock_ps, shortest_clock_ps(graph, library_, interval));
    return made_.emplace(key, make_pipeline(graph, library_, clock, interval)).first->second;
  }
  [[nodiscard]] const Library& library() const { return library_; }

 private:
  using Key = std::tuple<std::string_view, std::string, int, int>;

  const Library& library_;
  std::map<Key, Pipeline> made_;
};

/// Makes what a plan says.
class Maker {
 public:
  Maker(const CoreOptions& options, const CorePlan& plan, Units& units, const std::string& module)
      : core_{.options = options,
              .module = module,
              .clock_ps = 0,
              .parts = {},
              .wires = {},
              .ports = {},
              .bus = plan.bus},
        plan_(plan),
        units_(units) {}

  Core made() && {
    for (const PlannedPart& part : plan_.parts) add(part);
    for (const Carried& each : plan_.carried) carry(each);
    for (const PlannedWire& wire : plan_.wires) join(wire);
    for (const UnitJoins& unit : plan_.units) join_unit(unit);
    for (const Broadcast& each : plan_.broadcasts) broadcast(each);
    for (const Link& link : plan_.links) {
      join_fields(link.from, link.given, link.to, link.taken);
      join_fields(link.to, link.given_back, link.from, link.taken_back);
    }
    for (const CorePin& pin : plan_.pins) add_port(pin);
    check_driven();
    return std::move(core_);
  }

 private:
  void add(const PlannedPart& planned) {
    const std::string module = fmt::format("{}_{}", core_.module, planned.name);
    Part part = planned.is_unit() ? unit(planned, module)
                                  : machine_part(*machine_called(planned.of), planned.format, module);
    part.name = planned.name;
    core_.clock_ps = std::max(core_.clock_ps, part.clock_ps(units_.library()));
    core_.parts.push_back(std::move(part));
  }
  Part unit(const PlannedPart& planned, const std::string& module) {
    const Design& design = find_design(std::string(planned.of));
    const int clock_ps = std::max(core_.clock_ps, core_.options.clock_ps.value_or(0));
    Part part = unit_part(design, planned.format, module,
                          units_.pipeline(design, planned.format, planned.interval, clock_ps), planned.flow);
    for (Pin& pin : part.interface.pins)
      if (pin.role == Pin::Role::tag) pin.width = planned.tag_bits;
    return part;
  }
  /// Behind the tags that are there.
  void carry(const Carried& more) {
    std::vector<Pin>& pins = core_.parts[place_of(more.unit)].interface.pins;
    for (const bool is_input : {true, false}) {
      const auto is_tag = [&](const Pin& pin) {
        return pin.role == Pin::Role::tag && pin.is_input == is_input;
      };
      const auto last = std::find_if(pins.rbegin(), pins.rend(), is_tag);
      const Pin pin{fmt::format("{}_{}", is_input ? "in" : "out", more.name), Pin::Role::tag, last->channel,
                    is_input, more.width};
      pins.insert(last.base(), pin);
    }
  }

  [[nodiscard]] std::size_t place_of(std::string_view name) const {
    return static_cast<std::size_t>(&core_.part(name) - core_.parts.data());
  }
  [[nodiscard]] static std::optional<std::size_t> find_pin(const Part& part, std::string_view name) {
    const std::vector<Pin>& pins = part.interface.pins;
    const auto found =
        std::find_if(pins.begin(), pins.end(), [&](const Pin& pin) { return pin.name == name; });
    if (found == pins.end()) return std::nullopt;
    return static_cast<std::size_t>(found - pins.begin());
  }
  [[nodiscard]] static bool has_input(const Part& part, std::string_view name) {
    const std::optional<std::size_t> pin = find_pin(part, name);
    return pin && part.interface.pins[*pin].is_input;
  }
  [[nodiscard]] static std::size_t pin_place(const Part& part, std::string_view name) {
    const std::optional<std::size_t> place = find_pin(part, name);
    if (!place) throw std::logic_error(fmt::format("core: there is no {}.{}", part.name, name));
    return *place;
  }
  [[nodiscard]] bool is_driven(std::size_t part, std::size_t pin) const {
    const auto ends_there = [&](const auto& end) { return end.part == part && end.pin == pin; };
    return std::any_of(core_.wires.begin(), core_.wires.end(),
                       [&](const CoreWire& wire) { return wire.to == part && wire.input == pin; }) ||
           std::any_of(core_.ports.begin(), core_.ports.end(), [&](const CorePort& port) {
             return std::any_of(port.ends.begin(), port.ends.end(), ends_there);
           });
  }
  void join(const PlannedWire& wire) { join(wire.from, wire.output, wire.to, wire.input); }
  void join(std::string_view from, std::string_view output, std::string_view to, std::string_view input) {
    const CoreWire made{place_of(from), pin_place(core_.part(from), output), place_of(to),
                        pin_place(core_.part(to), input)};
    const Pin& given = core_.parts[made.from].interface.pins[made.output];
    const Pin& taken = core_.parts[made.to].interface.pins[made.input];
    if (given.is_input || !taken.is_input || given.width != taken.width || is_driven(made.to, made.input))
      throw std::logic_error(fmt::format("core: no wire leads from {}.{} to {}.{}", from, output, to, input));
    core_.wires.push_back(made);
  }
  void join_fields(std::string_view from, Link::Names outputs, std::string_view to, Link::Names inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i)
      if (find_pin(core_.part(from), outputs[i]) && find_pin(core_.part(to), inputs[i]))
        join(from, outputs[i], to, inputs[i]);
  }
  /// A unit gets its operands from the machine that has outputs with their names.
  void join_unit(const UnitJoins& joins) {
    using namespace hls::channels;
    const Part& unit = core_.part(joins.unit);
    if (!joins.feed.empty()) {
      join(joins.feed, begins.name(), joins.unit, "in_valid");
      join(joins.feed, test_ray.name(), joins.unit, "in_tag");
      if (find_pin(unit, "in_ready")) join(joins.unit, "in_ready", joins.feed, unit_takes.name());
      for (const Port& operand : unit.interface.operands())
        join(joins.feed, operand.name, joins.unit, operand.name);
    }
    for (const std::string_view taker : joins.takers) {
      join(joins.unit, "out_valid", taker, tested.name());
      join(joins.unit, "out_tag", taker, tester.name());
      for (const Port& result : unit.interface.results())
        if (find_pin(core_.part(taker), result.name)) join(joins.unit, result.name, taker, result.name);
    }
  }
  void broadcast(const Broadcast& all) {
    for (const Pin& pin : core_.part(all.unit).interface.pins) {
      if (pin.is_input) continue;
      const auto renamed =
          std::ranges::find_if(all.renamed, [&](const auto& each) { return each.first == pin.name; });
      const std::string input =
          renamed != all.renamed.end() ? renamed->second : fmt::format("{}_{}", all.prefix, pin.name);
      for (const Part& part : core_.parts)
        if (part.machine != nullptr && has_input(part, input)) join(all.unit, pin.name, part.name, input);
    }
  }

  /// An input of machines that no machine has is left out: a narrow bus has fewer words.
  void add_port(const CorePin& of) {
    std::vector<CorePort::End> ends;
    for (std::size_t i = 0; i < core_.parts.size(); ++i) {
      const Part& part = core_.parts[i];
      if (of.part.empty() ? part.machine == nullptr : part.name != of.part) continue;
      const std::optional<std::size_t> pin = find_pin(part, of.of.empty() ? of.name : of.of);
      if (pin && part.interface.pins[*pin].is_input == of.is_input && !(of.is_input && is_driven(i, *pin)))
        ends.push_back({i, *pin});
    }
    if (ends.empty() && of.is_input && of.part.empty()) return;
    if (ends.empty()) throw std::logic_error(fmt::format("core: no part has the pin {}", of.name));
    const auto pin_of = [&](const CorePort::End& end) -> const Pin& {
      return core_.parts[end.part].interface.pins[end.pin];
    };
    const Pin& first = pin_of(ends.front());
    for (const CorePort::End& end : ends)
      if (pin_of(end).width != first.width)
        throw std::logic_error(fmt::format("core: {} has two widths", of.name));
    core_.ports.push_back(
        {{of.name, Pin::Role::data, "", first.is_input, first.width, first.is_signed, of.comment},
         std::move(ends),
         of.meaning});
  }
  void check_driven() const {
    for (const Part& part : core_.parts)
      for (const Pin& pin : part.interface.pins)
        if (pin.is_input && pin.role != Pin::Role::clock && pin.role != Pin::Role::reset &&
            !is_driven(place_of(part.name), pin_place(part, pin.name)))
          throw std::logic_error(fmt::format("core: nothing gives {}.{}", part.name, pin.name));
  }

  Core core_;
  const CorePlan& plan_;
  Units& units_;
};

}  // namespace

const Part& Core::part(std::string_view name) const {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.name == name; });
  if (found == parts.end()) throw std::logic_error(fmt::format("core: there is no part {}", name));
  return *found;
}

int Core::answer_bits() const {
  const std::vector<Pin>& pins = part("replies").interface.pins;
  const auto t =
      std::ranges::find_if(pins, [](const Pin& pin) { return pin.name == hls::channels::Hits::t.name(); });
  return t->width;
}

const CorePort* Core::port_called(std::string_view name) const {
  const auto found =
      std::find_if(ports.begin(), ports.end(), [&](const CorePort& port) { return port.pin.name == name; });
  return found == ports.end() ? nullptr : &*found;
}

std::optional<std::size_t> Core::place_called(std::string_view name) const {
  const CorePort* const found = port_called(name);
  if (found == nullptr) return std::nullopt;
  const CorePort* const first = ports.data();
  return static_cast<std::size_t>(std::count_if(
      first, found, [&](const CorePort& port) { return port.pin.is_input == found->pin.is_input; }));
}

ModuleInterface Core::interface() const {
  ModuleInterface made{module, {{"clk", Pin::Role::clock, "", true}, {"rst", Pin::Role::reset, "", true}}};
  for (const CorePort& port : ports) made.pins.push_back(port.pin);
  return made;
}

Core make_core(const CoreOptions& options, const Library& library, const std::string& module) {
  return std::move(make_cores({&options, 1}, library, module).front());
}

std::vector<Core> make_cores(std::span<const CoreOptions> options, const Library& library,
                             const std::string& module) {
  for (const CoreOptions& each : options) check_core_options(each);
  Units units(library);
  std::vector<Core> cores;
  cores.reserve(options.size());
  for (const CoreOptions& each : options) {
    const CorePlan plan = plan_of(each);
    cores.push_back(Maker(each, plan, units, module.empty() ? each.module() : module).made());
  }
  return cores;
}

}  // namespace hitpipe::rtl
