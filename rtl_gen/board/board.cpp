#include "rtl_gen/board/board.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "host/format.hpp"
#include "host/text.hpp"
#include "rtl_gen/board/top.hpp"

namespace hitpipe::rtl {

namespace {

// The line is sampled in the middle of a bit, which a receiver with fewer cycles would miss by too much.
constexpr int least_clocks_per_bit = 4;
// Ten bits in a row must not drift by half a bit: each side may be off by this much.
constexpr double most_baud_error = 0.02;

/// The core whose image lies in a memory of the chip (rtl_gen/board/core_top.hpp). Its triangle test is the
/// small one.
CoreOptions core_of(const nlohmann::ordered_json& json) {
  CoreOptions core;
  core.bits = parse_bits<hls::RayBits>(json.at("bits").get<std::string>());
  core.rays = json.at("rays").get<int>();
  core.stack_bits = json.at("stack_bits").get<int>();
  core.levels = json.at("levels").get<int>();
  core.address_bits = json.at("address_bits").get<int>();
  core.byte_bits = core.address_bits + 5;
  core.tag_bits = 8;
  core.serial_triangle = true;
  core.clock_ps = json.at("clock_ps").get<int>();
  core.block_rams = json.at("block_rams").get<int>();
  return core;
}

}  // namespace

int Board::unit_clock_ps() const {
  return static_cast<int>(750'000'000'000 / clock_hz);
}

int Board::clocks_per_bit(int baud_rate) const {
  const double exact = baud_rate > 0 ? static_cast<double>(clock_hz) / baud_rate : 0.0;
  const double clocks = std::round(exact);
  if (clocks < least_clocks_per_bit || clocks > std::numeric_limits<std::uint16_t>::max() ||
      std::abs(clocks / exact - 1.0) > most_baud_error)
    throw std::runtime_error(fmt::format(
        "{} baud: the clock of {} ({} Hz) must be 4 to 65535 times as fast and a whole multiple within 2 %; "
        "{} is usual",
        baud_rate, name, clock_hz, baud));
  return static_cast<int>(clocks);
}

std::vector<std::string> board_names() {
  std::vector<std::string> names;
  for (const BoardFile& file : board_files()) names.emplace_back(file.name);
  return names;
}

Board parse_board(const BoardFile& file) {
  Board board;
  board.name = file.name;
  try {
    const auto json = nlohmann::ordered_json::parse(file.json);
    board.description = json.at("description").get<std::string>();
    board.source = json.at("source").get<std::string>();
    board.target = json.at("target").get<std::string>();
    board.design = json.at("design").get<std::string>();
    board.bits = json.at("bits").get<std::string>();
    board.clock_hz = json.at("clock_hz").get<int>();
    board.baud = json.at("baud").get<int>();
    for (const auto& [port, pin] : json.at("pins").items())
      board.pins.push_back({port, pin.is_string() ? pin.get<std::string>() : pin.dump()});
    if (json.contains("core")) board.core = core_of(json.at("core"));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("board {}: {}", file.name, error.what()));
  }
  if (board.clock_hz <= 0)
    throw std::runtime_error(fmt::format("board {}: clock_hz {} must be above 0", file.name, board.clock_hz));
  for (const std::string_view port : top_ports) {
    if (std::none_of(board.pins.begin(), board.pins.end(),
                     [&](const BoardPin& pin) { return pin.port == port; }))
      throw std::runtime_error(fmt::format("board {}: port {} has no pin", file.name, port));
  }
  return board;
}

Board find_board(std::string_view name) {
  const auto files = board_files();
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const BoardFile& file) { return file.name == name; });
  if (found == files.end())
    throw std::runtime_error(fmt::format("board {}: unknown; there are: {}", host::shortened(name),
                                         fmt::join(board_names(), ", ")));
  return parse_board(*found);
}

}  // namespace hitpipe::rtl
