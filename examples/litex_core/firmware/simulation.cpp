// The SoC as Verilator compiles it, and what its processor writes on the serial line.
#include <cstdint>
#include <cstdio>
#include <string>

#include "Vcore_soc.h"

int main() {
  constexpr std::uint64_t most_cycles = 1'000'000'000;
  Vcore_soc top;
  top.serial_source_ready = 1;
  std::string line;
  for (std::uint64_t cycle = 0; cycle < most_cycles; ++cycle) {
    top.rst = cycle < 16;
    top.clk = 0, top.eval();
    const bool writes = top.serial_source_valid;
    const char byte = static_cast<char>(top.serial_source_data);
    top.clk = 1, top.eval();
    if (!writes || byte == '\r') continue;
    std::putchar(byte);
    std::fflush(stdout);
    if (byte != '\n') {
      line += byte;
      continue;
    }
    if (line == "PASS" || line == "FAIL") {
      std::printf("%llu cycles\n", static_cast<unsigned long long>(cycle));
      return line == "PASS" ? 0 : 1;
    }
    line.clear();
  }
  std::printf("no end after %llu cycles\n", static_cast<unsigned long long>(most_cycles));
  return 1;
}
