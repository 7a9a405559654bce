// A serial port: a device, or a pseudo-terminal of our own that another program opens as one.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace hitpipe::host {

/// The rates that a port can have, in ascending order.
[[nodiscard]] std::vector<int> baud_rates();

class SerialPort {
 public:
  /// Eight data bits, no parity, a stop bit, no flow control; every byte passes as it is. What the port still
  /// held is thrown away. Throws std::runtime_error, one line, when there is no such port, it cannot be
  /// opened, or it does not have that rate.
  static SerialPort open(const std::string& name, int baud);
  /// Our end of a new pseudo-terminal. It stays when the other program closes its end, so that a next one can
  /// open it. Throws std::runtime_error, one line, when the system gives none.
  static SerialPort pseudo_terminal();

  ~SerialPort();
  SerialPort(SerialPort&& other) noexcept;
  SerialPort& operator=(SerialPort&&) = delete;

  /// What others open; of a device its own name.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Writes what the port takes of `out`, and removes it from there. Returns what has come. Waits at most
  /// `patience` until something can be written or has come. Throws std::runtime_error, one line, when the
  /// port is gone.
  [[nodiscard]] std::string exchange(std::string& out, std::chrono::milliseconds patience);

 private:
  SerialPort(std::string name, int descriptor, int other_end = -1)
      : name_(std::move(name)), descriptor_(descriptor), other_end_(other_end) {}

  std::string name_;
  int descriptor_;
  int other_end_;  ///< of our own pseudo-terminal; -1: none
};

}  // namespace hitpipe::host
