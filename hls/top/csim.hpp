// The test program of a top function: it replays a file of vectors and compares every result. The vectors
// come from hitpipe's own integers, so a vendor's arithmetic is tested too. Not for synthesis. C++14, as the
// tops.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "hls/top/top_domain.hpp"

namespace hitpipe {
namespace hls {
namespace top {

/// A port of a top function: an operand is passed by value, a result by reference.
template <class Port>
struct PortOf {
  using Word = typename std::remove_reference<Port>::type;
  static constexpr bool is_result = std::is_reference<Port>::value;
  /// Bits, 1 to 64.
  static constexpr int width = decltype(width_of(std::declval<const Word&>()))();

  static constexpr std::uint64_t mask() { return ~std::uint64_t{0} >> (64 - width); }
};

/// A line of a vector file: the operands and then the expected results as one number in hexadecimal, the
/// first port in the high bits. Zeros fill the first digit.
class Vector {
 public:
  explicit Vector(const std::string& digits) : digits_(digits) {}

  static std::size_t digits_for(int bits) { return static_cast<std::size_t>(bits + 3) / 4; }
  /// Goes past the bits that fill the first digit of a vector of so many bits.
  void begin(int bits) { at_ = 4 * digits_.size() - static_cast<std::size_t>(bits); }
  /// The next bits, at most 64.
  std::uint64_t take(int width) {
    std::uint64_t word = 0;
    for (int i = 0; i < width; ++i, ++at_) word = word << 1 | bit(at_);
    return word;
  }

 private:
  std::uint64_t bit(std::size_t place) const {
    const char digit = digits_[place / 4];
    const int value = digit <= '9' ? digit - '0' : (digit | 0x20) - 'a' + 10;
    return static_cast<std::uint64_t>(value) >> (3 - place % 4) & 1;
  }

  const std::string& digits_;
  std::size_t at_ = 0;
};

/// Calls a top function on vectors.
template <class... Ports>
class Replay {
 public:
  using Top = void (*)(Ports...);

  explicit Replay(Top top) : top_(top) {}

  /// Bits of a vector.
  static int bits() {
    int sum = 0;
    for (const int width : {PortOf<Ports>::width...}) sum += width;
    return sum;
  }
  /// True if every result is as expected. Prints the first wrong result.
  bool operator()(Vector vector, unsigned long number) {
    vector.begin(bits());
    return run(vector, number, std::index_sequence_for<Ports...>());
  }

 private:
  template <std::size_t... I>
  bool run(Vector& vector, unsigned long number, std::index_sequence<I...> /*places*/) {
    std::tuple<typename PortOf<Ports>::Word...> words;
    const std::uint64_t given[] = {start<Ports>(std::get<I>(words), vector)...};
    top_(std::get<I>(words)...);
    bool right = true;
    for (const bool same : {is_right<Ports>(std::get<I>(words), given[I], number)...}) right = right && same;
    return right;
  }

  /// An operand gets its number. A result starts as the complement of the expected bits, so a result that is
  /// not written shows.
  template <class Port>
  static std::uint64_t start(typename PortOf<Port>::Word& word, Vector& vector) {
    const std::uint64_t given = vector.take(PortOf<Port>::width);
    word = PortOf<Port>::is_result ? ~given : given;
    return given;
  }
  template <class Port>
  bool is_right(const typename PortOf<Port>::Word& word, std::uint64_t expected, unsigned long number) {
    if (!PortOf<Port>::is_result) return true;
    const std::uint64_t result = static_cast<std::uint64_t>(word.to_uint64()) & PortOf<Port>::mask();
    if (result == expected) return true;
    if (!printed_) {
      std::printf("vector %lu: a result is %llx, expected %llx\n", number,
                  static_cast<unsigned long long>(result), static_cast<unsigned long long>(expected));
    }
    printed_ = true;
    return false;
  }

  Top top_;
  bool printed_ = false;
};

/// The main() of a C simulation: replays the file that the first argument names, or `file`. 0 when every
/// result is right, 1 when one is wrong, 2 when the file cannot be used.
template <class... Ports>
int csim(int argc, char** argv, const char* file, void (*top)(Ports...)) {
  if (argc > 1) file = argv[1];
  std::ifstream in(file);
  Replay<Ports...> replay(top);
  const std::size_t digits = Vector::digits_for(replay.bits());
  unsigned long vectors = 0, mismatches = 0, place = 0;
  for (std::string line; std::getline(in, line);) {
    ++place;
    if (line.empty() || line.compare(0, 2, "//") == 0) continue;
    if (line.size() != digits || line.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
      std::printf("%s, line %lu: not a vector of %d bits in %lu hexadecimal digits\n", file, place,
                  replay.bits(), static_cast<unsigned long>(digits));
      return 2;
    }
    mismatches += replay(Vector(line), vectors++) ? 0 : 1;
  }
  if (vectors == 0) {
    std::printf("%s: there are no vectors, or no such file\n", file);
    return 2;
  }
  std::printf("%s: %lu vectors, %lu mismatches\n", file, vectors, mismatches);
  return mismatches == 0 ? 0 : 1;
}

}  // namespace top
}  // namespace hls
}  // namespace hitpipe
