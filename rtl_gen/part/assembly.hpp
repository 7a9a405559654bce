// Parts that are joined: a core, and a core behind its bus. Every bit of an input is said to come from a bit of an
// output, of the module's own inputs, or to be constant. Verilog, picture and the software that runs cycle by cycle are
// made from this value, and verify() says what is not driven.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/part/part.hpp"

namespace hitpipe::rtl {

/// Bits of a pin: of a part, or of the module.
struct PinBits {
  static constexpr std::size_t outside = ~std::size_t{0};

  std::size_t part;  ///< its place, or `outside`
  std::size_t pin;   ///< its place in the interface
  int low = 0;
  int width = 1;
};

/// A bit that lets others through.
struct Gate {
  PinBits bits;
  bool inverted = false;            ///< it lets through while it is 0
  std::optional<PinBits> equals{};  ///< it lets through while both are the same
};

/// What drives a pin.
struct Source {
  struct Piece {
    std::optional<PinBits> bits;  ///< nothing: a constant
    std::uint64_t constant = 0;
    int width = 1;
  };

  std::vector<Piece> pieces;  ///< side by side, the lowest first
  std::vector<Gate> gates{};  ///< of one bit: it is 0 unless all let it through
  bool inverted = false;      ///< of one bit: and then turned over

  [[nodiscard]] int width() const;
  /// It is all of another pin, and nothing else.
  [[nodiscard]] bool is_plain() const {
    return pieces.size() == 1 && pieces[0].bits && gates.empty() && !inverted;
  }
};

struct Joint {
  std::size_t part, pin;  ///< an input of a part, or an output of the module
  Source from;
};

struct Assembly {
  ModuleInterface interface;
  std::vector<Part> parts;
  std::vector<Joint> joints;

  [[nodiscard]] const Pin& pin(std::size_t part, std::size_t pin) const {
    return part == PinBits::outside ? interface.pins[pin] : parts[part].interface.pins[pin];
  }
  /// What drives an input of a part or an output of the module; null if nothing does.
  [[nodiscard]] const Source* source_of(std::size_t part, std::size_t pin) const;
};

/// A line for each input of a part and each output of the module that nothing drives, or that is driven twice or with
/// another width. Clocks and resets count.
[[nodiscard]] std::vector<std::string> verify(const Assembly& assembly);

/// Bits of the module's inputs that nothing reads, "NAME[3]", "NAME[7:4]", "NAME", and outputs of parts, "PART_NAME".
[[nodiscard]] std::vector<std::string> unused_bits(const Assembly& assembly);

/// The module without those of its parts. A net has the name PART_PIN.
[[nodiscard]] std::string module_text(const Assembly& assembly);

}  // namespace hitpipe::rtl
