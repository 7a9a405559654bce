#include "rtl_gen/core/core.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "hls/machines/best_hits.hpp"
#include "hls/machines/cache.hpp"
#include "hls/machines/door.hpp"
#include "hls/machines/pair_feed.hpp"
#include "hls/machines/reader.hpp"
#include "hls/machines/replies.hpp"
#include "hls/machines/requests.hpp"
#include "hls/machines/rings.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/machines/weights.hpp"
#include "hls/world/core_format.hpp"
#include "rtl_gen/core/core_options.hpp"
#include "rtl_gen/core/wires.hpp"
#include "rtl_gen/machine/module.hpp"

namespace hitpipe::rtl {

namespace {

std::string module_of(const Core& core, std::string_view part) {
  return fmt::format("{}_{}", core.module, part);
}

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

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Maker {
 public:
  Maker(const CoreOptions& options, Units& units, const std::string& module)
      : core_{.options = options, .module = module, .clock_ps = 0, .parts = {}, .wires = {}, .ports = {}},
        units_(units) {}

  Core made() && {
    const hls::RayBits& bits = core_.options.bits;
    const CoreOptions& options = core_.options;
    const int ray = options.ray_bits();
    const int address = options.address_bits;
    const int t = bits.distance(), box = bits.boxes().length();
    const int questions = options.questions ? 1 : 0;
    const auto fewer = [](int width, int usual) { return width == usual ? 0 : width; };
    const int number = fewer(options.number_bits, hls::triangle_number_bits);
    const int leaf = fewer(options.leaf_bits, hls::child_count_bits);
    const int steps = fewer(options.step_bits, hls::step_count_bits);
    add_machine("door", hls::DoorBits{t, ray, questions, options.questions ? number : 0});
    add_machine("walker", hls::WalkBits{box, address, options.levels, options.stack_bits, ray, leaf, steps});
    add_machine("reader", hls::ReaderBits{address, ray, questions, leaf});
    if (options.has_cache())
      add_machine("cache", cache_bits(options));
    else
      add_machine("requests", hls::RequestBits{address, options.byte_bits, ray});
    add_machine("pair_feed", hls::PairFeedBits{bits.coord, bits.finer, bits.mantissa, bits.box_fraction,
                                               address, ray, leaf});
    hls::CoreBits triangles{bits.world(), ray};
    triangles.crossings = options.questions ? 3 : 0;
    triangles.number = number;
    if (options.serial()) {
      add_machine("serial_triangle", triangles);
    } else {
      add_machine("triangle_feed", triangles);
      add_machine("divider", triangles);
      if (options.questions) add_machine("ties", triangles);
    }
    add_machine("best_hits", hls::BestBits{t, bits.finer + bits.fraction - bits.box_fraction, box, ray,
                                           questions, number});
    add_machine("replies", hls::ReplyBits{t, options.tag_bits, ray, number});
    hls::WorldBits tests = bits.world();
    tests.weights = options.weights ? 1 : 0;
    tests.crossings = triangles.crossings;
    if (options.weights)
      add_machine(pins::weights_part,
                  hls::WeightBits{tests.determinant(), tests.edge(), t, options.tag_bits, ray});
    if (options.rings)
      add_machine(pins::rings_part,
                  hls::RingBits{options.byte_bits, options.tag_bits, t, options.ring_bits()});
    add_unit("pair", "int_major_pair", bits.boxes(), 1);
    if (!options.serial()) add_unit("triangle", "int_triangle", tests, options.triangle_interval);
    if (options.door == Door::binary32) add_ray_unit();

    join_all(links::core);
    if (options.has_cache()) {
      join_all(links::cache);
    } else {
      join_all(links::requests);
    }
    join_unit("pair_feed", "pair", {"walker"});
    if (options.serial()) {
      join_all(links::serial_triangle);
      if (options.has_cache()) join_all(links::cache_to_serial);
    } else {
      join_all(links::triangle_unit);
      if (options.has_cache()) join_all(links::cache_to_unit);
      if (options.questions)
        join_with_ties();
      else
        join_unit("triangle_feed", "triangle", {"reader", "divider"});
    }
    if (options.weights) {
      join_all(links::answers_with_weights);
      join_results("triangle", pins::weights_part);
    } else {
      join_all(links::plain_answers);
    }
    if (options.rings) {
      join_all(links::answers_to_rings);
      // A bus of 64 bits has no second word.
      for (const CorePin& pin : pins::rings)
        if ((!pin.from.empty() && pin.from != pins::rings_part) ||
            find_pin(core_.part(pins::rings_part), pin.name))
          add_port(pin);
    }
    for (CorePin pin : pins::rays) {
      if (options.rings) break;
      if (options.door != Door::integer && pin.name.starts_with("ray_")) continue;
      if (!options.questions && is_one_of(pins::question_names, pin.name)) continue;
      if (options.weights && pin.from == "replies") pin.from = pins::weights_part;
      add_port(pin);
    }
    if (options.has_cache()) {
      for (const CorePin& pin : pins::lines)
        if (!pin.from.empty() || find_pin(core_.part("cache"), pin.name)) add_port(pin);
    } else {
      add_ports(pins::blocks);
    }
    add_ports(pins::settings);
    if (options.weights) add_ports(pins::weights);
    for (const Part& part : core_.parts)
      for (const Pin& pin : part.interface.pins)
        if (pin.is_input && pin.role != Pin::Role::clock && pin.role != Pin::Role::reset &&
            !is_driven(place_of(part.name), pin_place(part, pin.name)))
          throw std::logic_error(fmt::format("core: nothing gives {}.{}", part.name, pin.name));
    return std::move(core_);
  }

 private:
  void add_machine(std::string_view name, const Format& format) {
    Part part = machine_part(*machine_called(name), format, module_of(core_, name));
    core_.clock_ps = std::max(core_.clock_ps, part.clock_ps(units_.library()));
    core_.parts.push_back(std::move(part));
  }

  void add_unit(std::string_view name, const std::string& design_name, const Format& format, int interval,
                FlowControl flow = FlowControl::none) {
    const Design& design = find_design(design_name);
    const int clock_ps = std::max(core_.clock_ps, core_.options.clock_ps.value_or(0));
    Part part = unit_part(design, format, module_of(core_, name),
                          units_.pipeline(design, format, interval, clock_ps), flow);
    part.name = name;
    core_.clock_ps = std::max(core_.clock_ps, part.clock_ps(units_.library()));
    for (Pin& pin : part.interface.pins)
      if (pin.role == Pin::Role::tag) pin.width = core_.options.ray_bits();
    core_.parts.push_back(std::move(part));
  }

  /// Hits go through the machine `ties`. The unit passes on which test of a triangle it is.
  void join_with_ties() {
    std::vector<Pin> pins;
    for (const Pin& pin : core_.parts[place_of("triangle")].interface.pins) {
      pins.push_back(pin);
      if (pin.role != Pin::Role::tag) continue;
      for (const TestPin& more : test_pins)
        pins.push_back({std::string(pin.is_input ? more.in : more.out), Pin::Role::tag, pin.channel,
                        pin.is_input, more.width});
    }
    core_.parts[place_of("triangle")].interface.pins = std::move(pins);
    join_unit("triangle_feed", "triangle", {"ties"});
    for (const TestPin& pin : test_pins) {
      join({"triangle_feed", pin.given, "triangle", pin.in});
      join({"triangle", pin.out, "ties", pin.taken});
    }
    join_all(links::questions);
  }

  /// It waits for the door.
  void add_ray_unit() {
    add_unit("ray", "int_ray", core_.options.bits, CoreOptions::door_interval, FlowControl::stall);
    Part& unit = core_.parts.back();
    std::vector<Pin> pins;
    for (Pin& pin : unit.interface.pins) {
      if (pin.role == Pin::Role::tag) pin.width = core_.options.tag_bits;
      pins.push_back(pin);
      if (pin.role != Pin::Role::tag) continue;
      const auto pass = [&](const char* what, int width) {
        pins.push_back({fmt::format("{}_{}", pin.is_input ? "in" : "out", what), Pin::Role::tag, pin.channel,
                        pin.is_input, width});
      };
      pass("any", 1);
      if (!core_.options.questions) continue;
      pass("once", 1);
      pass("from_t", core_.options.bits.distance());
      pass("from_number", hls::triangle_number_bits);
    }
    unit.interface.pins = std::move(pins);

    join({"door", hls::channels::ray_ready.name(), "ray", "out_ready"});
    for (const Pin& pin : unit.interface.pins) {
      if (pin.is_input) continue;
      const auto named = std::find_if(ray_unit_results.begin(), ray_unit_results.end(),
                                      [&](const RayResult& result) { return result.output == pin.name; });
      const std::string input =
          named != ray_unit_results.end() ? std::string(named->input) : fmt::format("ray_{}", pin.name);
      for (const Part& part : core_.parts)
        if (part.machine != nullptr && part.name != pins::rings_part && find_pin(part, input))
          join({"ray", pin.name, part.name, input});
    }
    if (core_.options.rings) {
      join_rings(unit);
      return;
    }
    const std::size_t place = place_of("ray");
    for (const RayPin& pin : ray_unit_pins)
      add_port(std::string(pin.name), pin.comment, {{place, pin_place(unit, pin.pin)}});
    for (const RayPin& pin : ray_question_pins)
      if (core_.options.questions)
        add_port(std::string(pin.name), pin.comment, {{place, pin_place(unit, pin.pin)}});
    for (const Port& operand : unit.design->ports(unit.format))
      add_port("ray_" + operand.name, description(operand), {{place, pin_place(unit, operand.name)}});
  }
  /// The unit `ray` takes rays from the rings.
  void join_rings(const Part& unit) {
    join({"ray", "in_ready", pins::rings_part, hls::rings::ray_taken.name()});
    for (const RayPin& pin : ray_unit_pins)
      if (find_pin(core_.part(pins::rings_part), pin.name))
        join({pins::rings_part, pin.name, "ray", pin.pin});
    for (const Port& operand : unit.design->ports(unit.format))
      join({pins::rings_part, "ray_" + operand.name, "ray", operand.name});
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
  /// From an output of a part to an input of another one. Both have one width.
  struct Wire {
    std::string_view from, output;
    std::string_view to, input;
  };
  void join(const Wire& wire) {
    const CoreWire made{place_of(wire.from), pin_place(core_.part(wire.from), wire.output), place_of(wire.to),
                        pin_place(core_.part(wire.to), wire.input)};
    const Pin& output = core_.parts[made.from].interface.pins[made.output];
    const Pin& input = core_.parts[made.to].interface.pins[made.input];
    if (output.is_input || !input.is_input || output.width != input.width || is_driven(made.to, made.input))
      throw std::logic_error(fmt::format("core: no wire leads from {}.{} to {}.{}", wire.from, wire.output,
                                         wire.to, wire.input));
    core_.wires.push_back(made);
  }

  void join_all(std::span<const Link> all) {
    for (const Link& link : all) {
      join_fields(link.from, link.given, link.to, link.taken);
      join_fields(link.to, link.given_back, link.from, link.taken_back);
    }
  }
  void join_fields(std::string_view from, Link::Names outputs, std::string_view to, Link::Names inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i)
      if (find_pin(core_.part(from), outputs[i]) && find_pin(core_.part(to), inputs[i]))
        join({from, outputs[i], to, inputs[i]});
  }
  /// A unit gets its operands from the machine that has outputs with their names.
  void join_unit(std::string_view feed, std::string_view unit,
                 std::initializer_list<std::string_view> takers) {
    using namespace hls::channels;
    join({feed, begins.name(), unit, "in_valid"});
    join({feed, test_ray.name(), unit, "in_tag"});
    if (find_pin(core_.part(unit), "in_ready")) join({unit, "in_ready", feed, unit_takes.name()});
    for (const Port& operand : core_.part(unit).interface.operands())
      join({feed, operand.name, unit, operand.name});
    for (const std::string_view taker : takers) join_results(unit, taker);
  }
  void join_results(std::string_view unit, std::string_view taker) {
    join({unit, "out_valid", taker, hls::channels::tested.name()});
    join({unit, "out_tag", taker, hls::channels::tester.name()});
    for (const Port& result : core_.part(unit).interface.results())
      if (find_pin(core_.part(taker), result.name)) join({unit, result.name, taker, result.name});
  }

  void add_ports(std::span<const CorePin> pins) {
    for (const CorePin& pin : pins) add_port(pin);
  }
  void add_port(const CorePin& of) {
    std::vector<CorePort::End> ends;
    for (std::size_t i = 0; i < core_.parts.size(); ++i) {
      const Part& part = core_.parts[i];
      if (part.machine == nullptr || (!of.from.empty() && part.name != of.from)) continue;
      const std::optional<std::size_t> pin = find_pin(part, of.of.empty() ? of.name : of.of);
      if (pin && part.interface.pins[*pin].is_input == of.from.empty() && !is_driven(i, *pin))
        ends.push_back({i, *pin});
    }
    if (ends.empty()) throw std::logic_error(fmt::format("core: no part has the pin {}", of.name));
    add_port(std::string(of.name), of.comment, std::move(ends));
  }
  void add_port(const std::string& name, std::string_view comment, std::vector<CorePort::End> ends) {
    const auto pin_of = [&](const CorePort::End& end) -> const Pin& {
      return core_.parts[end.part].interface.pins[end.pin];
    };
    const Pin& first = pin_of(ends.front());
    for (const CorePort::End& end : ends)
      if (pin_of(end).width != first.width)
        throw std::logic_error(fmt::format("core: {} has two widths", name));
    core_.ports.push_back(
        {{name, Pin::Role::data, "", first.is_input, first.width, first.is_signed, std::string(comment)},
         std::move(ends)});
  }

  Core core_;
  Units& units_;
};

}  // namespace

const Part& Core::part(std::string_view name) const {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.name == name; });
  if (found == parts.end()) throw std::logic_error(fmt::format("core: there is no part {}", name));
  return *found;
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
  for (const CoreOptions& each : options)
    cores.push_back(Maker(each, units, module.empty() ? each.module() : module).made());
  return cores;
}

}  // namespace hitpipe::rtl
