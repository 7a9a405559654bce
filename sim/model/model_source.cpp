#include "sim/model/model_source.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hls/num/bits.hpp"

namespace hitpipe::sim {

namespace {

/// Lines that give each port its number from the array of all operands.
std::string drive_lines(const std::vector<rtl::Port>& ports, const std::vector<rtl::Port>& operands) {
  std::string drive;
  for (const rtl::Port& port : ports) {
    const auto operand = std::ranges::find(operands, port.name, &rtl::Port::name);
    // A Verilated port must not be given bits above its width.
    drive += fmt::format("    top.{} = operands[{}] & {:#x}LL;\n", port.name, operand - operands.begin(),
                         hls::low_mask(port.width));
  }
  return drive;
}

}  // namespace

std::string instance_source(const std::string& module, const std::string& includes) {
  return fmt::format(R"(#include "V{0}.h"
#include "verilated.h"
{1}
namespace {{
struct Model {{
  VerilatedContext context;
  V{0} top{{&context}};
}};
}}  // namespace

#define HITPIPE_ENTRY extern "C" __attribute__((visibility("default")))

HITPIPE_ENTRY void* hitpipe_create() {{ return new Model; }}
HITPIPE_ENTRY void hitpipe_destroy(void* model) {{ delete static_cast<Model*>(model); }}
)",
                     module, includes);
}

std::string model_source(const std::string& module, const std::vector<rtl::Port>& operands,
                         const std::vector<rtl::Port>& ports, const std::vector<hls::Result>& results,
                         rtl::FlowControl flow, int interval) {
  const bool stalls = flow == rtl::FlowControl::stall;
  const rtl::Verdict verdict = rtl::verdict_of(results);
  std::string read;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const hls::Result& result = results[i];
    // A Verilated port is unsigned.
    const int above = result.is_signed ? 64 - result.width : 0;
    read += fmt::format(
        "    pins->results[{0}] = static_cast<std::int64_t>(std::uint64_t{{top.{1}}} << {2}) >> {2};\n", i,
        result.name, above);
  }
  return instance_source(module, R"(
#include <cstdint>

#include "pins.hpp"
)") + fmt::format(R"(
HITPIPE_ENTRY void hitpipe_cycle(void* model, const std::int64_t* operands, hitpipe::sim::Pins* pins) {{
  V{0}& top = static_cast<Model*>(model)->top;
  top.clk = 0;
  top.rst = pins->rst;
  top.in_valid = pins->in_valid;
  top.in_tag = pins->in_tag;
{4}  if (pins->in_valid) {{
{1}  }}
  top.eval();
  pins->in_ready = {5};
  pins->out_valid = top.out_valid;
  pins->hit = {2}top.{6};
  pins->out_tag = top.out_tag;
  if (pins->results != nullptr) {{
{3}  }}
  top.clk = 1;
  top.eval();
}}
)",
                  module, drive_lines(ports, operands), verdict.yes ? "" : "!", read,
                  stalls ? "  top.out_ready = pins->out_ready;\n" : "",
                  stalls || interval > 1 ? "top.in_ready" : "true", results[verdict.place].name);
}

}  // namespace hitpipe::sim
