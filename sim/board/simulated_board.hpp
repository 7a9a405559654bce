// The chip of a board in place of the board: the same top module, as Verilator compiles it, with the serial
// line of a pseudo-terminal.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "host/serial_port.hpp"
#include "sim/model/model_library.hpp"

namespace hitpipe::sim {

/// Far fewer than on a board, so that less is simulated.
inline constexpr int simulated_clocks_per_bit = 4;
/// Cycles in which nothing is on the line, after which the clock stands still: longer than any unit needs to
/// answer, and longer than nearly all rays take in a core.
inline constexpr int unit_quiet_clocks = 1000;
inline constexpr int core_quiet_clocks = 200'000;

class SimulatedBoard {
 public:
  struct Options {
    std::string module;                             ///< the top (rtl::board_module)
    std::string verilog;                            ///< with the unit's
    int clocks_per_bit = simulated_clocks_per_bit;  ///< as the Verilog has it
    /// Whether the byte of that number is lost on its way to the board.
    std::function<bool(std::uint64_t)> loses = [](std::uint64_t) { return false; };
    /// Likewise on its way from the board.
    std::function<bool(std::uint64_t)> loses_answer = [](std::uint64_t) { return false; };
    int quiet_clocks = unit_quiet_clocks;
    /// Called about 50 times a second while the clock stands still.
    std::function<void()> waits = [] {};
  };

  /// Throws as ModelLibrary and host::SerialPort::pseudo_terminal() do.
  explicit SimulatedBoard(Options options, const std::filesystem::path& cache = default_cache());
  ~SimulatedBoard();
  SimulatedBoard(const SimulatedBoard&) = delete;
  SimulatedBoard& operator=(const SimulatedBoard&) = delete;

  /// The name of the pseudo-terminal.
  [[nodiscard]] const std::string& port() const { return line_.name(); }
  /// Runs until `stop` says so. The clock stands still while nothing is on the line.
  void run(const std::function<bool()>& stop);

 private:
  using Cycle = int (*)(void* model, int rx);

  Options options_;
  host::SerialPort line_;  ///< before the model, which is not yet there to destroy when there is no line
  ModelLibrary library_;
  Cycle cycle_;
  void* model_;
};

}  // namespace hitpipe::sim
