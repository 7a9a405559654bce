#include <fmt/format.h>

#include "rtl_gen/emit/testbench.hpp"

namespace hitpipe::rtl {

namespace {

/// Ends a run in which tests are lost or never taken.
std::string limit(int interval) {
  const std::string slower = interval == 1 ? "" : fmt::format("{} * ", interval);
  return "    if (cycle > 16 * " + slower + R"(vectors.size() + 1000)
      throw std::runtime_error(std::to_string(received) + " of " + std::to_string(vectors.size()) +
                               " vectors came back");
)";
}

std::string with_handshake(int interval) {
  return R"(  std::mt19937 random(1);
  std::size_t sent = 0;
  std::size_t received = 0;
  for (std::size_t cycle = 0; received < vectors.size(); ++cycle) {
)" + limit(interval) +
         R"(    // Before the rising edge: offer a test and take a result, each in three cycles of four.
    dut.in_valid = sent < vectors.size() && random() % 4 != 0;
    dut.out_ready = random() % 4 != 0;
    if (dut.in_valid) {
      set_operands(dut, vectors[sent]);
      set(dut.in_tag, sent & 0xffff);
    }
    eval_with_clock(false);
    // The handshakes count as they stand now.
    if (dut.in_valid && dut.in_ready) ++sent;
    if (dut.out_valid && dut.out_ready) {
      const std::string text = differences(dut, vectors[received], received & 0xffff);
      if (!text.empty())
        throw std::runtime_error("vector " + std::to_string(received) + " (" + vectors[received] + "):" + text);
      ++received;
    }
    eval_with_clock(true);
  }
)";
}

std::string with_fixed_latency(int interval) {
  const bool waits = interval > 1;
  const std::string taken = waits ? "taken" : "dut.in_valid";
  return std::string(R"(  std::mt19937 random(1);
  std::size_t sent = 0;
  std::size_t received = 0;
  std::deque<bool> sent_before(latency + 1, false);  // in each of the last cycles, the oldest first
)") + (waits ? "  std::size_t cycle = 0;\n" : "") +
         R"(  // After the last result the unit must stay silent.
  for (std::size_t idle = 0; idle < 2 * latency + 8; idle += received == vectors.size()) {
)" + (waits ? "    ++cycle;\n" + limit(interval) : "") +
         R"(    // Before the rising edge: send a test in three cycles of four.
    dut.in_valid = sent < vectors.size() && random() % 4 != 0;
    if (dut.in_valid) {
      set_operands(dut, vectors[sent]);
      set(dut.in_tag, sent & 0xffff);
    }
    eval_with_clock(false);
)" + (waits ? "    const bool taken = dut.in_valid && dut.in_ready;\n" : "") +
         R"(    const bool due = sent_before.front();
    sent_before.pop_front();
    sent_before.push_back()" +
         taken + R"();
    if ()" +
         taken + R"() ++sent;
    if (dut.out_valid && !due)
      throw std::runtime_error("a result, and no test was sent " + std::to_string(latency) + " cycles before");
    if (due) {
      const std::string vector = "vector " + std::to_string(received) + " (" + vectors[received] + "):";
      if (!dut.out_valid)
        throw std::runtime_error(vector + " no result " + std::to_string(latency) + " cycles after its operands");
      const std::string text = differences(dut, vectors[received], received & 0xffff);
      if (!text.empty()) throw std::runtime_error(vector + text);
      ++received;
    }
    eval_with_clock(true);
  }
)";
}

}  // namespace

std::string harness(const ModuleInterface& unit, int count, int latency) {
  const bool ready = unit.flow_control() == FlowControl::stall;
  const int width = total_width(unit.operands()) + total_width(unit.results());
  std::string operands;
  std::string comparisons;
  int above = width;
  for (const Port& port : unit.operands()) {
    operands +=
        fmt::format("  set(dut.{}, bits(vector, {}, {}));\n", port.name, above - 1, above - port.width);
    above -= port.width;
  }
  for (const Port& result : unit.results()) {
    comparisons += fmt::format("  text += difference(\"{0}\", dut.{0}, bits(vector, {1}, {2}));\n",
                               result.name, above - 1, above - result.width);
    above -= result.width;
  }
  return fmt::format(
      R"(// Drives {module}, which Verilator compiles to C++, with the vectors of {module}_vectors.hex. {how} Every result and every tag
// is compared. It is an example: start your own testbench from it.
//   make harness              builds and runs it: PASS and exit code 0, or FAIL and exit code 1
//   make harness WAVES=vcd    also writes {module}.vcd; WAVES=fst writes {module}.fst
#include <cstddef>
#include <cstdint>
#include <cstdio>
{deque}#include <exception>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <verilated.h>
#if VM_TRACE_FST
#include <verilated_fst_c.h>
using Waves = VerilatedFstC;
#elif VM_TRACE
#include <verilated_vcd_c.h>
using Waves = VerilatedVcdC;
#endif

#include "V{module}.h"

namespace {{

// A vector is a line of hexadecimal digits: {width} bits, the operands in port order and then the results.
constexpr std::size_t vector_count = {count};
{latency}constexpr std::size_t digit_count = {digits};
constexpr char most_in_first_digit = '{first_digit}';

/// Bits high..low of a number in hexadecimal digits.
std::uint64_t bits(const std::string& digits, int high, int low) {{
  std::uint64_t value = 0;
  for (int bit = high; bit >= low; --bit) {{
    const char digit = digits[digits.size() - 1 - static_cast<std::size_t>(bit / 4)];
    const int nibble = digit <= '9' ? digit - '0' : digit - 'a' + 10;
    value = value << 1 | static_cast<std::uint64_t>(nibble >> bit % 4 & 1);
  }}
  return value;
}}

/// The lines of the file without empty lines and comments (//).
std::vector<std::string> read_vectors(const std::string& name) {{
  std::ifstream file(name);
  if (!file) throw std::runtime_error(name + ": cannot be opened");
  std::vector<std::string> vectors;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {{
    if (text.empty() || text.compare(0, 2, "//") == 0) continue;
    if (text.size() != digit_count || text.find_first_not_of("0123456789abcdef") != std::string::npos ||
        text.front() > most_in_first_digit)
      throw std::runtime_error(name + ", line " + std::to_string(line) +
                               ": not {digits} lower-case hexadecimal digits of {width} bits");
    vectors.push_back(text);
  }}
  if (vectors.size() != vector_count)
    throw std::runtime_error(name + ": " + std::to_string(vectors.size()) + " vectors, expected " +
                             std::to_string(vector_count));
  return vectors;
}}

/// A port of 8, 16, 32 or 64 bits, as Verilator declares it. Bits above the port's width must be 0.
template <class Port>
void set(Port& port, std::uint64_t value) {{
  port = static_cast<Port>(value);
}}

void set_operands(V{module}& dut, const std::string& vector) {{
{operands}}}

std::string difference(const char* name, std::uint64_t found, std::uint64_t expected) {{
  if (found == expected) return "";
  return std::string(" ") + name + " " + std::to_string(found) + ", expected " + std::to_string(expected) + ";";
}}

/// Empty when results and tag are right.
std::string differences(const V{module}& dut, const std::string& vector, std::uint64_t tag) {{
  std::string text;
{comparisons}  text += difference("tag", dut.out_tag, tag);
  return text;
}}

void run(int count, char** arguments) {{
  const std::vector<std::string> vectors = read_vectors("{module}_vectors.hex");
  VerilatedContext context;
  context.commandArgs(count, arguments);  // +verilator+seed+N and its kind
#if VM_TRACE
  context.traceEverOn(true);
#endif
  V{module} dut{{&context}};
#if VM_TRACE
  Waves waves;
  dut.trace(&waves, 99);
  waves.open(VM_TRACE_FST ? "{module}.fst" : "{module}.vcd");
#endif
  const auto eval_with_clock = [&](bool clock) {{
    dut.clk = clock;
    dut.eval();
#if VM_TRACE
    waves.dump(context.time());
#endif
    context.timeInc(5);
  }};

  dut.in_valid = 0;
{no_out_ready}  dut.rst = 1;
  eval_with_clock(false);
  eval_with_clock(true);
  dut.rst = 0;

{drive}  std::printf("PASS %zu vectors\n", received);
}}

}}  // namespace

int main(int count, char** arguments) {{
  try {{
    run(count, arguments);
  }} catch (const std::exception& error) {{
    std::printf("FAIL %s\n", error.what());
    return 1;
  }}
}}
)",
      fmt::arg("module", unit.module), fmt::arg("width", width), fmt::arg("count", count),
      fmt::arg("digits", (width + 3) / 4), fmt::arg("first_digit", "137f"[(width + 3) % 4]),
      fmt::arg("how", ready ? "Tests go in and\n// results come out through the valid/ready "
                              "handshake, with random gaps and stalls."
                            : "Tests go in with random gaps.\n// A result comes out a fixed number "
                              "of cycles later, and in no other cycle."),
      fmt::arg("deque", ready ? "" : "#include <deque>\n"),
      fmt::arg(
          "latency",
          ready ? ""
                : fmt::format(
                      "// Edges from the one that takes the operands to the one that latches the results.\n"
                      "constexpr std::size_t latency = {};\n",
                      latency)),
      fmt::arg("no_out_ready", ready ? "  dut.out_ready = 0;\n" : ""),
      fmt::arg("drive", ready ? with_handshake(unit.interval) : with_fixed_latency(unit.interval)),
      fmt::arg("operands", operands), fmt::arg("comparisons", comparisons));
}

}  // namespace hitpipe::rtl
