#include "rtl_gen/prune/check_block.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hls/num/bits.hpp"
#include "rtl_gen/prune/facts.hpp"

namespace hitpipe::rtl {

namespace {

const Port* port_called(const std::vector<Port>& ports, const std::string& name) {
  const auto found = std::find_if(ports.begin(), ports.end(), [&](const Port& p) { return p.name == name; });
  return found == ports.end() ? nullptr : &*found;
}

std::uint64_t pattern_in(std::int64_t number, int width) {
  return static_cast<std::uint64_t>(number) & hls::low_mask(width);
}

std::string literal(const Port& port, std::int64_t number) {
  return fmt::format("{}'{}h{:x}", port.width, port.is_signed ? "s" : "", pattern_in(number, port.width));
}

std::string operand(const Port& port) {
  return port.is_signed ? fmt::format("$signed({})", port.name) : port.name;
}

/// The demanded intervals in the numbers of a port that pruning may have made narrower; none when the port
/// cannot tell.
std::optional<std::vector<Interval>> as_seen_at(const Port& port, const PortDemand& demand) {
  const Interval all = all_numbers(port);
  const Interval wanted = hull(demand);
  if (wanted.low >= all.low && wanted.high <= all.high) return demand.within;
  // The missing high bits are the same in all demanded numbers: subtract their value.
  if (port.is_signed || port.width > 62 || wanted.low >> port.width != wanted.high >> port.width)
    return std::nullopt;
  const std::int64_t above = (wanted.low >> port.width) * (std::int64_t{1} << port.width);
  std::vector<Interval> seen;
  for (const Interval& each : demand.within) seen.push_back({each.low - above, each.high - above});
  return seen;
}

/// The Verilog condition that a port's number is in the interval; empty when it always is. A comparison that
/// cannot fail is left out, as a linter would warn of it.
std::string inside(const Port& port, const Interval& i) {
  const Interval all = all_numbers(port);
  if (i.low == i.high) return fmt::format("{} == {}", operand(port), literal(port, i.low));
  std::vector<std::string> terms;
  if (i.low > all.low) terms.push_back(fmt::format("{} >= {}", operand(port), literal(port, i.low)));
  if (i.high < all.high) terms.push_back(fmt::format("{} <= {}", operand(port), literal(port, i.high)));
  return fmt::format("{}", fmt::join(terms, " && "));
}

/// The Verilog condition that a port's number is in none of the intervals; empty when it always is in one.
std::string outside(const Port& port, const std::vector<Interval>& within) {
  std::vector<std::string> terms;
  for (const Interval& each : within) {
    const std::string term = inside(port, each);
    if (term.empty()) return "";
    terms.push_back(within.size() == 1 ? term : fmt::format("({})", term));
  }
  return fmt::format("!({})", fmt::join(terms, " || "));
}

/// The Verilog condition that the demand is broken: empty when these ports cannot break it, none when they
/// cannot tell.
std::optional<std::string> broken(const PortDemand& demand, const std::vector<Port>& ports) {
  const Port* const port = port_called(ports, demand.port);
  if (port == nullptr) return std::nullopt;
  const auto within = as_seen_at(*port, demand);
  if (!within) return std::nullopt;
  const std::string beyond = outside(*port, *within);
  if (demand.low_zeros == 0) return beyond;
  const std::string low =
      port->width > 1 ? fmt::format("{}[{}:0]", port->name, std::min(demand.low_zeros, port->width) - 1)
                      : port->name;
  return fmt::format("{}{}|{}", beyond, beyond.empty() ? "" : " || ", low);
}

std::string widened(const Port& port, int width) {
  if (port.width == width) return port.name;
  const std::string fill = port.is_signed && port.width > 1 ? fmt::format("{}[{}]", port.name, port.width - 1)
                           : port.is_signed                 ? port.name
                                                            : "1'b0";
  return fmt::format("{{{{{}{{{}}}}}, {}}}", width - port.width, fill, port.name);
}

/// Whether the port, read with its own sign, has the numbers of the original.
bool keeps_numbers(const Demands& demands, const Port& original, const Port& port) {
  const auto demand = std::find_if(demands.ports.begin(), demands.ports.end(),
                                   [&](const PortDemand& d) { return d.port == port.name; });
  const Interval numbers = demand == demands.ports.end() ? all_numbers(original) : hull(*demand);
  const Interval all = all_numbers(port);
  return numbers.low >= all.low && numbers.high <= all.high;
}

std::optional<std::string> broken(const OrderDemand& order, const Demands& demands,
                                  const std::vector<Port>& original, const std::vector<Port>& ports) {
  const Port* const lesser = port_called(ports, order.lesser);
  const Port* const greater = port_called(ports, order.greater);
  if (lesser == nullptr || greater == nullptr) return std::nullopt;
  if (!keeps_numbers(demands, *port_called(original, order.lesser), *lesser) ||
      !keeps_numbers(demands, *port_called(original, order.greater), *greater))
    return std::nullopt;
  // An unsigned port needs one bit more beside a signed port.
  const bool is_signed = lesser->is_signed || greater->is_signed;
  const auto need = [&](const Port& p) { return p.width + (is_signed && !p.is_signed ? 1 : 0); };
  const int width = std::max(need(*lesser), need(*greater));
  const char* const form = is_signed ? "$signed({}) > $signed({})" : "{} > {}";
  return fmt::format(fmt::runtime(form), widened(*lesser, width), widened(*greater, width));
}

struct Check {
  std::string demand;
  std::optional<std::string> broken;
  std::vector<std::string> ports;
};

std::vector<Check> checks(const Demands& demands, const std::vector<Port>& original,
                          const std::vector<Port>& ports) {
  std::vector<Check> all;
  for (std::size_t i = 0; i < demands.ports.size(); ++i)
    all.push_back({demand_text(demands, i), broken(demands.ports[i], ports), {demands.ports[i].port}});
  for (std::size_t i = 0; i < demands.orders.size(); ++i) {
    const OrderDemand& order = demands.orders[i];
    all.push_back({demand_text(demands, demands.ports.size() + i),
                   broken(order, demands, original, ports),
                   {order.lesser, order.greater}});
  }
  return all;
}

}  // namespace

std::string check_block(const ModuleInterface& unit, const Demands& demands,
                        const std::vector<Port>& original) {
  if (demands.empty()) return "";
  std::string text = "\n  // Demands that the unit was fitted to.\n";
  std::string tests;
  for (const Check& check : checks(demands, original, unit.operands())) {
    if (!check.broken) {
      text += fmt::format("  //   {}: not seen at these ports\n", check.demand);
      continue;
    }
    if (check.broken->empty()) continue;
    tests += fmt::format("      if ({}) begin\n", *check.broken);
    tests += fmt::format("        $display(\"{}: {} is broken by", unit.module, check.demand);
    for (const std::string& port : check.ports) tests += fmt::format(" {} = %h", port);
    tests += fmt::format("\", {});\n        $fatal(1);\n      end\n", fmt::join(check.ports, ", "));
  }
  if (tests.empty()) return text;
  return text + fmt::format(
                    "`ifdef HITPIPE_CHECK\n`ifndef SYNTHESIS\n  always @(posedge clk) begin\n"
                    "    if (in_valid{} && !rst) begin\n{}    end\n  end\n`endif\n`endif\n",
                    unit.has_ready(tests_channel) ? " && in_ready" : "", tests);
}

std::string with_check_block(const std::string& verilog, const std::string& block) {
  const std::size_t end = verilog.find("endmodule");
  if (end == std::string::npos) throw std::invalid_argument("Verilog without a module cannot take a block");
  return verilog.substr(0, end) + block + verilog.substr(end);
}

std::string check_module(const std::string& name, const Demands& demands, const std::vector<Port>& original) {
  std::vector<std::string> ports;
  for (const Port& port : original) {
    const auto is_port = [&](const std::string& each) { return each == port.name; };
    const bool asked = std::any_of(demands.ports.begin(), demands.ports.end(),
                                   [&](const auto& d) { return is_port(d.port); }) ||
                       std::any_of(demands.orders.begin(), demands.orders.end(),
                                   [&](const auto& d) { return is_port(d.lesser) || is_port(d.greater); });
    if (asked) ports.push_back(fmt::format("input  wire {}{}", vector_range(port.width), port.name));
  }
  ports.push_back("output wire error");
  std::vector<std::string> terms;
  for (const Check& check : checks(demands, original, original)) {
    if (!check.broken->empty()) terms.push_back(fmt::format("({})", *check.broken));
  }
  if (terms.empty()) terms.push_back("1'b0");
  return fmt::format(
      "// {}: 1 when an operand is not as demanded.\nmodule {} (\n  {}\n);\n  assign error = "
      "{};\nendmodule\n",
      name, name, fmt::join(ports, ",\n  "), fmt::join(terms, "\n    || "));
}

}  // namespace hitpipe::rtl
