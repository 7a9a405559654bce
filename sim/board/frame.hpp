// Operands and results as bytes: all bits in port order, the first port in the low bits, the lowest byte
// first.
// The frames in which a board and a computer talk: HDLC-like framing of RFC 1662, with its check sequence of
// 16 bits. A lost or changed byte spoils one frame, and the next flag begins a new one. docs/chips.md has the
// bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"

namespace hitpipe::sim {

/// As many bytes as rtl::packed_bytes() says. The bits above the last port are 0.
[[nodiscard]] std::string pack(const std::vector<rtl::Port>& ports, std::span<const std::int64_t> values);
/// Signed ports are sign-extended. `bytes` are as many as pack() gives.
[[nodiscard]] std::vector<std::int64_t> unpack(const std::vector<rtl::Port>& ports, std::string_view bytes);

/// Two flags, and between them the payload and its check sequence, escaped.
[[nodiscard]] std::string to_frame(std::string_view payload);

/// Takes bytes one by one.
class FrameReader {
 public:
  /// The payload when this byte ends a sound frame.
  [[nodiscard]] std::optional<std::string> take(char byte);
  /// Frames that were not sound.
  [[nodiscard]] std::uint64_t damaged() const { return damaged_; }

 private:
  std::string bytes_;  ///< since the last flag, with the check sequence
  bool escaped_ = false;
  std::uint64_t damaged_ = 0;
};

}  // namespace hitpipe::sim
