#include "rtl_gen/core/axi_rings.hpp"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "hls/machines/channels.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe::rtl {

namespace {

constexpr int any_at = 31, failed_at = 7, number_at = 0, t_at = 8;  // bytes

Port port_of(const Core& core, std::string_view pin, const std::string& name) {
  for (const CorePort& port : core.ports)
    if (port.pin.name == pin) {
      Port made{name, port.pin.width, port.pin.is_signed};
      made.comment = port.pin.comment;
      return made;
    }
  throw std::logic_error(fmt::format("core: there is no port {}", pin));
}

}  // namespace

std::vector<Port> ring_ray_ports(const Core& core) {
  const Part& unit = core.part("ray");
  std::vector<Port> ports{{"any", 1, false}};
  ports.front().comment = "1: any hit will do; 0: the nearest";
  for (const Port& operand : unit.design->ports(unit.format)) {
    ports.push_back(operand);
    ports.back().comment = description(operand);
  }
  return ports;
}
std::vector<Port> ring_hit_ports(const Core& core) {
  std::vector<Port> ports{port_of(core, "hit_failed", "failed"),
                          port_of(core, "hit_number", "number"),
                          {"t", core.options.bits.distance(), false}};
  ports.back().comment = "T of the hit; without one the ray's length";
  return ports;
}
std::vector<StreamField> ring_ray_fields(const Core& core) {
  std::vector<StreamField> fields{{"any", 8 * any_at, 1}};
  for (const Port& port : ring_ray_ports(core))
    if (port.name != "any")
      fields.push_back({port.name, static_cast<int>(fields.size() - 1) * port.width, port.width});
  return fields;
}
std::vector<StreamField> ring_hit_fields(const Core& core) {
  const std::vector<Port> ports = ring_hit_ports(core);
  return {{ports[0].name, 8 * failed_at, ports[0].width},
          {ports[1].name, 8 * number_at, ports[1].width},
          {ports[2].name, 8 * t_at, ports[2].width}};
}

std::vector<Pin> ring_pins(const Core& core) {
  std::vector<Pin> pins;
  const auto add = [&](const std::string& channel, bool is_input,
                       const std::vector<std::pair<std::string, int>>& data) {
    pins.push_back({channel + "valid", Pin::Role::valid, channel, is_input});
    pins.push_back({channel + "ready", Pin::Role::ready, channel, !is_input});
    for (const auto& [name, width] : data)
      pins.push_back({channel + name, Pin::Role::data, channel, is_input, width});
  };
  const int data = core.options.ring_bits();
  const std::vector<std::pair<std::string, int>> burst{
      {"addr", core.options.byte_bits}, {"len", 8}, {"size", 3}, {"burst", 2}, {"cache", 4}, {"prot", 3}};
  add("m_axi_ring_ar", false, burst);
  add("m_axi_ring_r", true, {{"data", data}, {"resp", 2}, {"last", 1}});
  add("m_axi_ring_aw", false, burst);
  add("m_axi_ring_w", false, {{"data", data}, {"strb", data / 8}, {"last", 1}});
  add("m_axi_ring_b", true, {{"resp", 2}});
  pins.push_back({"irq", Pin::Role::data, "", false, 1});
  return pins;
}

std::map<std::string, std::string, std::less<>> ring_ends() {
  return {{"lets_rings", "lets_rays"},
          {"fetch_valid", "m_axi_ring_arvalid"},
          {"fetch_ready", "m_axi_ring_arready"},
          {"fetch_address", "m_axi_ring_araddr"},
          {"fetched_valid", "m_axi_ring_rvalid"},
          {"fetched_error", "m_axi_ring_rresp[1]"},
          {"fetched_0", "m_axi_ring_rdata[63:0]"},
          {"fetched_1", "m_axi_ring_rdata[127:64]"},
          {"store_valid", "m_axi_ring_awvalid"},
          {"store_ready", "m_axi_ring_awready"},
          {"store_address", "m_axi_ring_awaddr"},
          {"put_valid", "m_axi_ring_wvalid"},
          {"put_ready", "m_axi_ring_wready"},
          {"put_last", "m_axi_ring_wlast"},
          {"put_0", "m_axi_ring_wdata[63:0]"},
          {"put_1", "m_axi_ring_wdata[127:64]"},
          {"stored_valid", "m_axi_ring_bvalid"},
          {"stored_error", "m_axi_ring_bresp[1]"}};
}

std::string ring_assignments(const Core& core) {
  const int bits = core.options.ring_bits();
  const auto length = [&](int bytes) {
    return fmt::format("8'd{} : 8'd{}", 4 * 8 * bytes / bits - 1, 8 * bytes / bits - 1);
  };
  std::string text = fmt::format(R"(
  // Rays and answers come and go four at a time, or one.
  assign m_axi_ring_arlen = fetch_four ? {};
  assign m_axi_ring_awlen = store_four ? {};
)",
                                 length(ring_ray_bytes), length(ring_hit_bytes));
  for (const char* const channel : {"ar", "aw"})
    text += fmt::format(
        "  assign m_axi_ring_{0}size = 3'd{1};\n  assign m_axi_ring_{0}burst = 2'd1;\n"
        "  assign m_axi_ring_{0}cache = 4'd3;\n  assign m_axi_ring_{0}prot = 3'd0;\n",
        channel, hls::count_bits(bits / 8));
  return text + fmt::format(
                    "  assign m_axi_ring_wstrb = {{{}{{1'b1}}}};\n"
                    "  assign m_axi_ring_rready = 1'b1;  // it has room for what it asks for\n"
                    "  assign m_axi_ring_bready = 1'b1;\n",
                    bits / 8);
}

std::vector<std::string> ring_unused() {
  return {"m_axi_ring_rresp[0]", "m_axi_ring_rlast", "m_axi_ring_bresp[0]", "lets_answers"};
}

}  // namespace hitpipe::rtl
