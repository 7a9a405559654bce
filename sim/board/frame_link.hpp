// Asks a board by frames and takes its answers. Several questions are on their way at once, each with a tag
// of its own. A question whose frame or answer was damaged is sent again.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/serial_port.hpp"
#include "sim/board/frame.hpp"

namespace hitpipe::sim {

class FrameLink {
 public:
  /// How long nothing may come before all is sent again, and how often that is tried.
  struct Patience {
    std::chrono::milliseconds silence{1000};
    int tries = 4;
    /// What tells the time. A simulated board may be slow, and then its own time counts.
    std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now;
  };
  struct Question {
    std::uint64_t number;  ///< for messages and for who asks
    std::string body;
  };
  /// Questions of one kind.
  struct Kind {
    char letter;
    std::string_view noun;     ///< "test", for messages
    std::size_t answer_bytes;  ///< of an answer's body
    std::size_t most_waiting;  ///< questions on their way
    /// So many questions that were sent later may be answered before one is lost.
    std::size_t overtaken = 0;
  };
  struct Counts {
    std::uint64_t answered = 0;
    std::uint64_t resent = 0;  ///< questions that were sent again, because no answer came
    std::uint64_t bytes_sent = 0, bytes_received = 0;
    double seconds = 0;
  };
  using Next = std::function<std::optional<Question>()>;  ///< nothing: there are no more
  using Answered = std::function<void(std::uint64_t number, std::string_view body)>;

  /// The port must outlive this.
  FrameLink(host::SerialPort& port, const Patience& patience) : port_(port), patience_(patience) {}

  /// What the board says that it is. Throws std::runtime_error, one line, when nothing answers.
  [[nodiscard]] std::string identity();
  /// Throws std::runtime_error, one line, when the board says otherwise than `here`, which `what` are for.
  void require(const std::string& here, std::string_view what);

  /// Asks until there are no more questions and each has its answer. Throws WrongHardware, one line, when the
  /// board does not answer any more.
  Counts run(const Kind& kind, const Next& next, const Answered& answered);

 private:
  struct Waiting {
    Question question;
    std::string frame;
    char tag;
    int sendings = 1;
    std::size_t overtaken = 0;
  };

  /// The payloads of the sound frames that have come.
  [[nodiscard]] std::vector<std::string> exchange(std::chrono::milliseconds wait);
  void fill(const Kind& kind, const Next& next);
  /// Whether it was the answer to a question that waits.
  bool receive(const Kind& kind, const std::string& payload, const Answered& answered);
  void send_again(const Kind& kind, std::size_t place);

  host::SerialPort& port_;
  Patience patience_;
  FrameReader reader_;
  std::string out_;
  std::vector<Waiting> waiting_;  ///< in the order in which they were sent
  bool more_ = true;
  unsigned next_tag_ = 0;
  Counts counts_;
};

}  // namespace hitpipe::sim
