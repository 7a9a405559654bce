#include "rtl_gen/emit/axi_stream.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/result_fifo.hpp"

namespace hitpipe::rtl {

namespace {

int whole_bytes(int bits) {
  return (bits + 7) / 8 * 8;
}

std::string bits_of(const std::string& word, int high, int low) {
  return high == low ? fmt::format("{}[{}]", word, low) : fmt::format("{}[{}:{}]", word, high, low);
}

/// What the wrapper's text has for each result.
struct StreamText {
  explicit StreamText(const std::vector<Port>& ports) {
    std::vector<std::string> low_first, low_first_with_spare;
    for (const StreamField& field : stream_fields(ports)) {
      const std::string& name = field.name;
      layout.push_back(fmt::format("{} {}:{}", name, field.offset + field.width - 1, field.offset));
      spares += fmt::format("  reg {}spare_{};\n", vector_range(field.width), name);
      wires += fmt::format("  wire {}out_{};\n", vector_range(field.width), name);
      moves += fmt::format("      spare_{0} <= out_{0};\n", name);
      low_first.push_back("out_" + name);
      low_first_with_spare.push_back(fmt::format("spare_valid ? spare_{0} : out_{0}", name));
      const int padding = whole_bytes(field.width) - field.width;
      if (padding == 0) continue;
      low_first.push_back(fmt::format("{}'d0", padding));
      low_first_with_spare.push_back(low_first.back());
    }
    data = fmt::format("{}", fmt::join(low_first.rbegin(), low_first.rend(), ", "));
    data_with_spare =
        fmt::format("{}", fmt::join(low_first_with_spare.rbegin(), low_first_with_spare.rend(), ", "));
  }

  std::vector<std::string> layout;
  std::string spares, wires;
  std::string moves;                  ///< to the spare latches
  std::string data, data_with_spare;  ///< high fields first; of the unit, or of the spare latches if full
};

/// The wrapper as text. `inside` is the module that it contains, which has valid and ready.
struct Wrapper {
  Wrapper(const ModuleInterface& contained, bool stalls_inside)
      : inside(contained),
        result(inside.results()),
        stalls(stalls_inside),
        tests(inside.operands(), "s_axis_tdata") {}

  /// Each result NAME has a wire out_NAME and, behind a unit that stalls, a latch spare_NAME.
  [[nodiscard]] std::string instance() const {
    std::size_t next_test = 0;
    return inside.instance("design_i", "TAG_BITS", [&](const Pin& pin) -> std::string {
      if (pin.role == Pin::Role::clock) return "aclk";
      if (pin.role == Pin::Role::reset) return "~aresetn";
      if (pin.channel == tests_channel) {
        if (pin.role == Pin::Role::data) return tests.bits[next_test++];
        return pin.role == Pin::Role::tag ? "s_axis_tid" : "s_axis_t" + pin.name.substr(3);
      }
      if (pin.role == Pin::Role::data) return "out_" + pin.name;
      if (stalls) return pin.role == Pin::Role::ready ? "~spare_valid" : pin.name;
      return pin.role == Pin::Role::tag ? "m_axis_tid" : "m_axis_t" + pin.name.substr(4);
    });
  }

  [[nodiscard]] std::string unused() const {
    if (tests.padding.empty()) return "";
    return fmt::format("\n  // Padding.\n  wire unused = &{{1'b0, {}}};\n", fmt::join(tests.padding, ", "));
  }

  ModuleInterface inside;
  StreamText result;
  bool stalls;
  BeatText tests;
};

/// The fields of tdata, in port order from bit 0.
Json stream_side(const std::vector<Port>& ports) {
  Json fields = Json::array();
  for (const StreamField& field : stream_fields(ports))
    fields.push_back({{"name", field.name}, {"offset", field.offset}, {"width", field.width}});
  return {{"tdata_bits", stream_bits(ports)}, {"fields", fields}};
}

}  // namespace

std::vector<StreamField> stream_fields(const std::vector<Port>& ports) {
  std::vector<StreamField> fields;
  int offset = 0;
  for (const Port& port : ports) {
    fields.push_back({port.name, offset, port.width});
    offset += whole_bytes(port.width);
  }
  return fields;
}

BeatText::BeatText(const std::vector<StreamField>& fields, const std::string& word) {
  for (const StreamField& field : fields) {
    const int high = field.offset + field.width - 1;
    const int end = field.offset + whole_bytes(field.width) - 1;
    layout += fmt::format("//   {:>4}:{:<4} {}\n", high, field.offset, field.name);
    bits.push_back(bits_of(word, high, field.offset));
    if (end > high) padding.push_back(bits_of(word, end, high + 1));
  }
}

int stream_bits(const std::vector<Port>& ports) {
  int bits = 0;
  for (const Port& port : ports) bits += whole_bytes(port.width);
  return bits;
}

std::string stream_module(const std::string& module) {
  return module + "_axis";
}

ModuleInterface stream_interface(const ModuleInterface& unit) {
  using Role = Pin::Role;
  ModuleInterface stream{stream_module(unit.module),
                         {{"aclk", Role::clock, "", true}, {"aresetn", Role::reset, "", true}},
                         unit.interval};
  const auto add = [&](const std::string& channel, bool is_input, const std::vector<Port>& data) {
    stream.pins.push_back({channel + "_tvalid", Role::valid, channel, is_input});
    stream.pins.push_back({channel + "_tready", Role::ready, channel, !is_input});
    stream.pins.push_back({channel + "_tdata", Role::data, channel, is_input, stream_bits(data)});
    stream.pins.push_back({channel + "_tid", Role::tag, channel, is_input, Pin::tag_width});
  };
  add("s_axis", true, unit.operands());
  add("m_axis", false, unit.results());
  return stream;
}

std::string axi_stream(const ModuleInterface& unit) {
  const ModuleInterface stream = stream_interface(unit);
  const bool stalls = unit.flow_control() == FlowControl::stall;
  const Wrapper wrapper(stalls ? unit : fifo_interface(unit), stalls);
  const StreamText& result = wrapper.result;
  ModuleInterface results{unit.module, {}};
  add_data(results.pins, results_channel, false, unit.results());
  check_names(stream, results, {"valid", "tag"});
  const std::string text = fmt::format(
      R"(// {} behind AXI4-Stream, the tag as tid. m_axis_tdata: {}. s_axis_tdata:
{}// Generated by hitpipe; do not edit.
{})",
      unit.module, fmt::join(result.layout, ", "), wrapper.tests.layout, stream.head());
  if (!stalls)
    return text + fmt::format("{}{}  assign m_axis_tdata = {{{}}};\n{}endmodule\n", result.wires,
                              wrapper.instance(), result.data, wrapper.unused());
  return text +
         fmt::format(
             R"(  // Holds a result when m_axis_tready falls; the pipeline stands still until it is taken.
  reg spare_valid;
{3}  reg {6} spare_tag;
  wire out_valid;
{2}  wire {6} out_tag;

{0}
  always @(posedge aclk) begin
    if (~aresetn) spare_valid <= 1'b0;
    else spare_valid <= m_axis_tvalid & ~m_axis_tready;
  end
  always @(posedge aclk) begin
    if (~spare_valid) begin
{4}      spare_tag <= out_tag;
    end
  end
  assign m_axis_tvalid = spare_valid | out_valid;
  assign m_axis_tdata = {{{5}}};
  assign m_axis_tid = spare_valid ? spare_tag : out_tag;
{1}endmodule
)",
             wrapper.instance(), wrapper.unused(), result.wires, result.spares, result.moves,
             result.data_with_spare, tag_range);
}

Json stream_json(const ModuleInterface& unit) {
  const std::string module = stream_module(unit.module);
  Json json{{"module", module},
            {"file", module + ".v"},
            {"clock", "aclk, rising edge"},
            {"reset", "aresetn, synchronous, active low"},
            {"tid", "the tag, TAG_BITS"}};
  json["s_axis"] = stream_side(unit.operands());
  json["m_axis"] = stream_side(unit.results());
  return json;
}

}  // namespace hitpipe::rtl
