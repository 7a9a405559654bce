#include "rtl_gen/core/registers.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl {

namespace {

using hls::registers::Access;
using hls::registers::Fit;
using hls::registers::SoftReset;
using OfTable = hls::registers::Feature;

std::string_view name_of(OfTable feature) {
  return feature == OfTable::always ? "always" : feature == OfTable::cache ? "cache" : "rings";
}

std::string in_capitals(std::string_view name) {
  std::string text(name);
  for (char& letter : text) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return text;
}

Json field_json(const CoreRegisterField& field) {
  Json json{{"name", field.name},
            {"low", field.low},
            {"width", field.width},
            {"access", hls::registers::access_names[static_cast<std::size_t>(field.access)]},
            {"reset", field.reset}};
  if (!field.sentence.empty()) json["sentence"] = field.sentence;
  if (field.feature != OfTable::always) json["feature"] = name_of(field.feature);
  if (field.soft_reset != SoftReset::keeps) json["cleared_softly"] = true;
  return json;
}

// In the order of the enumerations.
constexpr std::string_view fit_names[]{"largest", "from_one", "cut"};
constexpr std::string_view soft_reset_names[]{"keeps", "clears", "holds"};

/// What software may write whenever it likes. A register without bits is one: it stays 0.
bool is_setting(const CoreRegister& each) {
  const auto takes = [](const CoreRegisterField& field) {
    return field.access == Access::read_write || field.access == Access::clear ||
           field.access == Access::any_write;
  };
  return !each.begins && (each.fields.empty() || std::ranges::any_of(each.fields, takes));
}

/// A word of the harness's table. Counters begin at 0 and keep nothing that is written.
std::string register_word(const CoreRegister& each, int address) {
  std::uint64_t kept = 0, value = 0;
  SoftReset soft = SoftReset::keeps;
  for (const CoreRegisterField& field : each.fields) {
    value |= field.reset << field.low;
    if (field.access != Access::read_write) continue;
    kept |= hls::low_mask(field.width) << field.low;
    soft = field.soft_reset;
  }
  return fmt::format("  {{0x{:02x}, 0x{:x}, 0x{:x}, Fit::{}, SoftReset::{}, {}, {}}},  // {}\n", address,
                     kept, value, fit_names[static_cast<std::size_t>(each.fit)],
                     soft_reset_names[static_cast<std::size_t>(soft)], is_setting(each), each.is_counter(),
                     each.name);
}

}  // namespace

hls::RegisterBits register_bits(const CoreOptions& options) {
  hls::RegisterBits bits{
      .address = options.address_bits, .bytes = options.byte_bits, .ray = options.ray_bits()};
  for (const Feature* const each : features_of(options))
    if (each->registers != nullptr) each->registers(bits);
  return bits;
}

std::vector<CoreRegister> core_registers(const CoreOptions& options) {
  const hls::RegisterBits bits = register_bits(options);
  const CoreIdentity identity = identity_of(options);
  std::vector<CoreRegister> made;
  for (const hls::registers::Register& each : hls::registers::table) {
    if (!has(bits, each.feature)) continue;
    made.push_back(
        {each.name, each.sentence, 4 * each.place, 32 * each.words, each.feature, {}, each.fit, each.begins});
    for (const hls::registers::RegisterField& field : each.fields) {
      const int width = field.width(bits);
      if (!has(bits, field.feature) || width == 0) continue;
      const std::uint64_t constant = identity[each.name] >> field.low & hls::low_mask(width);
      made.back().fields.push_back({field.name, field.sentence, field.low, width, field.access,
                                    field.reset | constant, field.feature, field.soft_reset});
    }
  }
  return made;
}

std::string address_macros(const std::vector<CoreRegister>& registers) {
  std::string addresses, counters;
  for (const OfTable feature : {OfTable::always, OfTable::cache, OfTable::rings})
    for (const CoreRegister& each : registers)
      if (each.feature == feature)
        (each.is_counter() ? counters : addresses) += fmt::format(
            "#define CORE_{}_{} 0x{:02x}\n", each.is_counter() ? "COUNT" : "REG", each.name, each.address);
  return addresses + counters;
}

std::string bit_macros(const std::vector<CoreRegister>& registers, std::string_view name) {
  std::string text;
  for (const CoreRegister& each : registers) {
    if (each.name != name) continue;
    for (const CoreRegisterField& field : each.fields) {
      const bool is_one = field.width == 1;
      const std::uint64_t first = std::uint64_t{1} << (is_one ? field.low : field.low - 1);
      text += is_one ? fmt::format("#define CORE_{} 0x{:x}u", in_capitals(field.name), first)
                     : fmt::format("#define CORE_{}(why) (0x{:x}u << (why))", in_capitals(field.name), first);
      text += fmt::format(" /* {} */\n", field.sentence);
    }
  }
  return text;
}

std::string register_words(const std::vector<CoreRegister>& registers) {
  std::string text;
  for (const CoreRegister& each : registers)
    for (int word = 0; word < each.bits / 32; ++word) text += register_word(each, each.address + 4 * word);
  return text;
}

Json registers_json(const std::vector<CoreRegister>& registers) {
  Json json = Json::array();
  for (const CoreRegister& each : registers) {
    Json fields = Json::array();
    for (const CoreRegisterField& field : each.fields) fields.push_back(field_json(field));
    json.push_back({{"name", each.name},
                    {"address", each.address},
                    {"bits", each.bits},
                    {"feature", name_of(each.feature)},
                    {"sentence", each.sentence},
                    {"fields", fields}});
  }
  return json;
}

}  // namespace hitpipe::rtl
