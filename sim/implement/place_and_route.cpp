#include "sim/implement/place_and_route.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/licence.hpp"

namespace hitpipe::sim {

namespace {

using Json = nlohmann::json;

/// Whether the clock's name is the net's, or stands between dollar signs in it.
bool is_clock(const std::string& net, const std::string& clock) {
  return fmt::format("${}$", net).find(fmt::format("${}$", clock)) != std::string::npos;
}

CriticalPath critical_path(const Json& report, const std::string& net) {
  const std::string edge = "posedge " + net;
  CriticalPath critical;
  for (const Json& candidate : report.at("critical_paths")) {
    if (candidate.at("from") != edge || candidate.at("to") != edge) continue;
    const Json& path = candidate.at("path");
    for (const Json& step : path) {
      double& sum = step.at("type") == "routing" ? critical.routing_ns : critical.logic_ns;
      sum += step.at("delay").get<double>();
    }
    // The first step is from a register's clock to its output, and names the register only there.
    critical.from = path.front().at("to").at("cell").get<std::string>();
    critical.to = path.back().at("to").at("cell").get<std::string>();
  }
  return critical;
}

/// The first line that begins with "ERROR: ", without these words.
std::string error_in(const std::string& log) {
  constexpr std::string_view label = "ERROR: ";
  const std::size_t at = log.find(label);
  if (at == std::string::npos) return "";
  return log.substr(at + label.size(), log.find('\n', at) - at - label.size());
}

/// Whether nextpnr found too little room or too few wires.
bool is_lack_of_room(const std::string& error) {
  constexpr std::array words{
      "no BELs remaining", "nable to find a placement", "nable to find legal placement",
      "nable to place",    "ailed to expand region",    "ailed to route"};
  return std::any_of(words.begin(), words.end(),
                     [&](const char* each) { return error.find(each) != std::string::npos; });
}

std::vector<PlacedSeed> by_frequency(std::vector<PlacedSeed> seeds) {
  std::sort(seeds.begin(), seeds.end(),
            [](const PlacedSeed& a, const PlacedSeed& b) { return a.fmax_mhz < b.fmax_mhz; });
  return seeds;
}

}  // namespace

PlacedSeed PlacedDesign::best() const {
  return by_frequency(seeds).back();
}

PlacedSeed PlacedDesign::median() const {
  return by_frequency(seeds)[(seeds.size() - 1) / 2];
}

PlacedSeed read_report(const std::string& json, const std::string& clock) {
  try {
    const Json report = Json::parse(json);
    for (const auto& [net, frequency] : report.at("fmax").items())
      if (is_clock(net, clock))
        return {0, frequency.at("achieved").get<double>(), critical_path(report, net)};
  } catch (const Json::exception&) {
    throw std::runtime_error("nextpnr's report cannot be read");
  }
  throw std::runtime_error(fmt::format("nextpnr reports no path in the clock {}", clock));
}

int packed_count(const std::string& log, const std::string& resource) {
  const std::size_t at = log.rfind(resource + ":");
  if (at == std::string::npos)
    throw std::runtime_error(fmt::format("nextpnr's log does not say how many {} are used", resource));
  return static_cast<int>(std::strtol(log.c_str() + at + resource.size() + 1, nullptr, 10));
}

std::vector<ResourceCount> pack(const Target& target, const Synthesis& netlist, const Tool& placer,
                                const Workbench& bench) {
  std::vector<std::string> arguments = target.placer.value().options;
  arguments.insert(arguments.end(), {"--json", netlist.json(), "--top", netlist.top, "--pack-only"});
  const std::string log = bench.run(placer, arguments, netlist.top + "_pack.log");
  std::vector<ResourceCount> counts;
  for (const Resource& resource : target.resources)
    if (!resource.packed.empty())
      counts.push_back({resource.name, packed_count(log, resource.packed), resource.available});
  return counts;
}

PlacedDesign place_and_route(const Target& target, const PlaceRequest& request, const Tool& placer,
                             const Workbench& bench) {
  PlacedDesign placed;
  for (int seed = 1; seed <= request.seeds; ++seed) {
    request.progress(seed);
    const std::string name = fmt::format("{}_place_{}", request.top, seed);
    const std::string report = name + ".json";
    std::vector<std::string> arguments = target.placer.value().options;
    // A clock that is not reached is a result, not an error.
    arguments.insert(arguments.end(), {"--json", request.netlist, "--top", request.top, "--seed",
                                       std::to_string(seed), "--report", report, "--timing-allow-fail"});
    if (request.board != nullptr) {
      const BoardFlow& flow = target.placer->board.value();
      const std::string pins = flow.pins_file(request.top);
      bench.put_and_keep(rtl::with_licence({pins, flow.pin_constraints(*request.board)}));
      arguments.insert(arguments.end(),
                       {flow.pins_option, pins, flow.placed_option, flow.placed_file(request.top, seed)});
    }
    const host::Outcome outcome = bench.try_run(placer, arguments, name + ".log");
    if (!outcome.succeeded()) {
      const std::string error = error_in(outcome.err + outcome.out);
      if (is_lack_of_room(error)) return {{}, error};
      throw std::runtime_error(fmt::format("{}: {}; its output is in {}", placer.name(), outcome.failure(),
                                           (bench.kept() / (name + ".log")).string()));
    }
    bench.keep(report);
    if (request.board != nullptr) bench.keep(target.placer->board->placed_file(request.top, seed));
    placed.seeds.push_back(read_report(bench.read(report), request.clock));
    placed.seeds.back().seed = seed;
  }
  return placed;
}

}  // namespace hitpipe::sim
