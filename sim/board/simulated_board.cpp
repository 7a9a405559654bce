#include "sim/board/simulated_board.hpp"

#include <deque>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "sim/model/model_source.hpp"

namespace hitpipe::sim {

namespace {

/// The computer's end of a serial line, clock by clock. It shares no code with the Verilog.
class ByteSender {
 public:
  explicit ByteSender(int clocks_per_bit) : clocks_per_bit_(clocks_per_bit) {}
  void send(char byte) { bytes_.push_back(static_cast<unsigned char>(byte)); }
  [[nodiscard]] bool idle() const { return bytes_.empty(); }
  /// The level in the next clock cycle.
  [[nodiscard]] int level() {
    if (bytes_.empty()) return 1;
    const unsigned frame = (bytes_.front() << 1U) | 0x200U;  // a start bit below, a stop bit above
    const int level = static_cast<int>((frame >> (clock_ / clocks_per_bit_)) & 1U);
    if (++clock_ == 10 * clocks_per_bit_) {
      clock_ = 0;
      bytes_.pop_front();
    }
    return level;
  }

 private:
  int clocks_per_bit_;
  std::deque<unsigned> bytes_;
  int clock_ = 0;  ///< of the first byte
};

class ByteReceiver {
 public:
  explicit ByteReceiver(int clocks_per_bit) : clocks_per_bit_(clocks_per_bit) {}
  [[nodiscard]] bool idle() const { return clock_ < 0; }
  /// A byte when this clock cycle is the middle of its stop bit.
  std::optional<char> see(int level) {
    if (clock_ < 0 && level != 0) return std::nullopt;
    ++clock_;
    const int bit = clock_ / clocks_per_bit_;
    if (clock_ % clocks_per_bit_ != clocks_per_bit_ / 2) return std::nullopt;
    if (bit >= 1 && bit <= 8) byte_ |= static_cast<unsigned>(level) << (bit - 1);
    if (bit < 9) return std::nullopt;
    clock_ = -1;
    return static_cast<char>(std::exchange(byte_, 0U));
  }

 private:
  int clocks_per_bit_;
  int clock_ = -1;  ///< since the start bit began; -1: the line is idle
  unsigned byte_ = 0;
};

std::string board_wrapper(const std::string& module) {
  return instance_source(module) + fmt::format(R"(
HITPIPE_ENTRY int hitpipe_board_cycle(void* model, int rx) {{
  V{0}& top = static_cast<Model*>(model)->top;
  top.clk = 0;
  top.rx = static_cast<unsigned char>(rx);
  top.button_n = 1;
  top.eval();
  top.clk = 1;
  top.eval();
  return top.tx;
}}
)",
                                               module);
}

constexpr int power_on_clocks = 100;  // longer than reset
constexpr int clocks_per_exchange = 400;

}  // namespace

SimulatedBoard::SimulatedBoard(Options options, const std::filesystem::path& cache)
    : options_(std::move(options)),
      line_(host::SerialPort::pseudo_terminal()),
      library_({options_.module, options_.verilog, board_wrapper(options_.module)}, cache),
      cycle_(library_.entry_point<Cycle>("hitpipe_board_cycle")),
      model_(library_.create()) {
  for (int clock = 0; clock < power_on_clocks; ++clock) cycle_(model_, 1);
}

SimulatedBoard::~SimulatedBoard() {
  library_.destroy(model_);
}

void SimulatedBoard::run(const std::function<bool()>& stop) {
  ByteSender to_board(options_.clocks_per_bit);
  ByteReceiver from_board(options_.clocks_per_bit);
  std::string out;
  std::uint64_t come = 0, gone = 0;
  int quiet = 0;
  while (!stop()) {
    constexpr std::chrono::milliseconds patience{20};
    const bool sleeping = quiet >= options_.quiet_clocks;
    for (const char byte : line_.exchange(out, sleeping ? patience : std::chrono::milliseconds{0}))
      if (!options_.loses(come++)) to_board.send(byte);
    if (sleeping && to_board.idle()) {
      options_.waits();
      continue;
    }
    for (int clock = 0; clock < clocks_per_exchange; ++clock) {
      quiet = to_board.idle() && from_board.idle() ? quiet + 1 : 0;
      const std::optional<char> byte = from_board.see(cycle_(model_, to_board.level()));
      if (byte && !options_.loses_answer(gone++)) out += *byte;
    }
  }
}

}  // namespace hitpipe::sim
