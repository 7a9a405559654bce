// A core behind AXI is the same in C++ and in Verilog, in every cycle, whatever its pins are given.
#include "sim/core/native_axi.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/axi.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::sim::native_axi_test {
namespace {

using rtl::Pin;

constexpr int cycles = 3000, first_compared = 4;

/// Reads a line of words for each cycle, all inputs, and writes one, all outputs. Verilator has a port of more than 64
/// bits as words of 32 bits.
constexpr const char* driver = R"(#include <cinttypes>
#include <cstdio>
#include <type_traits>
#include "verilated.h"
#include "Vtop.h"
template <class Port> void read(Port& port, int width) {{
  for (int at = 0; at < width; at += 64) {{
    uint64_t word = 0;
    if (std::scanf("%" SCNx64, &word) != 1) return;
    if constexpr (std::is_integral_v<Port>) port = static_cast<Port>(word);
    else {{
      port[at / 32] = static_cast<uint32_t>(word);
      if (at + 32 < width) port[at / 32 + 1] = static_cast<uint32_t>(word >> 32);
    }}
  }}
}}
template <class Port> void write(const Port& port, int width) {{
  for (int at = 0; at < width; at += 64) {{
    uint64_t word = 0;
    if constexpr (std::is_integral_v<Port>) word = port;
    else word = port[at / 32] | (at + 32 < width ? static_cast<uint64_t>(port[at / 32 + 1]) << 32 : 0);
    std::printf("%" PRIx64 " ", word);
  }}
}}
int main() {{
  Verilated::threadContextp()->randReset(0);
  Vtop top;
  for (int cycle = 0; cycle < {cycles}; ++cycle) {{
{reads}    top.aclk = 0;
    top.eval();
{writes}    std::printf("\n");
    top.aclk = 1;
    top.eval();
  }}
}}
)";

class SameBehindAxi : public testing::TestWithParam<rtl::CoreOptions> {};

TEST_P(SameBehindAxi, InEveryCycle) {
  const rtl::Library library = rtl::library_called(rtl::default_library);
  const rtl::Core core = rtl::make_core(GetParam(), library, "core");
  NativeAxi native(core);
  const std::vector<Pin>& pins = native.interface().pins;
  ref::adversary::Random random(7);
  std::string given, want, reads, writes;
  for (std::size_t pin = 1; pin < pins.size(); ++pin)  // behind the clock
    (pins[pin].is_input ? reads : writes) += fmt::format(
        "    {}(top.{}, {});\n", pins[pin].is_input ? "read" : "write", pins[pin].name, pins[pin].width);
  std::vector<bool> moves(pins.size());
  for (int cycle = 0; cycle < cycles; ++cycle) {
    for (std::size_t pin = 1; pin < pins.size(); ++pin) {
      if (!pins[pin].is_input) continue;
      PinWords words((static_cast<std::size_t>(pins[pin].width) + 63) / 64);
      for (std::uint64_t& word : words) word = random.bits();
      // The first cycle has no reset, so that the one behind it counts. Others come now and then. Numbers that are
      // written are small, so that settings are.
      if (pins[pin].role == Pin::Role::reset)
        words[0] = cycle != 0 && (cycle < first_compared || random.below(500) == 0) ? 0 : 1;
      if (pins[pin].name == "s_axi_wdata") words[0] &= 0xff;
      if (pins[pin].width % 64 != 0) words.back() &= ~std::uint64_t{0} >> (64 - pins[pin].width % 64);
      given += fmt::format("{:x} ", fmt::join(words, " "));
      native.set(pin, words);
    }
    given += "\n";
    for (std::size_t pin = 1; pin < pins.size(); ++pin)
      if (!pins[pin].is_input) {
        want += fmt::format("{:x} ", fmt::join(native.get(pin), " "));
        if (pins[pin].role == Pin::Role::valid && native.get(pin)[0] != 0) moves[pin] = true;
      }
    want += "\n";
    native.step();
  }
  for (std::size_t pin = 0; pin < pins.size(); ++pin) {
    const bool gives = !pins[pin].is_input && pins[pin].role == Pin::Role::valid;
    const bool is_seen = !gives || pins[pin].name.starts_with("m_axi_ring_") || moves[pin];
    EXPECT_TRUE(is_seen) << pins[pin].name;
  }

  const host::ScratchFolder folder("native-axi");
  host::write_files(folder.path(),
                    {{"core.v", rtl::to_verilog(core, library)},
                     {"core_axi.v", rtl::axi_verilog(core)},
                     {"given", given},
                     {"main.cpp", fmt::format(driver, fmt::arg("cycles", cycles), fmt::arg("reads", reads),
                                              fmt::arg("writes", writes))}});
  const rtl::ToolResult built = rtl::run_tool(folder.path(), "verilator", "verilator",
                                              "--cc --exe --build -O0 --x-initial 0 -Wno-fatal -Wno-lint "
                                              "--top-module core_axi --prefix Vtop core_axi.v core.v "
                                              "main.cpp");
  ASSERT_EQ(built.status, 0) << built.output;
  ASSERT_EQ(rtl::run_tool(folder.path(), "Vtop", "sh", "-c 'obj_dir/Vtop < given > found'").status, 0);
  const std::string found = host::read_file(folder.path() / "found");
  // Registers begin with other numbers before the first reset.
  std::stringstream wanted(want), seen(found);
  std::string want_line, found_line;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    std::getline(wanted, want_line);
    ASSERT_TRUE(std::getline(seen, found_line));
    if (cycle < first_compared) continue;
    ASSERT_EQ(found_line, want_line) << "cycle " << cycle;
  }
}

constexpr hls::RayBits small{8, 0, 4, 0, 8, 0};

INSTANTIATE_TEST_SUITE_P(Of, SameBehindAxi,
                         testing::Values(rtl::CoreOptions{.bits = small, .rays = 4},
                                         rtl::CoreOptions{.bits = small, .rays = 4, .data_bits = 512},
                                         rtl::CoreOptions{.bits = small,
                                                          .rays = 4,
                                                          .data_bits = 64,
                                                          .float_door = true,
                                                          .cache = {.kib = 2},
                                                          .rings = true}),
                         [](const auto& each) {
                           return fmt::format("Bus{}{}", each.param.data_bits,
                                              each.param.rings ? "RingsAndACache" : "");
                         });

}  // namespace
}  // namespace hitpipe::sim::native_axi_test
