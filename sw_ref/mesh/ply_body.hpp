// The numbers of a PLY body, one after the other. Text and binary bodies have the same functions:
//   begin_row()       goes to the next row; nothing is read yet
//   next(type, value) reads a number; false if the row or the file has no more
//   skip(type, count) leaves numbers out; false as next()
//   end_row()         refuses a row that has more numbers
//   end()             refuses what stands behind the last row
//   place()           "line 12" or "byte 345", of what was read last
//   is_cut()          after next() was false: nothing is left of the file
//   least_bytes(type) that a number has
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "host/text.hpp"
#include "sw_ref/mesh/decimal.hpp"
#include "sw_ref/mesh/ply_header.hpp"
#include "sw_ref/reject.hpp"

namespace hitpipe::ref {

template <bool swapped>
class PlyBinaryBody {
 public:
  PlyBinaryBody(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at), last_(at) {}

  void begin_row() {}
  void end_row() {}
  bool next(const PlyScalar& type, double& value) {
    last_ = at_;
    if (bytes_.size() - at_ < type.bytes) return false;
    const char* const from = bytes_.data() + at_;
    at_ += type.bytes;
    const bool is_signed = type.kind == PlyScalar::signed_int;
    switch (type.bytes) {
      case 1:
        value = is_signed ? load<std::int8_t>(from) : load<std::uint8_t>(from);
        break;
      case 2:
        value = is_signed ? load<std::int16_t>(from) : load<std::uint16_t>(from);
        break;
      case 8:
        value = std::bit_cast<double>(load<std::uint64_t>(from));
        break;
      default:
        if (type.kind == PlyScalar::floating)
          value = static_cast<double>(std::bit_cast<float>(load<std::uint32_t>(from)));
        else
          value = is_signed ? static_cast<double>(load<std::int32_t>(from)) : load<std::uint32_t>(from);
    }
    return true;
  }
  bool skip(const PlyScalar& type, std::uint64_t count) {
    if ((bytes_.size() - at_) / type.bytes < count) return false;
    at_ += count * type.bytes;
    return true;
  }
  void end() const {
    if (bytes_.find_first_not_of("\r\n", at_) != std::string_view::npos)
      reject(fmt::format("byte {}: {} bytes stand behind the last element; allowed are none, or line ends",
                         at_, bytes_.size() - at_));
  }
  [[nodiscard]] std::string place() const { return fmt::format("byte {}", last_); }
  [[nodiscard]] bool is_cut() const { return true; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] static std::size_t least_bytes(const PlyScalar& type) { return type.bytes; }

 private:
  template <class Integer>
  static Integer load(const char* from) {
    Integer value;
    if constexpr (swapped) {
      char turned[sizeof value];
      for (std::size_t i = 0; i < sizeof value; ++i) turned[i] = from[sizeof value - 1 - i];
      std::memcpy(&value, turned, sizeof value);
    } else {
      std::memcpy(&value, from, sizeof value);
    }
    return value;
  }

  std::string_view bytes_;
  std::size_t at_;
  std::size_t last_;
};

/// A row is a line. Empty lines are skipped.
class PlyTextBody {
 public:
  PlyTextBody(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), at_(header.bytes), line_(header.lines) {}

  void begin_row() {
    std::size_t length = 0;
    do {
      if (at_ >= bytes_.size()) {
        row_ = {};
        return;
      }
      // A file has one kind of line end, so the search for the other one must not run to the end each time.
      const std::string_view rest = bytes_.substr(at_);
      length = 0;
      while (length < rest.size() && rest[length] != '\n' && rest[length] != '\r') ++length;
      row_ = rest.substr(0, length);
      at_ += length + (rest.substr(length).starts_with("\r\n") ? 2 : 1);
      ++line_;
    } while (row_.find_first_not_of(blanks) == std::string_view::npos);
  }
  bool next(const PlyScalar& type, double& value) {
    const std::string_view word = next_word();
    if (word.empty()) return false;
    const auto number = type.kind == PlyScalar::floating && type.bytes == 4 ? as_double(decimal<float>(word))
                                                                            : decimal<double>(word);
    if (!number) reject(fmt::format("{}: \"{}\" is not a number", place(), host::shortened(word)));
    value = *number;
    return true;
  }
  bool skip(const PlyScalar& type, std::uint64_t count) {
    double value = 0;
    while (count-- > 0) {
      if (!next(type, value)) return false;
    }
    return true;
  }
  void end_row() {
    const std::string_view word = next_word();
    if (!word.empty())
      reject(fmt::format(
          "{}: \"{}\" stands behind the row's last number; a row has one number for each property", place(),
          host::shortened(word)));
  }
  void end() {
    begin_row();
    const std::string_view word = next_word();
    if (!word.empty())
      reject(fmt::format("{}: \"{}\" stands behind the last element; the header must announce all rows",
                         place(), host::shortened(word)));
  }
  [[nodiscard]] std::string place() const { return fmt::format("line {}", line_); }
  [[nodiscard]] bool is_cut() const {
    return bytes_.find_first_not_of(" \t\r\n", at_) == std::string_view::npos;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - std::min(at_, bytes_.size()); }
  [[nodiscard]] static std::size_t least_bytes(const PlyScalar&) { return 2; }  // a digit and a blank

 private:
  static constexpr std::string_view blanks = " \t\v\f";

  static std::optional<double> as_double(std::optional<float> number) {
    return number ? std::optional<double>(*number) : std::nullopt;
  }
  std::string_view next_word() {
    row_.remove_prefix(std::min(row_.find_first_not_of(blanks), row_.size()));
    const std::string_view word = row_.substr(0, row_.find_first_of(blanks));
    row_.remove_prefix(word.size());
    return word;
  }

  std::string_view bytes_;
  std::size_t at_;
  std::size_t line_;
  std::string_view row_;
};

}  // namespace hitpipe::ref
