#include "sim/implement/netlist_simulation.hpp"

#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "sim/implement/target.hpp"

namespace hitpipe::sim {

namespace fs = std::filesystem;

namespace {

/// The folder with Yosys's data files, found as Yosys itself finds it: beside the program.
std::string yosys_data(const Tool& yosys) {
  const host::Outcome found = host::run({"sh", "-c", "command -v -- \"$0\"", yosys.words.front()});
  const fs::path program = found.out.substr(0, found.out.find('\n'));
  std::error_code ignored;
  return (fs::canonical(program, ignored).parent_path().parent_path() / "share" / "yosys").string();
}

std::vector<std::string> model_files(const Models& models, const Tool& yosys) {
  const std::string data = yosys_data(yosys);
  std::vector<std::string> files;
  for (const std::string& file : models.files) {
    files.push_back(filled_in(file, {{"yosys", data}}));
    if (!fs::exists(files.back()))
      throw std::runtime_error(
          fmt::format("{}: the simulation models of the cells are not there", files.back()));
  }
  return files;
}

/// A netlist has no parameters. Its tags are as wide as the testbench's.
std::string without_parameters(std::string testbench) {
  constexpr std::string_view parameters = "#(.TAG_BITS(16)) ";
  const std::size_t at = testbench.find(parameters);
  if (at != std::string::npos) testbench.erase(at, parameters.size());
  return testbench;
}

/// The testbench dumps all; of a netlist the nets alone are wanted.
std::string with_nets_dumped(std::string testbench, const std::string& top) {
  const std::string all = fmt::format("$dumpvars(0, {}_tb)", top);
  const std::size_t at = testbench.find(all);
  return testbench.replace(at, all.size(), fmt::format("$dumpvars(1, {}_tb.dut)", top));
}

/// Verilog that Verilator takes, from the functions in the Liberty file.
std::vector<std::string> liberty_models(const Target& target, const Tool& yosys, const Workbench& bench) {
  const std::string name = target.name + "_cells.v";
  const std::string convert =
      fmt::format("read_liberty -ignore_miss_func {}; write_verilog -noattr {}", target.liberty, name);
  bench.run(yosys, {"-p", convert}, target.name + "_cells.log");
  return {name};
}

}  // namespace

SimulatorTools find_simulator(Simulator simulator) {
  if (simulator == Simulator::verilator)
    return {simulator, find_tool("VERILATOR", "verilator", "verilator"), {}};
  return {simulator, find_tool("IVERILOG", "iverilog", "iverilog", "-V"),
          find_tool("VVP", "vvp", "iverilog", "-V")};
}

void check_models(const Target& target) {
  if (!target.models)
    throw std::runtime_error(fmt::format(
        "target {}: has no simulation models of its cells, so its netlist cannot be simulated", target.name));
}

std::string last_word(const std::string& output) {
  for (const char* const word : {"FAIL", "PASS"}) {
    const std::size_t at = output.find(word);
    if (at != std::string::npos) return output.substr(at, output.find('\n', at) - at);
  }
  return "";
}

std::string waves_file(const Synthesis& netlist) {
  return netlist.top + ".vcd";
}

NetlistAnswer simulate_netlist(const Target& target, const Synthesis& netlist,
                               const NetlistTestbench& testbench, const SimulatorTools& tools,
                               const Tool& yosys, const Workbench& bench) {
  check_models(target);
  const std::string bench_file = netlist.top + "_netlist_tb.sv";
  std::string text = without_parameters(testbench.testbench.contents);
  if (testbench.dumps) text = with_nets_dumped(std::move(text), netlist.top);
  bench.put_and_keep({bench_file, std::move(text)});
  bench.put({fs::path(testbench.vectors.name).filename().string(), testbench.vectors.contents});
  const bool verilator = tools.simulator == Simulator::verilator;
  std::vector<std::string> files = verilator && !target.liberty.empty() ? liberty_models(target, yosys, bench)
                                                                        : model_files(*target.models, yosys);
  files.insert(files.end(), {netlist.verilog(), bench_file});
  std::vector<std::string> build;
  std::vector<std::string> run;
  const std::string top = netlist.top + "_tb";
  if (verilator) {
    build = {"--binary", "-O3", "-Wno-fatal", "-Wno-lint", "-Wno-style", "--top-module", top, "-Mdir", "obj"};
    build.insert(build.end(), target.models->verilator_options.begin(),
                 target.models->verilator_options.end());
  } else {
    build = {"-g2012", "-s", top, "-o", top + ".vvp"};
    run = {"-n", top + ".vvp"};
    if (testbench.dumps) run.push_back("+waves=" + waves_file(netlist));
  }
  for (const std::string& define : target.models->defines) build.push_back("-D" + define);
  build.insert(build.end(), files.begin(), files.end());
  bench.run(tools.compiler, build, netlist.top + "_simulation_build.log");
  const Tool runner = verilator ? Tool{{"obj/V" + top}, ""} : tools.runner;
  const std::string log = netlist.top + "_simulation.log";
  const host::Outcome outcome = bench.try_run(runner, run, log);
  const std::string said = last_word(outcome.out + outcome.err);
  if (said.empty())
    throw std::runtime_error(fmt::format("{}: {}; its output is in {}", runner.name(), outcome.failure(),
                                         (bench.kept() / log).string()));
  return {outcome.succeeded() && said.starts_with("PASS"), said};
}

}  // namespace hitpipe::sim
