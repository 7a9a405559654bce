#include "sim/core/memory_port.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"
#include "rays/files/json_place.hpp"
#include "rays/image/core_image.hpp"
#include "rtl_gen/core/feature.hpp"
#include "sw_ref/memory/line_cache.hpp"

namespace hitpipe::sim {

namespace {

constexpr std::array known{
    KnownMemory{"ideal", "latency 100, a block in every cycle", {}},
    KnownMemory{
        "dram",
        "latency 30, 9 cycles for 32 bytes, 12 for 64",
        {.least_latency = 30, .most_latency = 30, .beat_bytes = 32, .beat_cycles = 3, .burst_cycles = 6}},
    KnownMemory{"litedram-128",
                "LiteDRAM of a LiteX SoC with a port of 128 bits: DDR3 of 16 pins at a rate of 1:4",
                {.least_latency = 15,
                 .most_latency = 15,
                 .beat_bytes = 16,
                 .rows = {.row_bytes = 2048,
                          .banks = 8,
                          .bank_cycles = 3,
                          .closed_cycles = 5,
                          .row_cycles = 8,
                          .refresh_every = 782,
                          .refresh_cycles = 39}}},
    KnownMemory{"litedram-64",
                "the same with a port of 64 bits",
                {.least_latency = 17,
                 .most_latency = 17,
                 .beat_bytes = 16,
                 .beat_cycles = 15,
                 .rows = {.row_bytes = 2048,
                          .banks = 8,
                          .bank_cycles = 1,
                          .closed_cycles = 5,
                          .row_cycles = 8,
                          .refresh_every = 782,
                          .refresh_cycles = 27}}},
    KnownMemory{"axi-256", "latency 60, 32 bytes in every cycle", {.least_latency = 60, .most_latency = 60}}};

struct Figure {
  std::string_view name;
  int& (*value)(MemoryPort&);
  int least, most;
  bool is_power = false;  ///< of two
};
constexpr std::array figures{
    Figure{"beat_bytes", [](MemoryPort& port) -> int& { return port.beat_bytes; }, 1, 64, true},
    Figure{"beat_cycles", [](MemoryPort& port) -> int& { return port.beat_cycles; }, 1, 100},
    Figure{"burst_cycles", [](MemoryPort& port) -> int& { return port.burst_cycles; }, 0, 1000},
    Figure{"row_bytes", [](MemoryPort& port) -> int& { return port.rows.row_bytes; }, 64, 65'536, true},
    Figure{"banks", [](MemoryPort& port) -> int& { return port.rows.banks; }, 1, 64, true},
    Figure{"bank_cycles", [](MemoryPort& port) -> int& { return port.rows.bank_cycles; }, 0, 1000},
    Figure{"closed_cycles", [](MemoryPort& port) -> int& { return port.rows.closed_cycles; }, 0, 1000},
    Figure{"row_cycles", [](MemoryPort& port) -> int& { return port.rows.row_cycles; }, 0, 1000},
    Figure{"refresh_every", [](MemoryPort& port) -> int& { return port.rows.refresh_every; }, 0, 1'000'000},
    Figure{"refresh_cycles", [](MemoryPort& port) -> int& { return port.rows.refresh_cycles; }, 0, 10'000},
    Figure{"refused_percent", [](MemoryPort& port) -> int& { return port.refused_percent; }, 0, 99}};

[[noreturn]] void refuse(std::string_view figure, std::string_view value, std::string_view allowed) {
  throw std::runtime_error(fmt::format("{} is {}; allowed is {}", figure, value, allowed));
}

int number_of(std::string_view figure, const std::string& text, int least, int most) {
  const auto number = host::number_in<int>(text);
  if (!number || *number < least || *number > most)
    refuse(figure, text, fmt::format("{} to {}", least, most));
  return *number;
}

void set(MemoryPort& port, const std::string& name, const std::string& value) {
  if (name == "latency") {
    const std::size_t dots = value.find("..");
    const auto cycles = [](const std::string& text) {
      return number_of("latency", text, 1, MemoryOptions::most_cycles);
    };
    port.least_latency = cycles(value.substr(0, dots));
    port.most_latency = dots == std::string::npos ? port.least_latency : cycles(value.substr(dots + 2));
    if (port.least_latency > port.most_latency) refuse("latency", value, "the least, and then the most");
    return;
  }
  const auto figure =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& each) { return each.name == name; });
  if (figure == figures.end())
    throw std::runtime_error(fmt::format("there is no figure {}; allowed is {}", name, figure_names()));
  const int number = number_of(name, value, figure->least, figure->most);
  if (figure->is_power && (number & (number - 1)) != 0) refuse(name, value, "a power of two");
  figure->value(port) = number;
}

MemoryPort port_of(const std::filesystem::path& file) {
  const nlohmann::json text = ref::parse_json(file);
  const ref::Place top(text);
  MemoryPort port;
  for (const auto& [name, place] : top.members()) {
    const auto count = [](const ref::Place& each) { return each.count(1'000'000); };
    const bool is_range = name == "latency" && text.at(name).is_array();
    if (is_range && place.size() != 2)
      place.fail("it has not two numbers; allowed is the least and the most");
    set(port, name,
        is_range ? fmt::format("{}..{}", count(place.element(0)), count(place.element(1)))
                 : fmt::format("{}", count(place)));
  }
  return port;
}

MemoryPort named(const std::string& name) {
  for (const KnownMemory& each : known)
    if (each.name == name) return each.port;
  if (std::filesystem::exists(name)) return port_of(name);
  std::vector<std::string_view> names;
  for (const KnownMemory& each : known) names.push_back(each.name);
  throw std::runtime_error(
      fmt::format("there is no memory {}; allowed is {}, or a JSON file", name, fmt::join(names, ", ")));
}

}  // namespace

int MemoryPort::cycles_of(int bytes) const {
  return (bytes + beat_bytes - 1) / beat_bytes * beat_cycles + burst_cycles;
}

std::span<const KnownMemory> known_memories() {
  return known;
}

std::string figure_names() {
  std::string names = "latency";
  for (const Figure& each : figures) names += fmt::format(", {}", each.name);
  return names;
}

MemoryPort memory_port(const std::string& text) {
  const std::vector<std::string> parts = host::csv_cells(text);
  try {
    MemoryPort port = named(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const std::size_t equals = parts[i].find('=');
      if (equals == std::string::npos) refuse("a figure", parts[i], "FIGURE=N");
      set(port, parts[i].substr(0, equals), parts[i].substr(equals + 1));
    }
    return port;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("memory {}: {}", parts.front(), error.what()));
  }
}

MemoryOptions memory_behind(const MemoryPort& port, const rtl::CoreOptions& core) {
  constexpr auto block = static_cast<int>(ref::core_block_bytes);
  const rtl::CoreBus bus = rtl::bus_of(core);
  const int line = bus.has_lines ? bus.burst_bits / 8 : static_cast<int>(ref::CacheShape{}.line_bytes);
  const auto interval = [&](int bytes) {
    const int beats = (8 * bytes + bus.data_bits - 1) / bus.data_bits;
    return std::max(port.cycles_of(bytes), beats);
  };
  return {.least_latency = port.least_latency,
          .most_latency = port.most_latency,
          .in_order = bus.has_one_id,
          .reads_lines = bus.has_lines,
          .interval = interval(block),
          .line_interval = interval(line),
          .line_bytes = line,
          .rows = port.rows,
          .refused_percent = port.refused_percent};
}

}  // namespace hitpipe::sim
