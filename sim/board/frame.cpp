#include "sim/board/frame.hpp"

#include <boost/crc.hpp>

#include "hls/num/bits.hpp"
#include "rtl_gen/board/top.hpp"

namespace hitpipe::sim {

std::string pack(const std::vector<rtl::Port>& ports, std::span<const std::int64_t> values) {
  std::string bytes(static_cast<std::size_t>(rtl::packed_bytes(ports)), '\0');
  std::size_t place = 0;
  for (std::size_t port = 0; port < ports.size(); ++port) {
    for (int bit = 0; bit < ports[port].width; ++bit, ++place) {
      if (((static_cast<std::uint64_t>(values[port]) >> bit) & 1U) == 0) continue;
      bytes[place / 8] =
          static_cast<char>(static_cast<unsigned char>(bytes[place / 8]) | (1U << (place % 8)));
    }
  }
  return bytes;
}

std::vector<std::int64_t> unpack(const std::vector<rtl::Port>& ports, std::string_view bytes) {
  std::vector<std::int64_t> values;
  std::size_t place = 0;
  for (const rtl::Port& port : ports) {
    std::uint64_t value = 0;
    for (int bit = 0; bit < port.width; ++bit, ++place) {
      const unsigned byte = static_cast<unsigned char>(bytes[place / 8]);
      value |= static_cast<std::uint64_t>((byte >> (place % 8)) & 1U) << bit;
    }
    values.push_back(port.is_signed ? hls::sign_extended(value, port.width)
                                    : static_cast<std::int64_t>(value));
  }
  return values;
}

namespace {

constexpr char frame_flag = 0x7e;
constexpr char frame_escape = 0x7d;
constexpr char escape_change = 0x20;
constexpr std::size_t check_bytes = 2;

/// CRC-16/X-25 of RFC 1662.
using CheckSequence = boost::crc_optimal<16, 0x1021, 0xffff, 0xffff, true, true>;

std::uint16_t check_sequence(std::string_view bytes) {
  CheckSequence check;
  check.process_bytes(bytes.data(), bytes.size());
  return check.checksum();
}

/// The check sequence of any bytes that end in their own.
constexpr std::uint16_t sound_check = 0x0f47;

}  // namespace

std::string to_frame(std::string_view payload) {
  const unsigned check = check_sequence(payload);
  std::string bytes(payload);
  bytes += static_cast<char>(check & 0xffU);
  bytes += static_cast<char>((check >> 8) & 0xffU);
  std::string frame(1, frame_flag);
  for (const char byte : bytes) {
    if (byte == frame_flag || byte == frame_escape) {
      frame += frame_escape;
      frame += static_cast<char>(byte ^ escape_change);
    } else {
      frame += byte;
    }
  }
  return frame + frame_flag;
}

std::optional<std::string> FrameReader::take(char byte) {
  if (byte == frame_escape) {
    escaped_ = true;
    return std::nullopt;
  }
  if (byte != frame_flag) {
    bytes_ += escaped_ ? static_cast<char>(byte ^ escape_change) : byte;
    escaped_ = false;
    return std::nullopt;
  }
  std::string frame;
  frame.swap(bytes_);
  const bool cut = escaped_;
  escaped_ = false;
  if (frame.empty() && !cut) return std::nullopt;  // the flag between two frames
  if (cut || frame.size() < check_bytes || check_sequence(frame) != sound_check) {
    ++damaged_;
    return std::nullopt;
  }
  frame.resize(frame.size() - check_bytes);
  return frame;
}

}  // namespace hitpipe::sim
