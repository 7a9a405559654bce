// Bytes pass a serial port as they are, both ways, and a port that cannot be used is refused with one line.
#include "host/serial_port.hpp"

#include <chrono>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/pseudo_terminal.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::host {
namespace {

using std::chrono::milliseconds;

std::string all_bytes() {
  std::string bytes;
  for (int byte = 0; byte < 256; ++byte) bytes += static_cast<char>(byte);
  return bytes;
}

/// What comes out of `to` until it is as long as what `from` has sent. The limit of minutes is only for
/// bytes that are lost.
std::string passed(SerialPort& from, SerialPort& to, const std::string& bytes) {
  std::string out = bytes;
  std::string come;
  std::string nothing;
  for (int tries = 0; tries < 60'000 && come.size() < bytes.size(); ++tries) {
    EXPECT_EQ(from.exchange(out, milliseconds{0}), "");
    come += to.exchange(nothing, milliseconds{10});
  }
  return come;
}

TEST(SerialPort, PassesEveryByteBothWays) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  SerialPort ours = SerialPort::pseudo_terminal();
  SerialPort theirs = SerialPort::open(ours.name(), 115200);
  EXPECT_EQ(passed(theirs, ours, all_bytes()), all_bytes());
  EXPECT_EQ(passed(ours, theirs, all_bytes()), all_bytes());
}

TEST(SerialPort, OutlivesWhoOpensIt) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  SerialPort ours = SerialPort::pseudo_terminal();
  { const SerialPort first = SerialPort::open(ours.name(), 115200); }
  std::string nothing;
  EXPECT_EQ(ours.exchange(nothing, milliseconds{0}), "");
  SerialPort second = SerialPort::open(ours.name(), 1'000'000);
  EXPECT_EQ(passed(ours, second, "again"), "again");
}

TEST(SerialPort, GoneIsReported) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  auto ours = std::make_unique<SerialPort>(SerialPort::pseudo_terminal());
  SerialPort theirs = SerialPort::open(ours->name(), 115200);
  const std::string its_name = ours->name();
  ours.reset();
  EXPECT_THAT(message_of<std::runtime_error>([&] {
                std::string nothing;
                (void)theirs.exchange(nothing, milliseconds{10});
              }),
              testing::StartsWith(its_name + ": is gone"));
}

TEST(SerialPort, RefusesWhatIsNone) {
  const sim::TemporaryFolder folder;
  const std::string file = folder.write("file", "").string();
  const auto refused = [](const std::string& device, int baud) {
    return message_of<std::runtime_error>([&] { (void)SerialPort::open(device, baud); });
  };
  EXPECT_EQ(refused("/dev/no_such_port", 115200),
            "/dev/no_such_port: cannot be opened as a serial port: No such file or directory");
  EXPECT_EQ(refused(file, 115200), file + ": is no serial port");
  EXPECT_EQ(
      refused(file, 12345),
      "12345 baud: serial ports have 9600, 19200, 38400, 57600, 115200, 230400, 460800, 500000, 921600, "
      "1000000, 1500000, 2000000, 3000000, 4000000");
}

}  // namespace
}  // namespace hitpipe::host
