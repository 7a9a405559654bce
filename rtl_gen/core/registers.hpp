// The registers that one core has (hls/machines/register_table.hpp), with their widths.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hls/machines/register_table.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/emit/manifest.hpp"

namespace hitpipe::rtl {

struct CoreRegisterField {
  std::string_view name;
  std::string_view sentence;  ///< empty if that of the register says it
  int low, width;             ///< bits; a width of 1 or more
  hls::registers::Access access;
  std::uint64_t reset;
  hls::registers::Feature feature;  ///< beside that of the register
  hls::registers::SoftReset soft_reset;

  [[nodiscard]] int high() const { return low + width - 1; }
};

struct CoreRegister {
  std::string_view name, sentence;
  int address;  ///< in bytes
  int bits;     ///< 32, or of a counter 64, the low word first
  hls::registers::Feature feature;
  std::vector<CoreRegisterField> fields;  ///< from the lowest bit on; none if all its bits are 0
  hls::registers::Fit fit;
  bool begins;  ///< what is written sets the core to work

  [[nodiscard]] bool is_counter() const { return bits == 64; }
};

/// The format of a core's machine `registers`.
[[nodiscard]] hls::RegisterBits register_bits(const CoreOptions& options);

/// By their addresses.
[[nodiscard]] std::vector<CoreRegister> core_registers(const CoreOptions& options);

/// #define CORE_REG_NAME and CORE_COUNT_NAME: addresses. First those of every core, and counters last.
[[nodiscard]] std::string address_macros(const std::vector<CoreRegister>& registers);
/// #define CORE_FIELD: the bit of each field of that register. CORE_FIELD(why) if it has more, from 1 on.
[[nodiscard]] std::string bit_macros(const std::vector<CoreRegister>& registers, std::string_view name);

/// RegisterWord of rtl_gen/core/harness/register_word.hpp: one a line, by their addresses.
[[nodiscard]] std::string register_words(const std::vector<CoreRegister>& registers);

/// Of each register: name, address, bits, feature (always, cache, rings), sentence, fields. Of each field:
/// name, low, width, access (constant, ro, rw, w1c, w1, wo), reset; a sentence if that of the register does
/// not say it, a feature unless it is always there, and cleared_softly if a soft reset makes it 0.
[[nodiscard]] Json registers_json(const std::vector<CoreRegister>& registers);

}  // namespace hitpipe::rtl
