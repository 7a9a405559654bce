// What an image of the traversal core must be so that the core's answers are right, read from its bytes as docs/core.md
// has them. Nothing here is the program's: this judges what `core image --check` accepts.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace hitpipe::ref::image_invariant {

/// FNV-1a of all bytes but the checksum's.
inline std::uint64_t checksum(const std::string& bytes) {
  std::uint64_t hash = 0xcbf2'9ce4'8422'2325;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (i < 104 || i >= 112) hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100'0000'01b3;
  return hash;
}

/// Little-endian, of `width` bits from bit `at`.
inline std::uint64_t bits_of(const std::string& bytes, std::size_t at, unsigned width) {
  std::uint64_t x = 0;
  for (unsigned i = 0; i < width; ++i)
    x |= std::uint64_t{static_cast<unsigned char>(bytes[(at + i) / 8]) >> (at + i) % 8 & 1U} << i;
  return x;
}

class Invariant {
 public:
  explicit Invariant(const std::string& bytes) : bytes_(bytes) {}

  /// Why it does not hold; nothing: it holds.
  std::optional<std::string> broken() {
    if (bytes_.size() % 64 != 0 || bytes_.size() < 128) return "no lines of 64 bytes with a header";
    if (bytes_.compare(32, 8, "hitpipe\2") != 0) return "no header";
    if (checksum(bytes_) != bits_of(bytes_, 8 * 104, 64)) return "another checksum";
    if (header(44, 4) != bytes_.size() / 32) return "another number of blocks";
    for (const std::size_t from : {43U, 56U, 88U, 112U})
      if (header(from, from == 43 ? 1 : from == 112 ? 16 : 8) != 0) return "a byte of the header that is 0";
    n_ = static_cast<unsigned>(header(40, 1));
    if (n_ < 4 || n_ > 24) return "no grid";
    most_ = (std::int64_t{1} << (n_ - 2)) - 1;
    reached_ = {1, 2, 3};
    if (!record(0, {{-most_, -most_, -most_, most_, most_, most_}}, 1)) return why_;
    if (child_count(0, 1) != 0) return "a second root";
    if (header(41, 1) != levels_ || header(42, 1) != leaf_ || header(48, 4) != numbers_.size())
      return "a header that counts otherwise";
    if (!numbers_.empty() && *numbers_.rbegin() >= header(48, 4) + header(52, 4))
      return "a number of no triangle";
    return std::nullopt;
  }

 private:
  using Box = std::array<std::int64_t, 6>;  ///< lower x, y, z, upper x, y, z

  std::uint64_t header(std::size_t byte, unsigned count) const {
    return count > 8 ? header(byte, 8) | header(byte + 8, 8) : bits_of(bytes_, 8 * byte, 8 * count);
  }
  std::uint64_t bits(std::uint64_t block, unsigned at, unsigned width) const {
    return bits_of(bytes_, 256 * block + at, width);
  }
  std::int64_t coordinate(std::uint64_t block, unsigned place) const {
    const auto x = static_cast<std::int64_t>(bits(block, 24 * place, 24));
    return x >= 1 << 23 ? x - (1 << 24) : x;
  }
  std::uint64_t child_count(std::uint64_t block, unsigned which) const {
    return bits(block, 192 + 8 * which, 8);
  }
  bool fails(const char* why) {
    why_ = why;
    return false;
  }
  bool reach(std::uint64_t block, unsigned kind) {
    if (block >= bytes_.size() / 32) return fails("a block outside");
    if (!reached_.insert(block).second) return fails("a block twice");
    return bits(block, 248, 8) == kind + n_ || fails("a block of another kind");
  }

  /// `held` is what all boxes above have in common; so is what the core sees of a record below it.
  bool record(std::uint64_t block, const Box& held, unsigned level) {
    if (level > 60) return fails("more than 60 records on a path");
    levels_ = std::max<std::uint64_t>(levels_, level);
    if (!reach(block, 0x40)) return false;
    if (bits(block, 150, 10) != 0 || bits(block, 208, 40) != 0) return fails("bits of a record that are 0");
    for (unsigned k = 0; k < 6; ++k)
      if (std::abs(coordinate(block, k)) > most_) return fails("a plane outside the cube");
    std::uint64_t at = bits(block, 160, 32);
    for (unsigned which = 0; which < 2; ++which) {
      Box box = held;
      for (unsigned k = 0; k < 6; ++k)
        if (bits(block, 144 + k, 1) == which) {
          const std::int64_t plane = coordinate(block, k);
          box[k] = k < 3 ? std::max(box[k], plane) : std::min(box[k], plane);
        }
      const std::uint64_t count = child_count(block, which);
      if (count == 255) {
        if (!record(at++, box, level + 1)) return false;
        continue;
      }
      leaf_ = std::max(leaf_, count);
      for (std::uint64_t i = 0; i < count; ++i)
        if (!triangle(at++, box)) return false;
    }
    return true;
  }

  bool triangle(std::uint64_t block, const Box& held) {
    if (!reach(block, 0x60)) return false;
    for (unsigned corner = 0; corner < 3; ++corner)
      for (unsigned k = 0; k < 3; ++k) {
        const std::int64_t x = coordinate(block, 3 * corner + k);
        if (x < held[k] || x > held[k + 3]) return fails("a triangle outside a box above it");
      }
    const std::uint64_t number = bits(block, 216, 32);
    if (number == 0xffff'ffff) return fails("the number of none");
    return numbers_.insert(number).second || fails("a number twice");
  }

  const std::string& bytes_;
  unsigned n_ = 0;
  std::int64_t most_ = 0;
  std::set<std::uint64_t> reached_, numbers_;
  std::uint64_t levels_ = 0, leaf_ = 0;
  std::string why_;
};

/// Why the image of these bytes may give a wrong answer; nothing: none is.
inline std::optional<std::string> broken(const std::string& bytes) {
  return Invariant(bytes).broken();
}

}  // namespace hitpipe::ref::image_invariant
