#include "sim/implement/energy.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace {

constexpr double power_period_ns = 10;

/// One bit of a net in the file.
struct Bit {
  std::string name;
  bool value = false;
  std::int64_t since = 0;
  std::int64_t high = 0;
  std::int64_t toggles = 0;
  std::int64_t rises = 0;

  void set(bool now, std::int64_t time) {
    if (value) high += time - since;
    since = time;
    if (now == value) return;
    ++toggles;
    if (now) ++rises;
    value = now;
  }
};

/// A net, highest bit first.
using Net = std::vector<Bit>;

/// "name", or "name [7:0]" of a vector.
Net declared(std::istringstream& line, std::size_t width) {
  std::string name;
  std::string range;
  line >> name >> range;
  if (name.starts_with('\\')) name.erase(0, 1);
  if (!range.starts_with('[') || range.find(':') == std::string::npos)
    return {{.name = range.starts_with('[') ? name + range : name}};
  int high = std::stoi(range.substr(1));
  const int low = std::stoi(range.substr(range.find(':') + 1));
  Net net;
  for (std::size_t i = 0; i<width; ++i, high += high> low ? -1 : 1)
    net.push_back({.name = fmt::format("{}[{}]", name, high)});
  return net;
}

/// In joules of a second, from a line of report_power: internal, switching, leakage, total.
double total_of(const std::string& report, const std::string& group) {
  const std::size_t at = report.find("\n" + group + " ");
  if (at == std::string::npos) throw std::runtime_error("OpenSTA reported no power");
  std::istringstream line(
      report.substr(at + 1 + group.size(), report.find('\n', at + 1) - at - 1 - group.size()));
  double internal = 0, switching = 0, leakage = 0, total = 0;
  if (!(line >> internal >> switching >> leakage >> total))
    throw std::runtime_error("OpenSTA's power cannot be read");
  return total;
}

constexpr std::string_view unknown_net = "hitpipe: no activity of ";

/// Constants do not move. Pins of a net all have its activity.
constexpr const char* power_script = R"(read_liberty {}
read_verilog {}
link_design {}
create_clock -name clock -period {} {}
# A line for each net: its name, toggles a cycle, share of the time that it is high.
set file [open {}]
while {{[gets $file line] >= 0}} {{ set activity([lindex $line 0]) [lrange $line 1 2] }}
close $file
foreach net [get_nets *] {{
  set name [get_full_name $net]
  if {{$name == "{}"}} continue
  if {{$name == "zero_" || $name == "one_"}} {{ set activity($name) {{0 0}} }}
  if {{![info exists activity($name)]}} {{ puts "{}$name"; continue }}
  foreach pin [get_pins -of_objects $net] {{ sta::set_power_pin_activity $pin {{*}}$activity($name) }}
}}
report_power -digits 9
)";

}  // namespace

Activity read_activity(const std::string& vcd, const std::string& clock) {
  std::map<std::string, std::vector<Net>> nets;  // by the file's short names; connected nets have one
  std::istringstream in(vcd);
  std::vector<Net> none;
  const auto named = [&](const std::string& id) -> std::vector<Net>& {
    const auto found = nets.find(id);
    return found == nets.end() ? none : found->second;
  };
  std::string line;
  std::int64_t time = 0;
  while (std::getline(in, line)) {
    if (line.empty()) continue;
    const char kind = line.front();
    if (line.starts_with("$var ")) {
      std::istringstream words(line);
      std::string word, type, id;
      std::size_t width = 0;
      words >> word >> type >> width >> id;
      nets[id].push_back(declared(words, width));
    } else if (kind == '#') {
      time = std::atoll(line.c_str() + 1);
    } else if (kind == '0' || kind == '1' || kind == 'x' || kind == 'z') {
      for (Net& net : named(line.substr(1))) net.front().set(kind == '1', time);
    } else if (kind == 'b') {
      const std::size_t end = line.find(' ');
      const std::string value = line.substr(1, end - 1);  // zeros above the first digit are left out
      for (Net& net : named(line.substr(end + 1))) {
        for (std::size_t i = 0; i < net.size(); ++i) {
          const std::size_t place = i + value.size();
          net[i].set(place >= net.size() && value[place - net.size()] == '1', time);
        }
      }
    }
  }
  Activity activity;
  for (const auto& [id, same] : nets)
    for (const Net& net : same)
      if (net.front().name == clock) activity.cycles = net.front().rises;
  if (activity.cycles == 0) throw std::runtime_error(fmt::format("the waves have no clock {}", clock));
  const auto cycles = static_cast<double>(activity.cycles);
  for (auto& [id, same] : nets) {
    for (Net& net : same) {
      for (Bit& bit : net) {
        bit.set(bit.value, time);
        activity.nets[bit.name] = {static_cast<double>(bit.toggles) / cycles,
                                   time == 0 ? 0 : static_cast<double>(bit.high) / static_cast<double>(time)};
      }
    }
  }
  return activity;
}

Energy energy_of(const Target& target, const Synthesis& netlist, const Activity& activity, std::int64_t tests,
                 const std::string& clock, const Tool& sta, const Workbench& bench) {
  std::string lines;
  for (const auto& [name, net] : activity.nets)
    lines += fmt::format("{{{}}} {:.6g} {:.6g}\n", name, net.toggles, net.high);
  const std::string activities = netlist.top + "_activity.txt";
  const std::string name = netlist.top + "_power.tcl";
  bench.put_and_keep({activities, lines});
  bench.put_and_keep({name, fmt::format(power_script, target.liberty, netlist.verilog(), netlist.top,
                                        power_period_ns, clock, activities, clock, unknown_net)});
  const std::string report = bench.run(sta, {"-exit", name}, netlist.top + "_power.log");
  if (const std::size_t at = report.find(unknown_net); at != std::string::npos)
    throw std::runtime_error(
        fmt::format("the simulation did not dump the net {}",
                    report.substr(at + unknown_net.size(), report.find('\n', at) - at - unknown_net.size())));
  const double watts = total_of(report, "Total");
  const double cycles_per_test = static_cast<double>(activity.cycles) / static_cast<double>(tests);
  constexpr double pj_per_w_ns = 1000;
  return {watts * power_period_ns * pj_per_w_ns * cycles_per_test,
          watts > 0 ? 100 * total_of(report, "Sequential") / watts : 0, cycles_per_test};
}

}  // namespace hitpipe::sim
