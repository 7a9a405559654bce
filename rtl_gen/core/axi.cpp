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
#include "hls/machines/rings.hpp"
#include "rtl_gen/core/axi_rings.hpp"
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
  machines.emplace_back(core, "registers",
                        hls::RegisterBits{options.address_bits, options.byte_bits, options.ray_bits(),
                                          counter_bits, options.has_cache() ? 1 : 0, options.rings ? 1 : 0});
  if (options.has_one_id() && !options.has_cache())
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
  if (core.options.rings) {
    for (Pin& pin : ring_pins(core)) made.pins.push_back(std::move(pin));
  } else {
    add("s_axis_ray_t", true, {{"data", stream_bits(ray_ports(core))}, {"id", tag}});
    add("m_axis_hit_t", false, {{"data", stream_bits(hit_ports(core))}, {"id", tag}});
  }
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
    const bool has_one_id = core.options.has_one_id(), has_cache = core.options.has_cache();
    if (core.options.rings)
      ends_ = ring_ends();
    else
      ends_.insert({{"ray_valid", "s_axis_ray_tvalid"},
                    {"ray_ready", "s_axis_ray_tready"},
                    {"ray_tag", "s_axis_ray_tid"},
                    {"hit_valid", "m_axis_hit_tvalid"},
                    {"hit_ready", "m_axis_hit_tready"},
                    {"hit_tag", "m_axis_hit_tid"}});
    for (std::size_t i = 0; i < bits.size(); ++i) ends_["ray_" + fields[i].name] = bits[i];
    for (const auto& [port, pin] : std::vector<std::pair<const char*, const char*>>{
             {"clk", axi_clock},
             {"rst", "~aresetn"},
             {"request_valid", "m_axi_arvalid"},
             {"request_ready", "m_axi_arready"},
             {"request_address", "m_axi_araddr"},
             {"request_upper", "m_axi_araddr[5]"},
             {"beat_valid", has_one_id ? "m_axi_rvalid" : "beat_valid"},
             {"beat_error", "m_axi_rresp[1]"},
             {"beat_ready", "m_axi_rready"}})
      ends_[port] = pin;
    for (int i = 0; i < 8; ++i)
      ends_[fmt::format("{}_{}", has_one_id || has_cache ? "beat" : "read_word", i)] =
          fmt::format("m_axi_rdata[{}:{}]", 64 * i + 63, 64 * i);
    const std::string id = fmt::format("m_axi_rid[{}:0]", core.pin(channels::request_id).width - 1);
    if (has_cache) {
      ends_["beat_id"] = id;
      ends_["line_asked"] = "m_axi_arvalid & m_axi_arready";
    } else if (!has_one_id) {
      ends_["read_id"] = id;
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
)";
/// Without a cache. A cache asks for all lines that its rays want.
constexpr std::string_view gate_of_requests = R"(  assign m_axi_arvalid = core_request_valid & lets_requests;
  assign core_request_ready = m_axi_arready & lets_requests;
)";

/// {0}: the highest bit of an epoch, {1}: how many bits it has, {2} and {3}: its lowest and its highest bit in an
/// identifier, {4}: what is valid then.
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
  assign {4} = m_axi_rvalid & m_axi_rid[{3}:{2}] == epoch;
)";
constexpr std::string_view takes_all = "  assign m_axi_rready = 1'b1;  // a block is taken at once\n";

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
  return core.options.rings ? ring_ray_ports(core) : ports_of(core, "ray_");
}
std::vector<Port> hit_ports(const Core& core) {
  return core.options.rings ? ring_hit_ports(core) : ports_of(core, "hit_");
}
std::vector<StreamField> ray_fields(const Core& core) {
  return core.options.rings ? ring_ray_fields(core) : stream_fields(ray_ports(core));
}
std::vector<StreamField> hit_fields(const Core& core) {
  return core.options.rings ? ring_hit_fields(core) : stream_fields(hit_ports(core));
}
int ray_bytes(const Core& core) {
  return core.options.rings ? ring_ray_bytes : stream_bits(ray_ports(core)) / 8;
}
int hit_bytes(const Core& core) {
  return core.options.rings ? ring_hit_bytes : stream_bits(hit_ports(core)) / 8;
}

std::string axi_verilog(const Core& core) {
  const CoreOptions& options = core.options;
  const std::vector<Around> machines = machines_around(core);
  const BeatText ray(ray_fields(core), "s_axis_ray_tdata"), hit(hit_fields(core), "m_axis_hit_tdata");
  const Connections connections(core, ray_ports(core), ray.bits);
  std::string wires;
  const auto wire = [&](const std::string& name, int width) {
    wires += fmt::format("  wire {}{};\n", vector_range(width), name);
  };
  for (const Port& port : hit_ports(core))
    if (!options.rings || port.name != "t") wire("hit_" + port.name, port.width);
  const auto join = [&]<auto... Fields>(hls::List<Fields...>) {
    (wire(Fields.name(), core.pin(Fields).width), ...);
  };
  join(channels::Settings::Items());
  for (const char* const gate : {"lets_rays", "lets_requests", "lets_answers", "resets"}) wire(gate, 1);
  const bool has_cache = options.has_cache();
  Connections::Ends of_core{{"rst", "~aresetn | resets"}};
  Connections::Ends of_registers;
  if (options.rings) {
    join(hls::Join<hls::List<channels::rays_at, channels::answers_at, channels::ring_last,
                             channels::rays_offered, hls::rings::fetch_four, hls::rings::store_four,
                             channels::Hits::valid, channels::Hits::ready>,
                   channels::RingState>::Items());
    of_registers = {{"ray_valid", channels::ray_begins.name()}, {"ray_ready", "1'b1"}};
  } else {
    for (const char* const end : {"ray_valid", "ray_ready", "hit_valid", "hit_ready"}) {
      of_core[end] = fmt::format("core_{}", end);
      wire(of_core[end], 1);
    }
  }
  if (has_cache) {
    join(channels::CacheEvents::Items());
    join(hls::List<channels::most_lines, channels::empties_cache, channels::asks, channels::granted,
                   channels::asks_triangle, channels::read_valid, channels::read_error>());
    of_core["lets_asks"] = "lets_requests";
    // To the registers a cache is the memory.
    of_registers.insert({{"request_valid", "asks"},
                         {"request_ready", "granted"},
                         {"request_id", fmt::format("{{asks_triangle, {}'d0}}", options.ray_bits())}});
  } else {
    wire("core_request_valid", 1);
    wire("core_request_ready", 1);
    of_core["request_valid"] = "core_request_valid";
    of_core["request_ready"] = "core_request_ready";
  }
  const int id_bits = core.pin(channels::request_id).width;
  wire(channels::request_id.name(), id_bits);
  std::string instances = connections.instance(core.interface(), "core_i", of_core);
  std::string modules;
  for (const Around& machine : machines) {
    instances += connections.instance(machine.interface, machine.name + "_i",
                                      machine.name == "registers" ? of_registers : Connections::Ends());
    modules += (modules.empty() ? "" : "\n") + machine.verilog;
  }
  std::string between(options.rings ? ring_assignments(core) : std::string(gates));
  if (!has_cache) between += gate_of_requests;
  std::vector<std::string> unused = options.rings ? ring_unused() : ray.padding;
  if (!options.has_one_id()) {
    const std::string_view valid = has_cache ? channels::beat_valid.name() : channels::read_valid.name();
    wire(std::string(valid), 1);
    between +=
        fmt::format(with_identifiers, epoch_bits - 1, epoch_bits, id_bits, id_bits + epoch_bits - 1, valid);
    if (!has_cache) between += takes_all;
  } else if (has_cache) {
    unused.push_back(channels::request_id.name());
  } else {
    join(channels::BlockRead::Items());
  }
  unused.insert(unused.end(), {"m_axi_rresp[0]", "m_axi_rlast"});
  return fmt::format(
             R"(// The core {0} behind AXI: rays and answers by {13}, registers by AXI4-Lite, blocks by AXI4.
// Fields of {14}:
{1}// Fields of {15}:
{2}// Generated by hitpipe; do not edit.
{3}{4}
{5}
{6}  // A {11} has {12} bytes and is aligned to {12}.
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
             options.rings
                 ? ""
                 : fmt::format("  assign m_axis_hit_tdata = {};\n", joined(hit_ports(core), "hit_")),
             options.beats() - 1, hls::count_bits(options.burst_bits() / options.beats() / 8), between,
             fmt::join(unused, ", "), has_cache ? "line" : "block", options.burst_bits() / 8,
             options.rings ? "rings in memory" : "AXI4-Stream",
             options.rings ? fmt::format("a ray, with the tag from bit {} on", 8 * ring_ray_tag_at)
                           : "s_axis_ray_tdata",
             options.rings ? fmt::format("an answer, with the tag from bit {} on", 8 * ring_hit_tag_at)
                           : "m_axis_hit_tdata") +
         modules + "/* verilator lint_on DECLFILENAME */\n";
}

Json axi_json(const Core& core) {
  const auto side = [](const std::vector<StreamField>& all, int bytes) {
    Json fields = Json::array();
    for (const StreamField& field : all)
      fields.push_back({{"name", field.name}, {"offset", field.offset}, {"width", field.width}});
    return Json{{"tdata_bits", 8 * bytes}, {"fields", fields}};
  };
  Json json{{"module", axi_module(core)},
            {"verilog", axi_module(core) + ".v"},
            {"header", core.module + ".h"},
            {"data_bits", core.options.data_bits},
            {"has_one_id", core.options.has_one_id()}};
  if (core.options.rings) json["ring_bits"] = core.options.ring_bits();
  json["s_axis_ray"] = side(ray_fields(core), ray_bytes(core));
  json["m_axis_hit"] = side(hit_fields(core), hit_bytes(core));
  return json;
}

}  // namespace hitpipe::rtl
