// The base core behind AXI: registers by AXI4-Lite, rays and answers by AXI4-Stream, blocks by AXI4.
#include <fmt/format.h>

#include "hls/machines/beats.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/epoch.hpp"
#include "rtl_gen/core/axi_plan.hpp"
#include "rtl_gen/core/feature.hpp"
#include "rtl_gen/core/features/base.hpp"
#include "rtl_gen/core/registers.hpp"

namespace hitpipe::rtl::features::base {

namespace {

void add_registers(AxiPlan& plan) {
  for (const AxiChannel& channel :
       {AxiChannel{"s_axi_aw", true, {{"addr", 8}}}, AxiChannel{"s_axi_w", true, {{"data", 32}, {"strb", 4}}},
        AxiChannel{"s_axi_b", false, {{"resp", 2}}}, AxiChannel{"s_axi_ar", true, {{"addr", 8}}},
        AxiChannel{"s_axi_r", false, {{"data", 32}, {"resp", 2}}}})
    plan.add_channel(channel);
  plan.add_machine("registers", register_bits(plan.core.options));
  for (const char* const taken :
       {"awvalid", "awaddr", "wvalid", "wdata", "wstrb", "bready", "arvalid", "araddr", "rready"})
    plan.join("registers", taken, "", fmt::format("s_axi_{}", taken));
  for (const char* const given :
       {"awready", "wready", "bvalid", "bresp", "arready", "rvalid", "rdata", "rresp"})
    plan.join("", fmt::format("s_axi_{}", given), "registers", given);
  const CoreIdentity identity = identity_of(plan.core.options);
  plan.join("registers", "about_format", AxiPlan::constant(identity["FORMAT"], 32));
  plan.join("registers", "about_shape", AxiPlan::constant(identity["SHAPE"], 32));
  plan.join("registers", "about_ports", AxiPlan::constant(identity["PORTS"], 32));
  plan.join("registers", "about_limits", AxiPlan::constant(identity["LIMITS"], 32));
  // A soft reset is one of the core alone.
  Gate soft = plan.gate("registers", "resets");
  soft.inverted = true;
  Source reset = plan.is_reset();
  reset.gates.push_back(soft);
  plan.join("core", "rst", reset);
}

/// The registers let rays and answers pass.
void add_streams(AxiPlan& plan) {
  const CoreRecords records = records_of(plan.core);
  const int tag = plan.core.options.tag_bits;
  plan.add_channel({"s_axis_ray_t", true, {{"data", 8 * records.ray.bytes}, {"id", tag}}});
  plan.add_channel({"m_axis_hit_t", false, {{"data", 8 * records.hit.bytes}, {"id", tag}}});
  const auto pass = [&](const char* part, const std::string& pin, const Source& from, const char* lets) {
    plan.join(part, pin, AxiPlan::through(from, plan.gate("registers", lets)));
  };
  const Source ray = plan.all("", "s_axis_ray_tvalid"), takes = plan.all("core", "ray_ready"),
               hit = plan.all("core", "hit_valid"), taken = plan.all("", "m_axis_hit_tready");
  pass("core", "ray_valid", ray, "lets_rays");
  pass("", "s_axis_ray_tready", takes, "lets_rays");
  pass("", "m_axis_hit_tvalid", hit, "lets_answers");
  pass("core", "hit_ready", taken, "lets_answers");
  plan.join("registers", "ray_valid", ray);
  pass("registers", "ray_ready", takes, "lets_rays");
  pass("registers", "hit_valid", hit, "lets_answers");
  plan.join("registers", "hit_ready", taken);
  plan.join("core", "ray_tag", "", "s_axis_ray_tid");
  plan.join("", "m_axis_hit_tid", "core", "hit_tag");
  plan.join_fields("core", "ray_", records.ray.fields, "s_axis_ray_tdata");
  plan.join_word("m_axis_hit_tdata", records.hit.fields, "core", "hit_");
}

/// Pins of the memory bus, and what is constant.
void add_bus(AxiPlan& plan) {
  const CoreBus& bus = plan.core.bus;
  const int id = plan.core.pin(hls::channels::request_id).width + hls::EpochBits{}.epoch;
  const auto with_id = [&](AxiChannel channel) {
    if (!bus.has_one_id) channel.data.insert(channel.data.begin() + 1, {"id", id});
    plan.add_channel(channel);
  };
  with_id({"m_axi_ar",
           false,
           {{"addr", plan.core.options.byte_bits},
            {"len", 8},
            {"size", 3},
            {"burst", 2},
            {"cache", 4},
            {"prot", 3}}});
  with_id({"m_axi_r", true, {{"data", bus.data_bits}, {"resp", 2}, {"last", 1}}});
  plan.join("", "m_axi_araddr", "core", "request_address");
  plan.join_burst("m_axi_ar", AxiPlan::constant(static_cast<std::uint64_t>(bus.beats() - 1), 8),
                  bus.burst_bits / bus.beats() / 8);
  if (bus.has_one_id) return;
  plan.add_machine("epoch", hls::EpochBits{});
  plan.join("epoch", "resetting", plan.is_reset());
  plan.join("", "m_axi_arid",
            AxiPlan::beside({plan.all("core", "request_id"), plan.all("epoch", "present")}));
}

void add_blocks(AxiPlan& plan) {
  const Gate lets = plan.gate("registers", "lets_requests");
  const Source asks = AxiPlan::through(plan.all("core", "request_valid"), lets);
  plan.join("", "m_axi_arvalid", asks);
  plan.join("core", "request_ready", AxiPlan::through(plan.all("", "m_axi_arready"), lets));
  plan.join("registers", "request_valid", asks);
  plan.join("registers", "request_ready", "", "m_axi_arready");
  if (!plan.core.bus.has_one_id) {
    const Source comes = plan.valid_now("m_axi_r");
    for (const char* const part : {"core", "registers"}) {
      plan.join(part, "read_valid", comes);
      plan.join(part, "read_error", plan.some("", "m_axi_rresp", 1, 1));
    }
    plan.join("core", "read_id",
              plan.some("", "m_axi_rid", 0, plan.core.pin(hls::channels::request_id).width));
    plan.join_beat("core", "read_word", "m_axi_rdata");
    plan.join("", "m_axi_rready", AxiPlan::constant(1, 1));  // a block is taken at once
    return;
  }
  plan.add_machine("beats", hls::BeatBits{plan.core.bus.data_bits, plan.core.options.ray_bits()});
  plan.join("beats", "request_valid", asks);
  plan.join("beats", "request_ready", "", "m_axi_arready");
  if (plan.has("beats", "request_upper"))
    plan.join("beats", "request_upper", plan.some("core", "request_address", 5, 1));
  plan.join("beats", "beat_valid", "", "m_axi_rvalid");
  plan.join("beats", "beat_error", plan.some("", "m_axi_rresp", 1, 1));
  plan.join_beat("beats", "beat", "m_axi_rdata");
  plan.join("", "m_axi_rready", "beats", "beat_ready");
}

}  // namespace

void axi(AxiPlan& plan) {
  add_registers(plan);
  if (plan.has("core", "ray_valid")) add_streams(plan);
  add_bus(plan);
  if (plan.has("core", "read_word_0")) add_blocks(plan);
}

CoreRecords records(const Core& core) {
  const auto record = [&](const char* before, const char* word, const char* place) {
    const std::vector<Port> ports = ports_of(core, before);
    return CoreRecord{ports, stream_fields(ports), stream_bits(ports) / 8, word, place};
  };
  return {record("ray_", "s_axis_ray_tdata", "beat of s_axis_ray"),
          record("hit_", "m_axis_hit_tdata", "beat of m_axis_hit"), "AXI4-Stream"};
}

}  // namespace hitpipe::rtl::features::base
