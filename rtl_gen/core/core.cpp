#include "rtl_gen/core/core.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hls/machines/best_hits.hpp"
#include "hls/machines/door.hpp"
#include "hls/machines/pair_feed.hpp"
#include "hls/machines/reader.hpp"
#include "hls/machines/replies.hpp"
#include "hls/machines/requests.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/machines/weights.hpp"
#include "hls/world/core_format.hpp"
#include "rtl_gen/core/block_rams.hpp"
#include "rtl_gen/core/wires.hpp"
#include "rtl_gen/machine/module.hpp"
#include "rtl_gen/verilog/module.hpp"

namespace hitpipe::rtl {

namespace {

void check(const CoreOptions& options) {
  const auto within = [](const char* what, int value, int least, int most) {
    if (value < least || value > most)
      throw std::runtime_error(fmt::format("{} {}: allowed is {} to {}", what, value, least, most));
  };
  if (!options.bits.valid())
    throw std::runtime_error(fmt::format("core: there is no format {}; allowed is {}",
                                         to_string(Format(options.bits)),
                                         Format(options.bits).family().allowed()));
  within("rays in flight", options.rays, 1, CoreOptions::most_rays);
  within("bits of places on a stack", options.stack_bits, 1, 6);
  within("levels", options.levels, 2, CoreOptions::most_levels);
  within("bits of a block's number", options.address_bits, 4, 32);
  within("bits of an address", options.byte_bits, options.address_bits + 5, 64);
  within("block RAMs", options.block_rams, 0, CoreOptions::most_block_rams);
  within("bits of a tag", options.tag_bits, 1, 64);
  if (options.data_bits < 64 || options.data_bits > 512 || (options.data_bits & (options.data_bits - 1)) != 0)
    throw std::runtime_error(
        fmt::format("bits of the memory bus {}: allowed is 64, 128, 256, 512", options.data_bits));
  if (options.serial() && options.weights)
    throw std::runtime_error(
        "weights of the corners: allowed with a triangle unit, not with the serial test");
  if (!options.serial())
    within("cycles from triangle to triangle", options.triangle_interval,
           CoreOptions::least_triangle_interval, 64);
}

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
    add_machine("door", hls::DoorBits{t, ray});
    add_machine("walker", hls::WalkBits{box, address, options.levels, options.stack_bits, ray});
    add_machine("reader", hls::ReaderBits{address, ray});
    add_machine("requests", hls::RequestBits{address, options.byte_bits, ray});
    add_machine("pair_feed",
                hls::PairFeedBits{bits.coord, bits.finer, bits.mantissa, bits.box_fraction, address, ray});
    const hls::CoreBits triangles{bits.world(), ray};
    if (options.serial()) {
      add_machine("serial_triangle", triangles);
    } else {
      add_machine("triangle_feed", triangles);
      add_machine("divider", triangles);
    }
    add_machine("best_hits", hls::BestBits{t, bits.finer + bits.fraction - bits.box_fraction, box, ray});
    add_machine("replies", hls::ReplyBits{t, options.tag_bits, ray});
    hls::WorldBits tests = bits.world();
    tests.weights = options.weights ? 1 : 0;
    if (options.weights)
      add_machine(pins::weights_part,
                  hls::WeightBits{tests.determinant(), tests.edge(), t, options.tag_bits, ray});
    add_unit("pair", "int_major_pair", bits.boxes(), 1);
    if (!options.serial()) add_unit("triangle", "int_triangle", tests, options.triangle_interval);
    if (options.door == Door::binary32) add_ray_unit();

    join_all(links::core);
    join_unit("pair_feed", "pair", {"walker"});
    if (options.serial()) {
      join_all(links::serial_triangle);
    } else {
      join_all(links::triangle_unit);
      join_unit("triangle_feed", "triangle", {"reader", "divider"});
    }
    if (options.weights) {
      join_all(links::answers_with_weights);
      join_results("triangle", pins::weights_part);
    } else {
      join_all(links::plain_answers);
    }
    for (CorePin pin : pins::core) {
      if (options.door != Door::integer && pin.name.starts_with("ray_")) continue;
      if (options.weights && pin.from == "replies") pin.from = pins::weights_part;
      add_port(pin);
    }
    if (options.weights)
      for (const CorePin& pin : pins::weights) add_port(pin);
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

  /// It waits for the door.
  void add_ray_unit() {
    add_unit("ray", "int_ray", core_.options.bits, CoreOptions::door_interval, FlowControl::stall);
    Part& unit = core_.parts.back();
    std::vector<Pin> pins;
    for (Pin& pin : unit.interface.pins) {
      if (pin.role == Pin::Role::tag) pin.width = core_.options.tag_bits;
      pins.push_back(pin);
      if (pin.role == Pin::Role::tag)
        pins.push_back({pin.is_input ? "in_any" : "out_any", Pin::Role::tag, pin.channel, pin.is_input});
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
        if (part.machine != nullptr && find_pin(part, input)) join({"ray", pin.name, part.name, input});
    }
    const std::size_t place = place_of("ray");
    for (const RayPin& pin : ray_unit_pins)
      add_port(std::string(pin.name), pin.comment, {{place, pin_place(unit, pin.pin)}});
    for (const Port& operand : unit.design->ports(unit.format))
      add_port("ray_" + operand.name, description(operand), {{place, pin_place(unit, operand.name)}});
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

  void add_port(const CorePin& of) {
    std::vector<CorePort::End> ends;
    for (std::size_t i = 0; i < core_.parts.size(); ++i) {
      const Part& part = core_.parts[i];
      if (part.machine == nullptr || (!of.from.empty() && part.name != of.from)) continue;
      const std::optional<std::size_t> pin = find_pin(part, of.name);
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

/// "walker_goes": the wire of an output. A pin of the core has its own name.
class Nets {
 public:
  explicit Nets(const Core& core) : core_(core) {}

  [[nodiscard]] std::string declarations() const {
    std::string text;
    for (const Part& part : core_.parts)
      for (const Pin& pin : part.interface.pins)
        if (!pin.is_input) text += fmt::format("  wire {}{};\n", vector_range(pin.width), net(part, pin));
    return text;
  }
  [[nodiscard]] std::string instance(std::size_t place) const {
    const Part& part = core_.parts[place];
    const std::vector<Pin>& pins = part.interface.pins;
    const auto wire = [&](const Pin& pin) {
      return pin.is_input ? source(place, static_cast<std::size_t>(&pin - pins.data())) : net(part, pin);
    };
    std::vector<std::string> connections;
    int tag_bits = 0;
    for (const bool is_input : {true, false}) {
      std::vector<std::string> tags;  // the last is above
      tag_bits = 0;
      for (const Pin& pin : pins) {
        if (pin.role != Pin::Role::tag || pin.is_input != is_input) continue;
        tags.insert(tags.begin(), wire(pin));
        tag_bits += pin.width;
      }
      if (!tags.empty())
        connections.push_back(
            fmt::format("    .{}({{{}}})", is_input ? "in_tag" : "out_tag", fmt::join(tags, ", ")));
    }
    for (const Pin& pin : pins)
      if (pin.role != Pin::Role::tag) connections.push_back(fmt::format("    .{}({})", pin.name, wire(pin)));
    const std::string parameters = tag_bits == 0 ? "" : fmt::format(" #(.TAG_BITS({}))", tag_bits);
    return fmt::format("  {}{} {} (\n{}\n  );\n", part.interface.module, parameters, part.name,
                       fmt::join(connections, ",\n"));
  }
  [[nodiscard]] std::string outputs() const {
    std::string text;
    for (const CorePort& port : core_.ports)
      if (!port.pin.is_input) {
        const Part& part = core_.parts[port.ends.front().part];
        text += fmt::format("  assign {} = {};\n", port.pin.name,
                            net(part, part.interface.pins[port.ends.front().pin]));
      }
    return text;
  }

 private:
  static std::string net(const Part& part, const Pin& pin) {
    return fmt::format("{}_{}", part.name, pin.name);
  }
  [[nodiscard]] std::string source(std::size_t part, std::size_t pin) const {
    for (const CoreWire& wire : core_.wires)
      if (wire.to == part && wire.input == pin)
        return net(core_.parts[wire.from], core_.parts[wire.from].interface.pins[wire.output]);
    for (const CorePort& port : core_.ports)
      for (const CorePort::End& end : port.ends)
        if (end.part == part && end.pin == pin) return port.pin.name;
    return core_.parts[part].interface.pins[pin].name;  // clk and rst
  }

  const Core& core_;
};

}  // namespace

int CoreOptions::ray_bits() const {
  return std::max(1, hls::count_bits(rays));
}

std::string CoreOptions::module() const {
  const std::string name = "hitpipe_core";
  return bits == CoreOptions{}.bits ? name : fmt::format("{}_{}", name, Format(bits).identifier());
}

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
  for (const CoreOptions& each : options) check(each);
  Units units(library);
  std::vector<Core> cores;
  cores.reserve(options.size());
  for (const CoreOptions& each : options)
    cores.push_back(Maker(each, units, module.empty() ? each.module() : module).made());
  return cores;
}

std::string to_verilog(const Core& core, const Library& library) {
  const Nets nets(core);
  std::string text = fmt::format(
      "// {} {}: a ray-tracing core, {} rays in flight. Clock of {} ps with the components of {}.\n"
      "// A reset empties it. Generated by hitpipe; do not edit.\n{}\n{}\n",
      core.module, to_string(Format(core.options.bits)), core.options.rays, core.clock_ps, library.name(),
      core.interface().head(), nets.declarations());
  for (std::size_t i = 0; i < core.parts.size(); ++i) text += nets.instance(i) + "\n";
  text += nets.outputs() + "endmodule\n";
  text += "\n/* verilator lint_off DECLFILENAME */\n";
  auto marked = in_block_rams(core, core.options.block_rams);
  for (const Part& part : core.parts) text += "\n" + to_verilog(part, library, marked[part.name]);
  return text + "/* verilator lint_on DECLFILENAME */\n";
}

}  // namespace hitpipe::rtl
