// The numbers of a PLY body, one after the other. Text and binary bodies have the same functions:
//   next(type, value) reads a number; false if the file has no more
//   skip(type, count) leaves numbers out; false as next()
//   end()             refuses what stands behind the last row
//   place()           of what was read last, in `unit`
//   least_bytes(type) that a number has
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/decimal.hpp"
#include "rays/files/ply_header.hpp"

namespace hitpipe::ref {

template <bool swapped>
class PlyBinaryBody {
 public:
  static constexpr std::string_view unit = "byte";

  PlyBinaryBody(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at), last_(at) {}

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
  [[nodiscard]] std::size_t place() const { return last_; }
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

/// White space is anywhere between numbers.
class PlyTextBody {
 public:
  static constexpr std::string_view unit = "line";

  PlyTextBody(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), at_(header.bytes), line_(header.lines + 1) {}

  bool next(const PlyScalar& type, double& value) {
    const std::string_view word = next_word();
    if (word.empty()) return false;
    const auto number = type.kind == PlyScalar::floating && type.bytes == 4 ? as_double(decimal<float>(word))
                                                                            : decimal<double>(word);
    if (!number) reject(fmt::format("line {}: \"{}\" is not a number", line_, host::shortened(word)));
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
  void end() {
    const std::string_view word = next_word();
    if (!word.empty())
      reject(
          fmt::format("line {}: \"{}\" stands behind the last element; the header must announce all numbers",
                      line_, host::shortened(word)));
  }
  [[nodiscard]] std::size_t place() const { return line_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] static std::size_t least_bytes(const PlyScalar&) { return 2; }  // a digit and a blank

 private:
  static std::optional<double> as_double(std::optional<float> number) {
    return number ? std::optional<double>(*number) : std::nullopt;
  }
  std::string_view next_word() {
    for (; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '\n' || (c == '\r' && bytes_.substr(at_ + 1, 1) != "\n"))
        ++line_;
      else if (c != ' ' && c != '\t' && c != '\v' && c != '\f' && c != '\r')
        break;
    }
    const std::size_t end = std::min(bytes_.find_first_of(" \t\v\f\r\n", at_), bytes_.size());
    const std::string_view word = bytes_.substr(at_, end - at_);
    at_ = end;
    return word;
  }

  std::string_view bytes_;
  std::size_t at_;
  std::size_t line_;
};

}  // namespace hitpipe::ref
