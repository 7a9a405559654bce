#include "tests/sim/model/stub_verilator.hpp"

#include <fstream>

#include <fmt/format.h>

#include "tests/sim/formats.hpp"

namespace hitpipe::sim {

StubVerilator::StubVerilator() : variable_("VERILATOR", program().string()) {
  folder_.write_program("verilator", R"script(#!/bin/sh
home=$(dirname "$(realpath "$0")")
case $1 in
  --version) cat "$home/version"; exit ;;
  --getenv) cat "$home/root"; exit ;;
esac
echo run >>"$home/runs"
sleep "$(cat "$home/seconds")"
code=$(cat "$home/code")
if [ "$code" != 0 ]; then echo 'stub fails'; exit "$code"; fi
for file; do :; done
module=$(basename "$file" .v)
mkdir obj && sed "s/Vint_slabs/V$module/g" "$home/Vint_slabs.h" >"obj/V$module.h"
)script");
  std::string ports = "clk, rst, in_valid, in_ready, in_tag, out_valid, out_ready, out_tag, hit";
  for (const rtl::Port& port : int_slabs().ports(hls::IntBits{20, 24})) ports += ", " + port.name;
  folder_.write("Vint_slabs.h", fmt::format(R"header(#include <cstdint>
#include "verilated.h"
struct Vint_slabs {{
  explicit Vint_slabs(VerilatedContext*) {{}}
  std::uint64_t {} = 0;
  void eval() {{}}
}};
)header",
                                            ports));
  std::filesystem::create_directory(folder_.path() / "include");
  folder_.write("include/verilated.h", "#pragma once\nclass VerilatedContext {};\n");
  folder_.write("include/verilated.cpp", "");
  folder_.write("include/verilated_threads.cpp", "");
  set_version("Stub 1");
  set_seconds("0");
  set_exit_code(0);
  set_root(folder_.path().string());
}

int StubVerilator::runs() const {
  std::ifstream in(folder_.path() / "runs");
  int count = 0;
  for (std::string line; std::getline(in, line);) ++count;
  return count;
}

}  // namespace hitpipe::sim
