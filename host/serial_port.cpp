#include "host/serial_port.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace hitpipe::host {

namespace {

struct Rate {
  int baud;
  speed_t speed;
};
constexpr std::array rates{Rate{9600, B9600},       Rate{19200, B19200},     Rate{38400, B38400},
                           Rate{57600, B57600},     Rate{115200, B115200},   Rate{230400, B230400},
                           Rate{460800, B460800},   Rate{500000, B500000},   Rate{921600, B921600},
                           Rate{1000000, B1000000}, Rate{1500000, B1500000}, Rate{2000000, B2000000},
                           Rate{3000000, B3000000}, Rate{4000000, B4000000}};

[[noreturn]] void fail_port(const std::string& name, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", name, what));
}

/// Every byte passes as it is.
void make_raw(int descriptor, const std::string& name, speed_t speed) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) fail_port(name, "is no serial port");
  cfmakeraw(&settings);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cflag |= CLOCAL | CREAD;
  if (cfsetspeed(&settings, speed) != 0 || tcsetattr(descriptor, TCSANOW, &settings) != 0)
    fail_port(name, "does not take its settings: " + std::generic_category().message(errno));
}

}  // namespace

std::vector<int> baud_rates() {
  std::vector<int> all;
  for (const Rate& rate : rates) all.push_back(rate.baud);
  return all;
}

SerialPort SerialPort::open(const std::string& name, int baud) {
  const auto rate = std::find_if(rates.begin(), rates.end(), [&](const Rate& r) { return r.baud == baud; });
  if (rate == rates.end())
    throw std::runtime_error(
        fmt::format("{} baud: serial ports have {}", baud, fmt::join(baud_rates(), ", ")));
  SerialPort port(name, ::open(name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (port.descriptor_ < 0)
    fail_port(name, "cannot be opened as a serial port: " + std::generic_category().message(errno));
  make_raw(port.descriptor_, name, rate->speed);
  tcflush(port.descriptor_, TCIOFLUSH);
  return port;
}

SerialPort SerialPort::pseudo_terminal() {
  const auto fail = [] {
    fail_port("no pseudo-terminal can be had",
              std::generic_category().message(errno) + "; is /dev/pts mounted?");
  };
  SerialPort port("", posix_openpt(O_RDWR | O_NOCTTY));
  std::array<char, 128> name{};
  if (port.descriptor_ < 0 || grantpt(port.descriptor_) != 0 || unlockpt(port.descriptor_) != 0 ||
      ptsname_r(port.descriptor_, name.data(), name.size()) != 0)
    fail();
  port.name_ = name.data();
  fcntl(port.descriptor_, F_SETFL, O_NONBLOCK);
  fcntl(port.descriptor_, F_SETFD, FD_CLOEXEC);
  port.other_end_ = ::open(port.name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (port.other_end_ < 0) fail();
  make_raw(port.other_end_, port.name_, B115200);
  return port;
}

SerialPort::SerialPort(SerialPort&& other) noexcept
    : name_(std::move(other.name_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      other_end_(std::exchange(other.other_end_, -1)) {}

SerialPort::~SerialPort() {
  for (const int each : {descriptor_, other_end_})
    if (each >= 0) close(each);
}

std::string SerialPort::exchange(std::string& out, std::chrono::milliseconds patience) {
  const short wanted = static_cast<short>(out.empty() ? POLLIN : POLLIN | POLLOUT);
  pollfd ready{.fd = descriptor_, .events = wanted, .revents = 0};
  const int count = poll(&ready, 1, static_cast<int>(patience.count()));
  if (count < 0 && errno == EINTR) return {};
  const auto check = [&](ssize_t done) {
    if (done >= 0) return static_cast<std::size_t>(done);
    if (errno == EAGAIN || errno == EINTR) return std::size_t{0};
    fail_port(name_, "is gone: " + std::generic_category().message(errno));
  };
  if (count > 0 && !out.empty() && (ready.revents & POLLOUT) != 0)
    out.erase(0, check(write(descriptor_, out.data(), out.size())));
  if (count <= 0 || (ready.revents & (POLLIN | POLLHUP | POLLERR)) == 0) return {};
  std::array<char, 4096> buffer;  // NOLINT: what is read is written first
  const ssize_t got = read(descriptor_, buffer.data(), buffer.size());
  if (got == 0) fail_port(name_, "is gone");
  return {buffer.data(), check(got)};
}

}  // namespace hitpipe::host
