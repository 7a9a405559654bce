#include "rtl_gen/core/axi.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "hls/machines/beats.hpp"
#include "hls/machines/registers.hpp"
#include "rtl_gen/core/identity.hpp"
#include "rtl_gen/machine/module.hpp"

namespace hitpipe::rtl {

namespace {

namespace channels = hls::channels;

constexpr int counter_bits = 40;
/// Above the core's identifiers. Few resets come while a read is on its way.
constexpr int epoch_bits = 2;

/// Ports of the core whose name begins so, without its beginning, but valid, ready and tag.
std::vector<Port> ports_of(const Core& core, std::string_view before) {
  std::vector<Port> ports;
  for (const CorePort& port : core.ports) {
    const std::string& name = port.pin.name;
    if (!name.starts_with(before)) continue;
    const std::string rest = name.substr(before.size());
    if (rest == "valid" || rest == "ready" || rest == "tag") continue;
    ports.push_back({rest, port.pin.width, port.pin.is_signed});
    ports.back().comment = port.pin.comment;
    const CorePort::End& end = port.ends.front();
    if (const Part& part = core.parts[end.part]; part.design != nullptr) {
      const std::vector<Port> operands = part.design->ports(part.format);
      if (const auto operand = index_of(operands, rest)) ports.back().kind = operands[*operand].kind;
    }
  }
  return ports;
}

/// A machine around the core.
struct Around {
  Around(const Core& core, std::string machine, const Format& format)
      : name(std::move(machine)),
        module(core.module + "_" + name),
        graph(machine_called(name)->graph(format)),
        interface(machine_interface(module, graph)),
        verilog(to_verilog(graph, {.module = module, .bits = to_string(format)})) {}

  std::string name;
  std::string module;
  MachineGraph graph;
  ModuleInterface interface;
  std::string verilog;
};

std::vector<Around> machines_around(const Core& core) {
  const CoreOptions& options = core.options;
  std::vector<Around> machines;
  machines.emplace_back(
      core, "registers",
      hls::RegisterBits{options.address_bits, options.byte_bits, options.ray_bits(), counter_bits});
  if (options.has_one_id())
    machines.emplace_back(core, "beats", hls::BeatBits{options.data_bits, options.ray_bits()});
  return machines;
}

ModuleInterface interface_of(const Core& core) {
  using Role = Pin::Role;
  ModuleInterface made{axi_module(core),
                       {{axi_clock, Role::clock, "", true}, {"aresetn", Role::reset, "", true}}};
  const auto add = [&](const std::string& channel, bool is_input,
                       const std::vector<std::pair<std::string, int>>& data) {
    made.pins.push_back({channel + "valid", Role::valid, channel, is_input});
    made.pins.push_back({channel + "ready", Role::ready, channel, !is_input});
    for (const auto& [name, width] : data)
      made.pins.push_back({channel + name, Role::data, channel, is_input, width});
  };
  const int tag = core.options.tag_bits;
  const std::vector<std::pair<std::string, int>> none,
      id{{"id", core.pin(channels::request_id).width + epoch_bits}};
  const auto& ids = core.options.has_one_id() ? none : id;
  const auto with_ids = [&](std::vector<std::pair<std::string, int>> data) {
    data.insert(data.begin() + 1, ids.begin(), ids.end());
    return data;
  };
  add("s_axi_aw", true, {{"addr", 8}});
  add("s_axi_w", true, {{"data", 32}, {"strb", 4}});
  add("s_axi_b", false, {{"resp", 2}});
  add("s_axi_ar", true, {{"addr", 8}});
  add("s_axi_r", false, {{"data", 32}, {"resp", 2}});
  add("s_axis_ray_t", true, {{"data", stream_bits(ray_ports(core))}, {"id", tag}});
  add("m_axis_hit_t", false, {{"data", stream_bits(hit_ports(core))}, {"id", tag}});
  add("m_axi_ar", false,
      with_ids({{"addr", core.options.byte_bits},
                {"len", 8},
                {"size", 3},
                {"burst", 2},
                {"cache", 4},
                {"prot", 3}}));
  add("m_axi_r", true, with_ids({{"data", core.options.data_bits}, {"resp", 2}, {"last", 1}}));
  return made;
}

/// What each port of the core, of its registers and of `beats` is joined to. What passes between the core and its
/// surroundings has two wires: that of the core is core_..., and the registers let it through.
class Connections {
 public:
  /// `bits` are those of the beat of a ray, for each of its fields.
  Connections(const Core& core, const std::vector<Port>& fields, const std::vector<std::string>& bits) {
    const bool has_one_id = core.options.has_one_id();
    for (std::size_t i = 0; i < fields.size(); ++i) ends_["ray_" + fields[i].name] = bits[i];
    for (const auto& [port, pin] :
         std::vector<std::pair<const char*, const char*>>{{"clk", axi_clock},
                                                          {"rst", "~aresetn"},
                                                          {"ray_valid", "s_axis_ray_tvalid"},
                                                          {"ray_ready", "s_axis_ray_tready"},
                                                          {"ray_tag", "s_axis_ray_tid"},
                                                          {"hit_valid", "m_axis_hit_tvalid"},
                                                          {"hit_ready", "m_axis_hit_tready"},
                                                          {"hit_tag", "m_axis_hit_tid"},
                                                          {"request_valid", "m_axi_arvalid"},
                                                          {"request_ready", "m_axi_arready"},
                                                          {"request_address", "m_axi_araddr"},
                                                          {"request_upper", "m_axi_araddr[5]"},
                                                          {"beat_valid", "m_axi_rvalid"},
                                                          {"beat_error", "m_axi_rresp[1]"},
                                                          {"beat_ready", "m_axi_rready"}})
      ends_[port] = pin;
    for (int i = 0; i < 8; ++i)
      ends_[fmt::format("{}_{}", has_one_id ? "beat" : "read_word", i)] =
          fmt::format("m_axi_rdata[{}:{}]", 64 * i + 63, 64 * i);
    if (!has_one_id) {
      ends_["read_id"] = fmt::format("m_axi_rid[{}:0]", core.pin(channels::read_id).width - 1);
      ends_["read_error"] = "m_axi_rresp[1]";
    }
    const CoreIdentity identity = identity_of(core.options);
    ends_["about_format"] = fmt::format("32'h{:08x}", identity.format);
    ends_["about_shape"] = fmt::format("32'h{:08x}", identity.shape);
    ends_["about_ports"] = fmt::format("32'h{:08x}", identity.ports);
    for (const char* const lite :
         {"awvalid", "awready", "awaddr", "wvalid", "wready", "wdata", "wstrb", "bvalid", "bready", "bresp",
          "arvalid", "arready", "araddr", "rvalid", "rready", "rdata", "rresp"})
      ends_[lite] = fmt::format("s_axi_{}", lite);
  }

  using Ends = std::map<std::string, std::string, std::less<>>;
  /// `own` are the ends that this instance alone has.
  [[nodiscard]] std::string instance(const ModuleInterface& inside, const std::string& name,
                                     const Ends& own = {}) const {
    std::vector<std::string> list;
    for (const Pin& pin : inside.pins) {
      std::string end = pin.name;
      for (const Ends& ends : {ends_, own})
        if (const auto found = ends.find(pin.name); found != ends.end()) end = found->second;
      list.push_back(fmt::format("    .{}({})", pin.name, end));
    }
    return fmt::format("  {} {} (\n{}\n  );\n", inside.module, name, fmt::join(list, ",\n"));
  }

 private:
  Ends ends_;
};

/// The registers say what passes.
constexpr std::string_view gates = R"(
  assign core_ray_valid = s_axis_ray_tvalid & lets_rays;
  assign s_axis_ray_tready = core_ray_ready & lets_rays;
  assign m_axis_hit_tvalid = core_hit_valid & lets_answers;
  assign core_hit_ready = m_axis_hit_tready & lets_answers;
  assign m_axi_arvalid = core_request_valid & lets_requests;
  assign core_request_ready = m_axi_arready & lets_requests;
)";

/// {0}: the highest bit of an epoch, {1}: how many bits it has, {2} and {3}: its lowest and its highest bit in an
/// identifier.
constexpr const char* with_identifiers = R"(
  // A reset may come while reads are on their way. What they give has the epoch before, and is dropped.
  reg [{0}:0] epoch;
  reg was_reset;
  initial begin
    epoch = {1}'d0;
    was_reset = 1'b0;
  end
  always @(posedge aclk) begin
    was_reset <= ~aresetn;
    if (~aresetn & ~was_reset) epoch <= epoch + {1}'d1;
  end
  assign m_axi_arid = {{epoch, request_id}};
  assign read_valid = m_axi_rvalid & m_axi_rid[{3}:{2}] == epoch;
  assign m_axi_rready = 1'b1;  // a block is taken at once
)";

/// The fields of a word, the high ones first, with zeros between.
std::string joined(const std::vector<Port>& ports, std::string_view before) {
  std::vector<std::string> parts;
  for (const StreamField& field : stream_fields(ports)) {
    const int padding = (8 - field.width % 8) % 8;
    parts.push_back(fmt::format("{}{}", before, field.name));
    if (padding > 0) parts.push_back(fmt::format("{}'d0", padding));
  }
  std::reverse(parts.begin(), parts.end());
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

}  // namespace

std::string axi_module(const Core& core) {
  return core.module + "_axi";
}
std::vector<MachineGraph> axi_machines(const Core& core) {
  std::vector<MachineGraph> graphs;
  for (Around& machine : machines_around(core)) graphs.push_back(std::move(machine.graph));
  return graphs;
}
std::vector<Port> ray_ports(const Core& core) {
  return ports_of(core, "ray_");
}
std::vector<Port> hit_ports(const Core& core) {
  return ports_of(core, "hit_");
}

std::string axi_verilog(const Core& core) {
  const CoreOptions& options = core.options;
  const std::vector<Around> machines = machines_around(core);
  const BeatText ray(ray_ports(core), "s_axis_ray_tdata"), hit(hit_ports(core), "m_axis_hit_tdata");
  const Connections connections(core, ray_ports(core), ray.bits);
  std::string wires;
  const auto wire = [&](const std::string& name, int width) {
    wires += fmt::format("  wire {}{};\n", vector_range(width), name);
  };
  for (const Port& port : hit_ports(core)) wire("hit_" + port.name, port.width);
  const auto join = [&]<auto... Fields>(hls::List<Fields...>) {
    (wire(Fields.name(), core.pin(Fields).width), ...);
  };
  join(channels::Settings::Items());
  for (const char* const gate :
       {"lets_rays", "lets_requests", "lets_answers", "resets", "core_ray_valid", "core_ray_ready",
        "core_hit_valid", "core_hit_ready", "core_request_valid", "core_request_ready"})
    wire(gate, 1);
  const int id_bits = core.pin(channels::request_id).width;
  wire(channels::request_id.name(), id_bits);
  std::string instances = connections.instance(core.interface(), "core_i",
                                               {{"rst", "~aresetn | resets"},
                                                {"ray_valid", "core_ray_valid"},
                                                {"ray_ready", "core_ray_ready"},
                                                {"hit_valid", "core_hit_valid"},
                                                {"hit_ready", "core_hit_ready"},
                                                {"request_valid", "core_request_valid"},
                                                {"request_ready", "core_request_ready"}});
  std::string modules;
  for (const Around& machine : machines) {
    instances += connections.instance(machine.interface, machine.name + "_i");
    modules += (modules.empty() ? "" : "\n") + machine.verilog;
  }
  std::string between(gates);
  if (options.has_one_id()) {
    join(channels::BlockRead::Items());
  } else {
    wire(channels::read_valid.name(), 1);
    between += fmt::format(with_identifiers, epoch_bits - 1, epoch_bits, id_bits, id_bits + epoch_bits - 1);
  }
  std::vector<std::string> unused = ray.padding;
  unused.insert(unused.end(), {"m_axi_rresp[0]", "m_axi_rlast"});
  return fmt::format(
             R"(// The core {0} behind AXI: rays and answers by AXI4-Stream, registers by AXI4-Lite, blocks by AXI4.
// Fields of s_axis_ray_tdata:
{1}// Fields of m_axis_hit_tdata:
{2}// Generated by hitpipe; do not edit.
{3}{4}
{5}
  assign m_axis_hit_tdata = {6};
  // A block has 32 bytes and is aligned to 32.
  assign m_axi_arlen = 8'd{7};
  assign m_axi_arsize = 3'd{8};
  assign m_axi_arburst = 2'd1;
  assign m_axi_arcache = 4'd3;
  assign m_axi_arprot = 3'd0;
{9}
  wire unused = &{{1'b0, {10}}};
endmodule

/* verilator lint_off DECLFILENAME */

)",
             core.module, ray.layout, hit.layout, interface_of(core).head(), wires, instances,
             joined(hit_ports(core), "hit_"), options.beats() - 1,
             hls::count_bits(CoreOptions::block_bits / options.beats() / 8), between,
             fmt::join(unused, ", ")) +
         modules + "/* verilator lint_on DECLFILENAME */\n";
}

Json axi_json(const Core& core) {
  const auto side = [](const std::vector<Port>& ports) {
    Json fields = Json::array();
    for (const StreamField& field : stream_fields(ports))
      fields.push_back({{"name", field.name}, {"offset", field.offset}, {"width", field.width}});
    return Json{{"tdata_bits", stream_bits(ports)}, {"fields", fields}};
  };
  return {{"module", axi_module(core)},
          {"verilog", axi_module(core) + ".v"},
          {"header", core.module + ".h"},
          {"data_bits", core.options.data_bits},
          {"has_one_id", core.options.has_one_id()},
          {"s_axis_ray", side(ray_ports(core))},
          {"m_axis_hit", side(hit_ports(core))}};
}

}  // namespace hitpipe::rtl
