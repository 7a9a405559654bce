// What the top modules of boards have in common, as Verilog: frames that come and go, reset and lamps
// (docs/chips.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"

namespace hitpipe::rtl {

/// Bits for the numbers 0..most.
[[nodiscard]] int bits_for(int most);
/// "5'd12"
[[nodiscard]] std::string decimal(int bits, int number);
/// The bits of each port in a word. The first port has the low bits, from `low` on.
[[nodiscard]] std::vector<std::string> fields_of_word(const std::vector<Port>& ports, std::string_view word,
                                                      int low = 0);

/// Bits of a place in an answer: flag, kind and tag, the longest body, check sequence and flag.
[[nodiscard]] int place_bits_of(int most_body_bytes);

/// From "module" on: the ports (top_ports), the reset, the check sequence, and the letters of the identity.
[[nodiscard]] std::string top_opening(const std::string& module, int clocks_per_bit,
                                      const std::string& identity, int place_bits);

/// A kind of frame that a top takes.
struct FrameKind {
  std::string name;  ///< of the wire that says that a sound one has come
  char letter;
  int body_bytes;
};

struct ReceiverText {
  std::string serial;  ///< the prefix of serial_line()
  std::vector<FrameKind> kinds;
  int body_bytes;          ///< of the longest body, which the register `operands` has room for
  std::string body_end{};  ///< bytes before the check sequence, when kinds with a body differ in it
  std::string taking;      ///< whether what has come is taken; `asked` and what is behind it
  std::string held{};      ///< while this wire is 1 no frame begins, so `operands` and `tag` stay
};
/// Bytes of a frame, one too many included, as receiver_text() counts them.
[[nodiscard]] int count_bits_of(const ReceiverText& receiver);
/// Puts bodies into `operands`, the last byte above, and tags into `tag`.
[[nodiscard]] std::string receiver_text(const ReceiverText& receiver);

struct SenderText {
  std::string serial;
  int place_bits;
  int answer_bytes;
  std::string registers{};  ///< beside about_who: what the answer is about
  std::string body_end;     ///< the place behind the body
  std::string kind;         ///< the letter
  std::string beginning;    ///< branches of the edge that begin an answer
};
[[nodiscard]] std::string sender_text(const SenderText& sender);

/// `not_taken`: the frame that ends is of no use.
[[nodiscard]] std::string lamps_text(const std::string& not_taken);

}  // namespace hitpipe::rtl
