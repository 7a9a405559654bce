#include "rtl_gen/core/core.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hls/machines/best_hits.hpp"
#include "hls/machines/door.hpp"
#include "hls/machines/pair_feed.hpp"
#include "hls/machines/reader.hpp"
#include "hls/machines/replies.hpp"
#include "hls/machines/requests.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/world/core_format.hpp"
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
  within("levels", options.levels, 2, 60);
  within("bits of a block's number", options.address_bits, 4, 32);
  within("bits of an address", options.byte_bits, options.address_bits + 5, 64);
  within("bits of a tag", options.tag_bits, 1, 64);
  within("cycles from triangle to triangle", options.triangle_interval, CoreOptions::least_triangle_interval,
         64);
}

std::string module_of(const Core& core, std::string_view part) {
  return fmt::format("{}_{}", core.module, part);
}

class Maker {
 public:
  Maker(const CoreOptions& options, const Library& library, const std::string& module)
      : core_{.options = options, .module = module, .clock_ps = 0, .parts = {}, .wires = {}, .ports = {}},
        library_(library) {}

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
    add_machine("triangle_feed", hls::CoreBits{bits.world(), ray});
    add_machine("divider", hls::CoreBits{bits.world(), ray});
    add_machine("best_hits", hls::BestBits{t, bits.finer + bits.fraction - bits.box_fraction, box, ray});
    add_machine("replies", hls::ReplyBits{t, options.tag_bits, ray});
    add_unit("pair", find_design("int_major_pair"), bits.boxes(), 1);
    add_unit("triangle", find_design("int_triangle"), bits.world(), options.triangle_interval);

    for (const Wire& wire : core_wires) join(wire);
    for (const auto& [feed, unit] : {std::pair{"pair_feed", "pair"}, {"triangle_feed", "triangle"}})
      for (const Port& operand : core_.part(unit).interface.operands())
        join({feed, operand.name, unit, operand.name});
    for (const CorePin& pin : core_pins) add_port(pin);
    for (const CorePart& part : core_.parts)
      for (const Pin& pin : part.interface.pins)
        if (pin.is_input && pin.role != Pin::Role::clock && pin.role != Pin::Role::reset &&
            !is_driven(place_of(part.name), pin_place(part, pin.name)))
          throw std::logic_error(fmt::format("core: nothing gives {}.{}", part.name, pin.name));
    return std::move(core_);
  }

 private:
  void add_machine(std::string_view name, const Format& format) {
    CorePart part{.name = name, .format = format, .interface = {}, .machine = machine_called(name)};
    part.graph = part.machine->graph(format);
    part.interface = machine_interface(module_of(core_, name), *part.graph);
    core_.clock_ps = std::max(core_.clock_ps, longest_path(*part.graph, library_).clock_ps);
    core_.parts.push_back(std::move(part));
  }

  void add_unit(std::string_view name, const Design& design, const Format& format, int interval) {
    CorePart part{.name = name, .format = format, .interface = {}, .design = &design};
    const Graph graph = design.trace(format);
    part.pipeline = make_pipeline(graph, library_, std::nullopt, interval);
    if (part.pipeline->schedule.clock_ps < core_.clock_ps)
      part.pipeline = make_pipeline(graph, library_, core_.clock_ps, interval);
    core_.clock_ps = std::max(core_.clock_ps, part.pipeline->schedule.clock_ps);
    part.interface = unit_interface(module_of(core_, name), design.ports(format),
                                    result_ports(design.results(format)), FlowControl::none, interval);
    for (Pin& pin : part.interface.pins)
      if (pin.role == Pin::Role::tag) pin.width = core_.options.ray_bits();
    core_.parts.push_back(std::move(part));
  }

  [[nodiscard]] std::size_t place_of(std::string_view name) const {
    return static_cast<std::size_t>(&core_.part(name) - core_.parts.data());
  }
  [[nodiscard]] static std::size_t pin_place(const CorePart& part, std::string_view name) {
    const std::vector<Pin>& pins = part.interface.pins;
    const auto found =
        std::find_if(pins.begin(), pins.end(), [&](const Pin& pin) { return pin.name == name; });
    if (found == pins.end()) throw std::logic_error(fmt::format("core: there is no {}.{}", part.name, name));
    return static_cast<std::size_t>(found - pins.begin());
  }
  [[nodiscard]] bool is_driven(std::size_t part, std::size_t pin) const {
    const auto ends_there = [&](const auto& end) { return end.part == part && end.pin == pin; };
    return std::any_of(core_.wires.begin(), core_.wires.end(),
                       [&](const CoreWire& wire) { return wire.to == part && wire.input == pin; }) ||
           std::any_of(core_.ports.begin(), core_.ports.end(), [&](const CorePort& port) {
             return std::any_of(port.ends.begin(), port.ends.end(), ends_there);
           });
  }
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

  void add_port(const CorePin& of) {
    CorePort port{.pin = {.name = std::string(of.name),
                          .role = Pin::Role::data,
                          .channel = "",
                          .is_input = of.from.empty()},
                  .ends = {}};
    for (std::size_t i = 0; i < core_.parts.size(); ++i) {
      const CorePart& part = core_.parts[i];
      if (!of.from.empty() && part.name != of.from) continue;
      const std::vector<Pin>& pins = part.interface.pins;
      for (std::size_t j = 0; j < pins.size(); ++j)
        if (pins[j].name == of.name && pins[j].is_input == of.from.empty() && !is_driven(i, j))
          port.ends.push_back({i, j});
    }
    if (port.ends.empty()) throw std::logic_error(fmt::format("core: no part has the pin {}", of.name));
    const CorePort::End& first = port.ends.front();
    const Pin& pin = core_.parts[first.part].interface.pins[first.pin];
    port.pin.width = pin.width;
    port.pin.is_signed = pin.is_signed;
    port.pin.comment = of.comment;
    for (const CorePort::End& end : port.ends)
      if (core_.parts[end.part].interface.pins[end.pin].width != port.pin.width)
        throw std::logic_error(fmt::format("core: {} has two widths", of.name));
    core_.ports.push_back(std::move(port));
  }

  Core core_;
  const Library& library_;
};

/// "walker_goes": the wire of an output. A pin of the core has its own name.
class Nets {
 public:
  explicit Nets(const Core& core) : core_(core) {}

  [[nodiscard]] std::string declarations() const {
    std::string text;
    for (const CorePart& part : core_.parts)
      for (const Pin& pin : part.interface.pins)
        if (!pin.is_input) text += fmt::format("  wire {}{};\n", vector_range(pin.width), net(part, pin));
    return text;
  }
  [[nodiscard]] std::string instance(std::size_t place) const {
    const CorePart& part = core_.parts[place];
    std::vector<std::string> connections;
    for (std::size_t i = 0; i < part.interface.pins.size(); ++i) {
      const Pin& pin = part.interface.pins[i];
      connections.push_back(
          fmt::format("    .{}({})", pin.name, pin.is_input ? source(place, i) : net(part, pin)));
    }
    const std::string tags =
        part.design == nullptr ? "" : fmt::format(" #(.TAG_BITS({}))", core_.options.ray_bits());
    return fmt::format("  {}{} {} (\n{}\n  );\n", part.interface.module, tags, part.name,
                       fmt::join(connections, ",\n"));
  }
  [[nodiscard]] std::string outputs() const {
    std::string text;
    for (const CorePort& port : core_.ports)
      if (!port.pin.is_input) {
        const CorePart& part = core_.parts[port.ends.front().part];
        text += fmt::format("  assign {} = {};\n", port.pin.name,
                            net(part, part.interface.pins[port.ends.front().pin]));
      }
    return text;
  }

 private:
  static std::string net(const CorePart& part, const Pin& pin) {
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

std::string part_verilog(const CorePart& part, const Library& library) {
  const std::string bits = to_string(part.format);
  if (part.graph) return to_verilog(*part.graph, {.module = part.interface.module, .bits = bits});
  return to_verilog(*part.pipeline, library,
                    {.module_name = part.interface.module,
                     .bits = bits,
                     .flow_control = FlowControl::none,
                     .operands = part.design->ports(part.format),
                     .results = part.design->results(part.format)});
}

}  // namespace

int CoreOptions::ray_bits() const {
  return std::max(1, hls::count_bits(rays));
}

const CorePart& Core::part(std::string_view name) const {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const CorePart& part) { return part.name == name; });
  if (found == parts.end()) throw std::logic_error(fmt::format("core: there is no part {}", name));
  return *found;
}

ModuleInterface Core::interface() const {
  ModuleInterface made{module, {{"clk", Pin::Role::clock, "", true}, {"rst", Pin::Role::reset, "", true}}};
  for (const CorePort& port : ports) made.pins.push_back(port.pin);
  return made;
}

Core make_core(const CoreOptions& options, const Library& library, const std::string& module) {
  check(options);
  return Maker(options, library, module).made();
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
  for (const CorePart& part : core.parts) text += "\n" + part_verilog(part, library);
  return text + "/* verilator lint_on DECLFILENAME */\n";
}

}  // namespace hitpipe::rtl
