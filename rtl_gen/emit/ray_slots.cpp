#include "rtl_gen/emit/ray_slots.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/result_fifo.hpp"

namespace hitpipe::rtl {

namespace {

std::string names_of(const std::vector<Port>& ports, const char* separator) {
  std::vector<std::string> each;
  for (const Port& port : ports) each.push_back(port.name);
  return fmt::format("{}", fmt::join(each, separator));
}

/// Some operands as one word, the first in the high bits.
struct MemoryWord {
  const std::vector<Port>& ports;
  const char* read;  ///< the register that holds the word while its test enters the unit

  [[nodiscard]] int width() const { return total_width(ports); }
  [[nodiscard]] std::string value() const { return fmt::format("{{{}}}", names_of(ports, ", ")); }
  [[nodiscard]] std::string declaration() const {
    return fmt::format("  reg {}{};\n", vector_range(width()), read);
  }
  /// Adds the bits of each port, by its name.
  void add_bits(std::map<std::string, std::string>& wires) const {
    int high = width();
    for (const Port& port : ports) {
      const int low = high - port.width;
      wires[port.name] = read + (width() == 1      ? ""
                                 : port.width == 1 ? fmt::format("[{}]", low)
                                                   : fmt::format("[{}:{}]", high - 1, low));
      high = low;
    }
  }
};

std::string memory(const MemoryWord& word, const char* name, int slots, const char* enable) {
  return fmt::format(
      "\n  reg {0}{1} [0:{2}];\n{3}"
      "  always @(posedge clk) if ({4}) {1}[ray_slot] <= {5};\n"
      "  always @(posedge clk) if (read) {6} <= {1}[in_slot];\n",
      vector_range(word.width()), name, slots - 1, word.declaration(), enable, word.value(), word.read);
}

/// The channel "ray", of writes, and the unit's channels with a slot in place of the ray's operands.
ModuleInterface interface_of(const RaySlots& slots) {
  using Role = Pin::Role;
  const std::string ray = "ray";
  // Tests wait for writes, so they have ready even if results do not wait.
  constexpr int with_ready = 2;
  const ModuleInterface inside =
      unit_interface(slots.unit.module + "_slots", {}, {}, slots.inside.flow_control(), with_ready);
  ModuleInterface made{inside.module, {}, slots.unit.interval};
  const auto add_channel = [&](const std::string& channel) {
    for (const Pin& pin : inside.pins)
      if (pin.channel == channel) made.pins.push_back(pin);
  };
  const auto add_slot = [&](const std::string& channel) {
    add_data(made.pins, channel, true, {{channel + "_slot", slots.slot_bits, false}});
  };
  add_channel("");
  made.pins.push_back({"ray_valid", Role::valid, ray, true});
  made.pins.push_back({"ray_ready", Role::ready, ray, false});
  if (!slots.end.empty()) add_data(made.pins, ray, true, {{"ray_end_only", 1, false}});
  add_slot(ray);
  add_data(made.pins, ray, true, slots.line);
  add_data(made.pins, ray, true, slots.end);
  add_channel(tests_channel);
  add_slot(tests_channel);
  add_data(made.pins, tests_channel, true, slots.test);
  add_channel(results_channel);
  add_data(made.pins, results_channel, false, slots.unit.results());
  return made;
}

}  // namespace

std::vector<SentWith> sent_with(const std::vector<Port>& ports) {
  const bool of_parent =
      std::any_of(ports.begin(), ports.end(), [](const Port& port) { return port.role == hls::Role::entry; });
  std::vector<SentWith> all;
  for (const Port& port : ports) {
    switch (port.role) {
      case hls::Role::origin:
      case hls::Role::origin_high:
      case hls::Role::direction:
      case hls::Role::inverse:
      case hls::Role::inverse_low:
      case hls::Role::inverse_high:
      case hls::Role::exponent:
      case hls::Role::backward:
      case hls::Role::major:
        all.push_back(SentWith::line);
        break;
      case hls::Role::endpoint:
      case hls::Role::endless:
        all.push_back(SentWith::end);
        break;
      case hls::Role::length:
        all.push_back(of_parent ? SentWith::test : SentWith::end);
        break;
      case hls::Role::plane_low:
      case hls::Role::plane_high:
      case hls::Role::entry:
      case hls::Role::owner:
      case hls::Role::corner:
      case hls::Role::other:
        all.push_back(SentWith::test);
        break;
    }
  }
  return all;
}

int RaySlots::bits_without() const {
  return total_width(line) + total_width(end) + total_width(test);
}

int RaySlots::bits_of_test() const {
  return slot_bits + total_width(test);
}

int RaySlots::bits_of_ray() const {
  return slot_bits + total_width(line) + total_width(end) + (end.empty() ? 0 : 1);
}

int RaySlots::bits_of_end() const {
  return end.empty() ? 0 : slot_bits + 1 + total_width(end);
}

int RaySlots::latency(int unit_latency) const {
  return unit_latency + (inside.flow_control() == FlowControl::none ? unit.interval : 1);
}

int slot_count(int least) {
  if (least < RaySlots::fewest || least > RaySlots::most)
    throw std::runtime_error(
        fmt::format("{} ray slots: allowed is {} to {}", least, RaySlots::fewest, RaySlots::most));
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(least)));
}

RaySlots ray_slots(const ModuleInterface& unit, const std::vector<Port>& operands, int least, bool fifo) {
  RaySlots slots{.unit = unit,
                 .inside = fifo ? fifo_interface(unit) : unit,
                 .interface = {},
                 .slot_bits = std::countr_zero(static_cast<unsigned>(slot_count(least))),
                 .line = {},
                 .end = {},
                 .test = {},
                 .line_places = {},
                 .end_places = {}};
  const std::vector<SentWith> parts = sent_with(operands);
  for (const Port& port : unit.operands()) {
    const std::size_t place = index_of(operands, port.name).value();
    switch (parts.at(place)) {
      case SentWith::line:
        slots.line.push_back(port);
        slots.line_places.push_back(place);
        break;
      case SentWith::end:
        slots.end.push_back(port);
        slots.end_places.push_back(place);
        break;
      case SentWith::test:
        slots.test.push_back(port);
        break;
    }
  }
  slots.interface = interface_of(slots);
  check_names(slots.interface, unit,
              {"ray_end_only", "line_memory", "end_memory", "line_read", "end_read", "test_read", "tag_read",
               "read", "read_valid", "unit_ready", "unit_i", "written"});
  if (slots.line.empty())
    throw std::runtime_error(
        fmt::format("{}: none of its operands says where a ray lies, so slots would "
                    "hold nothing of it",
                    unit.module));
  return slots;
}

std::string to_verilog(const RaySlots& slots) {
  const bool ends = !slots.end.empty();
  const MemoryWord line{slots.line, "line_read"};
  const MemoryWord end{slots.end, "end_read"};
  const MemoryWord test{slots.test, "test_read"};
  std::string memories =
      memory(line, "line_memory", slots.slots(), ends ? "written & ~ray_end_only" : "written");
  if (ends) memories += memory(end, "end_memory", slots.slots(), "written");
  std::map<std::string, std::string> wires{
      {"in_valid", "read_valid"}, {"in_ready", "unit_ready"}, {"in_tag", "tag_read"}};
  std::vector<Port> operands;
  for (const MemoryWord& word : {line, end, test}) {
    word.add_bits(wires);
    operands.insert(operands.end(), word.ports.begin(), word.ports.end());
  }
  const bool stalls = slots.inside.flow_control() == FlowControl::stall;
  const bool waits = slots.inside.has_ready(tests_channel);
  const std::string instance = unit_interface(slots.inside.module, operands, slots.unit.results(),
                                              slots.inside.flow_control(), slots.inside.interval)
                                   .instance("unit_i", "TAG_BITS", [&](const Pin& pin) {
                                     const auto found = wires.find(pin.name);
                                     return found == wires.end() ? pin.name : found->second;
                                   });
  const bool tests = !slots.test.empty();
  const char* const room = stalls ? "unit_ready | ~read_valid" : waits ? "unit_ready" : "";
  return fmt::format(
      R"(// {0} behind a memory of {1} rays: write a ray to a slot, then send tests that name the slot.
// {2}A test sees what was written at earlier edges; it is taken one edge after a write to its slot or
// later. {9}
// Generated by hitpipe; do not edit.
{3}  // Writes never wait. A test of the slot that is being written does, so that no memory is read where it is
  // written.
  assign ray_ready = 1'b1;
  wire written = ray_valid;
  reg read_valid;  // a test stands before the unit
{10}  assign in_ready = {11}~(written & (ray_slot == in_slot));
  wire read = in_valid & in_ready;
  always @(posedge clk) begin
    if (rst) read_valid <= 1'b0;
    else {12}read_valid <= read;
  end
{4}
{5}  reg {8} tag_read;
  always @(posedge clk) begin
    if (read) begin
{6}      tag_read <= in_tag;
    end
  end

{7}endmodule
)",
      slots.inside.module, slots.slots(),
      ends ? fmt::format("With ray_end_only a write changes {} and nothing else.\n// ",
                         names_of(slots.end, ", "))
           : "",
      slots.interface.head(), memories, tests ? test.declaration() : "",
      tests ? fmt::format("      test_read <= {};\n", test.value()) : "", instance, tag_range,
      stalls || slots.unit.interval == 1
          ? fmt::format("Results come one cycle later than from {}.", slots.inside.module)
          : fmt::format("Results come {} cycles later than from {}.", slots.unit.interval,
                        slots.inside.module),
      waits ? "  wire unit_ready;\n" : "",
      waits ? fmt::format("{} & ", stalls ? fmt::format("({})", room) : room) : "",
      waits ? fmt::format("if ({}) ", room) : "");
}

Json ray_slots_json(const RaySlots& slots, int unit_latency) {
  Json memories = Json::array();
  const auto add_memory = [&](const char* name, const std::vector<Port>& operands) {
    if (operands.empty()) return;
    Json held = Json::array();
    for (const Port& port : operands) held.push_back(port.name);
    memories.push_back({{"name", name},
                        {"words", slots.slots()},
                        {"width", total_width(operands)},
                        {"bits", slots.slots() * total_width(operands)},
                        {"operands", held}});
  };
  add_memory("line_memory", slots.line);
  add_memory("end_memory", slots.end);
  Json bits{{"test_without_slots", slots.bits_without()},
            {"test", slots.bits_of_test()},
            {"ray", slots.bits_of_ray()}};
  if (!slots.end.empty()) bits["end_only"] = slots.bits_of_end();
  return {{"module", slots.module()},
          {"file", slots.module() + ".v"},
          {"slots", slots.slots()},
          {"latency", slots.latency(unit_latency)},
          {"memories", memories},
          {"bits", bits},
          {"ports", ports_json(slots.interface)}};
}

}  // namespace hitpipe::rtl
