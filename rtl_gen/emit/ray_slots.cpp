#include "rtl_gen/emit/ray_slots.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/verilog/body.hpp"

namespace hitpipe::rtl {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array own_names{"clk",        "rst",        "ray_valid", "ray_ready",   "ray_end_only",
                               "ray_slot",   "in_valid",   "in_ready",  "in_tag",      "in_slot",
                               "out_valid",  "out_ready",  "out_tag",   "line_memory", "end_memory",
                               "line_read",  "end_read",   "test_read", "tag_read",    "read",
                               "read_valid", "unit_ready", "TAG_BITS",  "unit_i",      "written"};

int total_bits(const std::vector<Port>& ports) {
  int bits = 0;
  for (const Port& port : ports) bits += port.width;
  return bits;
}

std::string names_of(const std::vector<Port>& ports, const char* separator) {
  std::vector<std::string> each;
  for (const Port& port : ports) each.push_back(port.name);
  return fmt::format("{}", fmt::join(each, separator));
}

/// Some operands as one word, the first in the high bits.
struct Word {
  const std::vector<Port>& ports;
  const char* read;  ///< the register that holds the word while its test enters the unit

  [[nodiscard]] int width() const { return total_bits(ports); }
  [[nodiscard]] std::string value() const { return fmt::format("{{{}}}", names_of(ports, ", ")); }
  [[nodiscard]] std::string declaration() const {
    return fmt::format("  reg {}{};\n", vector_range(width()), read);
  }
  void connect(std::vector<std::string>& connections) const {
    int high = width();
    for (const Port& port : ports) {
      const int low = high - port.width;
      const std::string bits = width() == 1      ? ""
                               : port.width == 1 ? fmt::format("[{}]", low)
                                                 : fmt::format("[{}:{}]", high - 1, low);
      connections.push_back(fmt::format("    .{}({}{})", port.name, read, bits));
      high = low;
    }
  }
};

std::string memory(const Word& word, const char* name, int slots, const char* enable) {
  return fmt::format(
      "\n  reg {0}{1} [0:{2}];\n{3}"
      "  always @(posedge clk) if ({4}) {1}[ray_slot] <= {5};\n"
      "  always @(posedge clk) if (read) {6} <= {1}[in_slot];\n",
      vector_range(word.width()), name, slots - 1, word.declaration(), enable, word.value(), word.read);
}

void add_inputs(std::vector<std::string>& list, const std::vector<Port>& ports) {
  for (const Port& port : ports)
    list.push_back(fmt::format("input  wire {}{}", vector_range(port.width), port.name));
}

std::vector<std::string> port_list(const RaySlots& slots) {
  const std::string slot = vector_range(slots.slot_bits);
  std::vector<std::string> list{"input  wire clk", "input  wire rst", "input  wire ray_valid",
                                "output wire ray_ready"};
  if (!slots.end.empty()) list.emplace_back("input  wire ray_end_only");
  list.push_back(fmt::format("input  wire {}ray_slot", slot));
  add_inputs(list, slots.line);
  add_inputs(list, slots.end);
  for (const char* const port :
       {"input  wire in_valid", "output wire in_ready", "input  wire [TAG_BITS-1:0] in_tag"})
    list.emplace_back(port);
  list.push_back(fmt::format("input  wire {}in_slot", slot));
  add_inputs(list, slots.test);
  for (const char* const port :
       {"output wire out_valid", "input  wire out_ready", "output wire [TAG_BITS-1:0] out_tag"})
    list.emplace_back(port);
  for (const hls::Result& result : slots.results)
    list.push_back(fmt::format("output wire {}{}", vector_range(result.width), result.name));
  return list;
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
      case hls::Role::other:
        all.push_back(SentWith::test);
        break;
    }
  }
  return all;
}

int RaySlots::bits_without() const {
  return total_bits(line) + total_bits(end) + total_bits(test);
}

int RaySlots::bits_of_test() const {
  return slot_bits + total_bits(test);
}

int RaySlots::bits_of_ray() const {
  return slot_bits + total_bits(line) + total_bits(end) + (end.empty() ? 0 : 1);
}

int RaySlots::bits_of_end() const {
  return end.empty() ? 0 : slot_bits + 1 + total_bits(end);
}

void check_ray_slots(FlowControl flow) {
  if (flow != FlowControl::stall)
    throw std::invalid_argument(fmt::format("ray slots: flow control {}; allowed is {}",
                                            flow_control_name(flow), flow_control_name(FlowControl::stall)));
}

int slot_count(int least) {
  if (least < RaySlots::fewest || least > RaySlots::most)
    throw std::runtime_error(
        fmt::format("{} ray slots: allowed is {} to {}", least, RaySlots::fewest, RaySlots::most));
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(least)));
}

RaySlots ray_slots(const std::string& unit, const std::vector<Port>& ports, const std::vector<Port>& operands,
                   const std::vector<hls::Result>& results, int least) {
  RaySlots slots{.unit = unit,
                 .line = {},
                 .end = {},
                 .test = {},
                 .line_places = {},
                 .end_places = {},
                 .results = results};
  slots.slot_bits = std::countr_zero(static_cast<unsigned>(slot_count(least)));
  const std::vector<SentWith> parts = sent_with(operands);
  std::vector<Port> named = result_ports(results);
  named.insert(named.end(), ports.begin(), ports.end());
  for (const Port& port : named) {
    if (std::find(own_names.begin(), own_names.end(), port.name) != own_names.end())
      throw std::runtime_error(
          fmt::format("{}: its port {} has the name of one of {}", unit, port.name, slots.module()));
  }
  for (const Port& port : ports) {
    const std::size_t place = index_of(operands, port.name);
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
  if (slots.line.empty())
    throw std::runtime_error(
        fmt::format("{}: none of its operands says where a ray lies, so slots would "
                    "hold nothing of it",
                    unit));
  return slots;
}

std::string to_verilog(const RaySlots& slots) {
  const bool ends = !slots.end.empty();
  const Word line{slots.line, "line_read"};
  const Word end{slots.end, "end_read"};
  const Word test{slots.test, "test_read"};
  std::string memories =
      memory(line, "line_memory", slots.slots(), ends ? "written & ~ray_end_only" : "written");
  if (ends) memories += memory(end, "end_memory", slots.slots(), "written");
  std::vector<std::string> connections;
  for (const Word& word : {line, end, test}) word.connect(connections);
  for (const hls::Result& result : slots.results)
    connections.push_back(fmt::format("    .{0}({0})", result.name));
  const bool tests = !slots.test.empty();
  return fmt::format(
      R"(// {0} behind a memory of {2} rays: write a ray to a slot, then send tests that name the slot.
// {3}A test sees what was written at earlier edges; it is taken one edge after a write to its slot or
// later. Results come one cycle later than those of {0}.
// Generated by hitpipe; do not edit.
module {1} #(
  parameter TAG_BITS = 16
) (
  {4}
);
  // Writes never wait. A test of the slot that is being written does, so that no memory is read where it is
  // written.
  assign ray_ready = 1'b1;
  wire written = ray_valid;
  reg read_valid;  // a test stands before the unit
  wire unit_ready;
  assign in_ready = (unit_ready | ~read_valid) & ~(written & (ray_slot == in_slot));
  wire read = in_valid & in_ready;
  always @(posedge clk) begin
    if (rst) read_valid <= 1'b0;
    else if (unit_ready | ~read_valid) read_valid <= read;
  end
{5}
{6}  reg [TAG_BITS-1:0] tag_read;
  always @(posedge clk) begin
    if (read) begin
{7}      tag_read <= in_tag;
    end
  end

  {0} #(.TAG_BITS(TAG_BITS)) unit_i (
    .clk(clk), .rst(rst),
    .in_valid(read_valid), .in_ready(unit_ready), .in_tag(tag_read),
    .out_valid(out_valid), .out_ready(out_ready), .out_tag(out_tag),
{8}
  );
endmodule
)",
      slots.unit, slots.module(), slots.slots(),
      ends ? fmt::format("With ray_end_only a write changes {} and nothing else.\n// ",
                         names_of(slots.end, ", "))
           : "",
      fmt::join(port_list(slots), ",\n  "), memories, tests ? test.declaration() : "",
      tests ? fmt::format("      test_read <= {};\n", test.value()) : "", fmt::join(connections, ",\n"));
}

std::string with_ray_slots(const std::string& manifest, const RaySlots& slots) {
  Json json = Json::parse(manifest);
  Json ports = Json::array();
  const auto add = [&](const std::string& name, const char* direction, const Json& width, bool is_signed) {
    ports.push_back({{"name", name}, {"direction", direction}, {"width", width}, {"signed", is_signed}});
  };
  const auto add_operands = [&](const std::vector<Port>& operands) {
    for (const Port& port : operands) add(port.name, "in", port.width, port.is_signed);
  };
  for (const char* const name : {"clk", "rst", "ray_valid"}) add(name, "in", 1, false);
  add("ray_ready", "out", 1, false);
  if (!slots.end.empty()) add("ray_end_only", "in", 1, false);
  add("ray_slot", "in", slots.slot_bits, false);
  add_operands(slots.line);
  add_operands(slots.end);
  add("in_valid", "in", 1, false);
  add("in_ready", "out", 1, false);
  add("in_tag", "in", "TAG_BITS", false);
  add("in_slot", "in", slots.slot_bits, false);
  add_operands(slots.test);
  add("out_valid", "out", 1, false);
  add("out_ready", "in", 1, false);
  add("out_tag", "out", "TAG_BITS", false);
  for (const hls::Result& result : slots.results) add(result.name, "out", result.width, result.is_signed);

  Json memories = Json::array();
  const auto add_memory = [&](const char* name, const std::vector<Port>& operands) {
    if (operands.empty()) return;
    Json held = Json::array();
    for (const Port& port : operands) held.push_back(port.name);
    memories.push_back({{"name", name},
                        {"words", slots.slots()},
                        {"width", total_bits(operands)},
                        {"bits", slots.slots() * total_bits(operands)},
                        {"operands", held}});
  };
  add_memory("line_memory", slots.line);
  add_memory("end_memory", slots.end);
  Json bits{{"test_without_slots", slots.bits_without()},
            {"test", slots.bits_of_test()},
            {"ray", slots.bits_of_ray()}};
  if (!slots.end.empty()) bits["end_only"] = slots.bits_of_end();
  json["ray_slots"] = {{"module", slots.module()},
                       {"file", slots.module() + ".v"},
                       {"slots", slots.slots()},
                       {"latency", json.at("latency").get<int>() + 1},
                       {"memories", memories},
                       {"bits", bits},
                       {"ports", ports}};
  return json.dump(2) + "\n";
}

}  // namespace hitpipe::rtl
