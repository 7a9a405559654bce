// A board of a test: the top module with a small unit, run by a thread behind a pseudo-terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include "rtl_gen/board/top.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "sim/board/frame_link.hpp"
#include "sim/board/simulated_board.hpp"

namespace hitpipe::sim {

struct BoardUnderTest {
  std::string design = "int_slabs";
  std::string bits = "6/6";
  int interval = 1;
  /// Replaced in the Verilog, once.
  std::string good{}, bad{};
  std::function<bool(std::uint64_t)> loses = [](std::uint64_t) { return false; };
};

inline SimulatedBoard::Options setup_of(const BoardUnderTest& board) {
  const rtl::Design& design = rtl::find_design(board.design);
  const Format format = design.parse_format(board.bits);
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(design.trace(format), rtl::Library::thesis(), std::nullopt, board.interval);
  const std::string unit = design.module_at(format);
  std::string verilog =
      rtl::to_verilog(pipeline, rtl::Library::thesis(), {.module_name = unit, .bits = board.bits}) +
      rtl::board_top(rtl::board_unit(design, format, unit, pipeline), simulated_clocks_per_bit);
  // Throws when it is not there.
  if (!board.good.empty()) verilog.replace(verilog.find(board.good), board.good.size(), board.bad);
  return {.module = rtl::board_module(unit), .verilog = verilog, .loses = board.loses};
}

/// A board that a thread runs.
class RunningBoard {
 public:
  explicit RunningBoard(SimulatedBoard::Options options)
      : board_(counting(std::move(options))),
        thread_([this] { board_.run([this] { return stop_.load(); }); }) {}
  ~RunningBoard() {
    stop_ = true;
    thread_.join();
  }
  RunningBoard(const RunningBoard&) = delete;
  RunningBoard& operator=(const RunningBoard&) = delete;

  [[nodiscard]] const std::string& port() const { return board_.port(); }

  /// Its time passes only while the board has nothing to do, so the board may be as slow as it likes. It
  /// must not outlive this.
  [[nodiscard]] FrameLink::Patience patience(std::chrono::milliseconds silence = std::chrono::seconds(10),
                                             int tries = 4) const {
    // A step for each call at most, because what has come is read between two calls.
    const auto now = [this, seen = 0, time = std::chrono::steady_clock::time_point()]() mutable {
      if (std::exchange(seen, waits_.load()) != seen) time += std::chrono::milliseconds(20);
      return time;
    };
    return {silence, tries, now};
  }

 private:
  SimulatedBoard::Options counting(SimulatedBoard::Options options) {
    options.waits = [this] { ++waits_; };
    return options;
  }

  std::atomic<int> waits_ = 0;
  SimulatedBoard board_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

class ServedBoard : public RunningBoard {
 public:
  explicit ServedBoard(const BoardUnderTest& board = {}) : RunningBoard(setup_of(board)) {}
};

}  // namespace hitpipe::sim
