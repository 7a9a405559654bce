// Sends tests to the unit on a board and compares what comes back. Many tests are on their way at once. A
// test whose frame or answer was damaged is sent again.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/serial_port.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/draw.hpp"
#include "sim/board/frame_link.hpp"

namespace hitpipe::sim {

/// A test whose results differ from the C++.
struct WrongAnswer {
  std::uint64_t number = 0;  ///< of the test, from 0
  rtl::Vector test;          ///< with the results by the C++
  std::vector<std::int64_t> results;
};

struct BoardCounts {
  std::uint64_t tests = 0;  ///< answered
  std::uint64_t hits = 0;   ///< verdicts that are yes, as the board says
  std::uint64_t mismatches = 0;
  std::uint64_t resent = 0;  ///< tests that were sent again, because no answer came
  std::uint64_t bytes_sent = 0, bytes_received = 0;
  double seconds = 0;
  std::optional<WrongAnswer> first_wrong;
};

/// A test and its number; nothing when there are no more.
struct NumberedTest {
  std::uint64_t number;
  rtl::Vector test;
};

class BoardLink {
 public:
  using Patience = FrameLink::Patience;

  BoardLink(host::SerialPort& port, const rtl::Design& design, const Format& format)
      : BoardLink(port, design, format, Patience{}) {}
  BoardLink(host::SerialPort& port, const rtl::Design& design, const Format& format,
            const Patience& patience);

  /// What the board says that it is (rtl::board_identity). Throws std::runtime_error, one line, when nothing
  /// answers.
  [[nodiscard]] std::string identity() { return link_.identity(); }
  /// Throws std::runtime_error, one line, when the board has another unit.
  void require_same_unit();

  /// Throws WrongHardware, one line, when the board does not answer any more.
  [[nodiscard]] BoardCounts run(const std::function<std::optional<NumberedTest>()>& next);

 private:
  FrameLink link_;
  const rtl::Design& design_;
  Format format_;
  std::vector<rtl::Port> operands_;
  std::vector<rtl::Port> results_;
  rtl::Verdict verdict_;
};

}  // namespace hitpipe::sim
