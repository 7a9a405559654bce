// The same bodies in the native and the vendor's domain on the same operands; every output must be equal.
// Built only if HITPIPE_VENDOR_AP_INT names a folder with the vendor's ap_int.h. To add a datapath, write a
// struct whose run<D>(a, b, outputs) passes each of its values to outputs(name, value), and a TEST that
// compares it.
#include <cstdint>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "hls/num/vendor.hpp"

namespace hitpipe::hls {
namespace {

constexpr unsigned seed = 71;
constexpr int vector_count = 20000;

/// An output: its name, width and bits, as far as the public interfaces of both domains show them.
struct Output {
  std::string name;
  int width;
  bool negative;
  std::uint64_t low;
  std::uint64_t high;
  friend bool operator==(const Output&, const Output&) = default;
};

void PrintTo(const Output& output, std::ostream* out) {
  std::ostringstream text;
  text << output.name << ": " << output.width << " bits, " << (output.negative ? "negative" : "not negative")
       << std::hex << ", 0x" << output.high << " above 0x" << output.low;
  *out << text.str();
}

class Outputs {
 public:
  template <class T>
  void operator()(const char* name, const T& x) {
    const T above = x >> 64u;
    list_.push_back({name, T::width, x.sign(), x.to_uint64(), above.to_uint64()});
  }
  void operator()(const char* name, bool x) { list_.push_back({name, 1, false, x ? 1u : 0u, 0}); }
  const std::vector<Output>& list() const { return list_; }

 private:
  std::vector<Output> list_;
};

/// An operand of 96 random bits, of every magnitude.
struct Operand {
  std::uint64_t high;
  std::uint64_t low;

  template <class Word>
  Word as_word() const {
    Word word = high;
    word <<= 64u;
    word |= low;
    return word;
  }
};

Operand random_operand(std::mt19937_64& random) {
  const auto dropped = random() % 64;
  const std::uint64_t low = random() >> dropped;
  const std::uint64_t high = random() >> dropped;
  const std::uint64_t flip = random() % 2 == 0 ? 0 : ~std::uint64_t{0};
  return {high ^ flip, low ^ flip};
}

template <class Body>
void expect_equal_outputs() {
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  int compared = 0;
  for (int i = 0; i < vector_count && !testing::Test::HasFailure(); ++i) {
    const Operand a = random_operand(random);
    const Operand b = random_operand(random);
    Outputs native;
    Outputs vendor;
    Body::template run<Native>(a, b, native);
    Body::template run<Vendor>(a, b, vendor);
    ASSERT_FALSE(native.list().empty());
    EXPECT_EQ(native.list(), vendor.list())
        << std::hex << "a 0x" << a.high << ' ' << a.low << " b 0x" << b.high << ' ' << b.low;
    ++compared;
  }
  EXPECT_EQ(compared, vector_count);
}

template <int Wa, bool Sa, int Wb, bool Sb>
struct Operators {
  template <class D, int W, bool S>
  using word = std::conditional_t<S, typename D::template sint<W>, typename D::template uint<W>>;

  template <class D>
  static void run(const Operand& x, const Operand& y, Outputs& out) {
    using A = word<D, Wa, Sa>;
    using B = word<D, Wb, Sb>;
    const A a = x.as_word<A>();
    const B b = y.as_word<B>();
    out("a", a);
    out("b", b);
    out("a + b", a + b);
    out("a - b", a - b);
    out("a * b", a * b);
    out("a & b", a & b);
    out("a | b", a | b);
    out("a ^ b", a ^ b);
    out("-a", -a);
    out("~a", ~a);
    out("+a", +a);
    out("!a", !a);
    if (!b.is_zero()) {
      out("a / b", a / b);
      out("a % b", a % b);
    }
    out("a << 3", a << 3);
    out("a >> 3", a >> 3);
    const typename D::template uint<6> count = y.low;
    out("a << count", a << count);
    out("a >> count", a >> count);
    out("a == b", a == b);
    out("a != b", a != b);
    out("a < b", a < b);
    out("a <= b", a <= b);
    out("a > b", a > b);
    out("a >= b", a >= b);
    out("a + 1", a + 1);
    out("1u - a", 1u - a);
    out("a < 5", a < 5);
    A sum = a;
    sum += b;
    out("+=", sum);
    sum -= 7;
    out("-=", sum);
    sum *= b;
    out("*=", sum);
    sum ^= b;
    out("^=", sum);
    sum >>= count;
    out(">>=", sum);
    sum.range(Wa - 1, Wa / 2) = b;
    out("range =", sum);
    sum[0] = a[Wa - 1];
    out("[0] =", sum);
    const typename D::template uint<Wa + Wb> pair = (a, b);
    out("(a, b)", pair);
    const typename D::template uint<Wa> part = a.range(Wa - 1, Wa / 2);
    out("range", part);
    out("and_reduce", a.and_reduce());
    out("xor_reduce", a.xor_reduce());
  }
};

TEST(VendorDomain, OperatorsAgreeOnUnsignedWords) {
  expect_equal_outputs<Operators<24, false, 20, false>>();
}
TEST(VendorDomain, OperatorsAgreeOnSignedWords) {
  expect_equal_outputs<Operators<24, true, 31, true>>();
}
TEST(VendorDomain, OperatorsAgreeOnMixedSigns) {
  expect_equal_outputs<Operators<13, true, 24, false>>();
  expect_equal_outputs<Operators<48, false, 9, true>>();
}
TEST(VendorDomain, OperatorsAgreeBeyondOneWord) {
  expect_equal_outputs<Operators<70, true, 50, false>>();
}

/// The free functions, called as a pipeline calls them: unqualified, and nested without naming the types
/// between.
struct FreeFunctions {
  template <class D>
  static void run(const Operand& x, const Operand& y, Outputs& out) {
    using Coordinate = typename D::template sint<24>;
    using Bit = typename D::bit;
    const Coordinate a = x.as_word<Coordinate>();
    const Coordinate b = y.as_word<Coordinate>();
    const auto difference = as("difference", 'x', a - b);
    const Bit negative{difference < 0};
    const Bit equal = Bit{a == b};
    out("slice", slice(a, 23_w, 7_w));
    out("slice of a sum", slice(a + b, 24_w, 24_w));
    out("slice of a bit", slice(negative, 0_w, 0_w));
    out("sum of slices", slice(a, 7_w, 4_w) + slice(a, 3_w, 0_w));
    out("cat", cat(a, slice(b, 3_w, 1_w)));
    out("cat of bits", cat(negative, cat(~equal, slice(b, 0_w, 0_w))));
    out("select", select(negative, a, b));
    out("select of products", as("picked", select(~negative & ~equal, a * b, b * a)));
    out("resize up", resize(difference, 40_w));
    out("resize down", resize(difference, 11_w));
    out("resize unsigned", resize(slice(a, 23_w, 12_w), 20_w));
    out("lit", D::lit(0xabc, 12_w) + slice(a, 11_w, 0_w));
    out("sign", sign(difference));
    out("bit_at", bit_at(a, 11_w));
    out("any", any<D>(slice(a, 9_w, 4_w)));
    out("spread", spread(negative, 7_w));
    out("as_unsigned", as_unsigned(difference) + as_unsigned(b));
    out("as_signed", as_signed(slice(a, 23_w, 12_w)) - b);
    out("bits", (negative & equal) | (negative ^ ~equal));
    const typename D::template sint<25> stored = a + b;
    out("stored", stored);
  }
};

TEST(VendorDomain, FreeFunctionsAgree) {
  expect_equal_outputs<FreeFunctions>();
}

template <class Bit, class T>
concept selectable = requires(Bit bit, T x) {
  select(bit, x, x);
};
static_assert(selectable<Vendor::bit, Vendor::sint<8>>);
static_assert(!selectable<bool, Vendor::sint<8>> && !selectable<Vendor::uint<2>, Vendor::sint<8>>);
static_assert(!selectable<Vendor::bit, Native::sint<8>> && !selectable<Native::bit, Vendor::sint<8>>);

}  // namespace
}  // namespace hitpipe::hls
