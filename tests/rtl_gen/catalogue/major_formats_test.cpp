// Formats n+g/p and n+g/pfF: their spelling, what is refused, and every format of the range.
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hls/box/major_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::major_formats_test {
namespace {

using hls::MajorBits;

const Design& design() {
  return find_design("int_major");
}

TEST(MajorFormats, AreWrittenAsPlanesFinerOriginAndMantissa) {
  EXPECT_EQ(to_string(MajorBits{20, 1, 13}), "20+1/13");
  EXPECT_EQ(to_string(MajorBits{16, 0, 8}), "16+0/8");
  EXPECT_EQ(to_string(MajorBits{12, 2, 10, 1}), "12+2/10f1");
  EXPECT_EQ(to_string(MajorBits{8, 3, 6, -1}), "8+3/6f-1");
  EXPECT_EQ(to_string(design().default_format), "20+1/13");
}

TEST(MajorFormats, AreReadAsTheyAreWritten) {
  EXPECT_EQ(design().parse_format("20+1/13"), Format(MajorBits{20, 1, 13, 0}));
  EXPECT_EQ(design().parse_format("6+0/4"), Format(MajorBits{6, 0, 4, 0}));
  EXPECT_EQ(design().parse_format("12+2/10f1"), Format(MajorBits{12, 2, 10, 1}));
  EXPECT_EQ(design().parse_format("8+3/6f-1"), Format(MajorBits{8, 3, 6, -1}));
  // A fraction of 0 may be given. It is not written.
  EXPECT_EQ(design().parse_format("20+1/13f0"), design().default_format);
}

TEST(MajorFormats, HaveATypeForHighLevelSynthesis) {
  EXPECT_EQ(Format(MajorBits{20, 1, 13}).type(), "MajorFormat<20, 1, 13, 0>");
  EXPECT_EQ(Format(MajorBits{8, 3, 6, -1}).type(), "MajorFormat<8, 3, 6, -1>");
}

TEST(MajorFormats, OtherTextRejected) {
  for (const std::string text : {"",
                                 "+",
                                 "/",
                                 "20",
                                 "20+1",
                                 "20+1/",
                                 "20+/12",
                                 "+1/12",
                                 "20/12",
                                 "20/12+1",
                                 "20-1/12",
                                 "20+1/13 ",
                                 " 20+1/13",
                                 "20 +1/12",
                                 "20+1/13f",
                                 "20+1/13F1",
                                 "20+1/13f+1",
                                 "20+1/13f1 ",
                                 "20+1/13f1.",
                                 "20+1/13/0",
                                 "+20+1/13",
                                 "20++1/12",
                                 "20+1/+12",
                                 "20+1/x",
                                 "twenty+1/12",
                                 "20+1/13-1",
                                 "fp32",
                                 "0x14+1/12",
                                 "5+1/12",
                                 "33+1/12",
                                 "-20+1/13",
                                 "20+-1/12",
                                 "20+4/12",
                                 "20+1/3",
                                 "20+1/33",
                                 "20+1/-12",
                                 "20+1/13f-3",
                                 "20+1/13f4",
                                 "32+0/32",
                                 "31+1/32",
                                 "29+3/32",
                                 "32+3/29",
                                 "4294967316+1/12",
                                 "20+4294967297/12",
                                 "20+1/4294967308",
                                 "20+1/13f4294967296"}) {
    EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(design().parse_format(text)); }),
              "bits " + text +
                  ": no format of int_major; allowed is n+g/p or n+g/pfF with n in 6..32, g in 0..3, p in "
                  "4..32, F in -2..3 and n+g+p at most 63, for example 20+1/13");
  }
}

TEST(MajorFormats, OfOtherDesignsRejected) {
  EXPECT_EQ(
      message_of<std::runtime_error>([] {
        static_cast<void>(design().trace(hls::IntBits{20, 24}));
      }),
      "bits 20/24: no format of int_major; allowed is n+g/p or n+g/pfF with n in 6..32, g in 0..3, p in "
      "4..32, F in -2..3 and n+g+p at most 63, for example 20+1/13");
  EXPECT_EQ(message_of<std::runtime_error>([] {
              static_cast<void>(find_design("int_slabs").evaluate(MajorBits{20, 1, 13}));
            }),
            "bits 20+1/13: no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for "
            "example 20/24");
}

/// The limits, written without those of MajorBits.
bool allowed(int n, int g, int p, int fraction) {
  return n >= 6 && n <= 32 && g >= 0 && g <= 3 && p >= 4 && p <= 32 && fraction >= -2 && fraction <= 3 &&
         n + g + p <= 63;
}

TEST(MajorFormats, OfTheWholeRangeAreReadBackAndNoOthersExist) {
  int formats = 0;
  for (int n = 3; n <= 35; ++n) {
    for (int g = -1; g <= 5; ++g) {
      for (int p = 2; p <= 35; ++p) {
        for (int fraction = -4; fraction <= 5; ++fraction) {
          const Format format = MajorBits{n, g, p, fraction};
          ASSERT_EQ(format.valid(), allowed(n, g, p, fraction)) << to_string(format);
          const auto numbers = format.family().parse(to_string(format));
          ASSERT_TRUE(numbers) << to_string(format);
          ASSERT_EQ(*numbers, format.numbers()) << to_string(format);
          formats += format.valid() ? 1 : 0;
        }
      }
    }
  }
  EXPECT_EQ(formats, 18'672);
}

/// Distances and lengths have no bit too few: their widths follow from the largest number.
TEST(MajorFormats, PortsHaveTheWidthsOfTheFormat) {
  for (const MajorBits bits : {MajorBits{20, 1, 13}, MajorBits{6, 0, 4}, MajorBits{8, 3, 6, -1},
                               MajorBits{12, 2, 10, 3}, MajorBits{32, 0, 31}, MajorBits{32, 3, 28, -2}}) {
    const std::vector<Port> ports = design().ports(bits);
    ASSERT_EQ(ports.size(), 21U);
    for (const Port& port : ports) {
      SCOPED_TRACE(to_string(Format(bits)) + " " + port.name);
      const std::string start = port.name.substr(0, port.name.find('_'));
      const bool flag = start == "major" || start == "back";
      const bool mantissa = start == "floor" || start == "ceil";
      const int exponent_bits = bits.coord + bits.finer > 32   ? 6
                                : bits.coord + bits.finer > 16 ? 5
                                : bits.coord + bits.finer > 8  ? 4
                                                               : 3;
      EXPECT_EQ(port.width, flag                ? 1
                            : mantissa          ? bits.mantissa
                            : start == "exp"    ? exponent_bits
                            : start == "len"    ? bits.coord + bits.fraction
                            : start == "origin" ? bits.coord + bits.finer
                                                : bits.coord);
      EXPECT_EQ(port.is_signed, !flag && !mantissa && start != "exp");
    }
    EXPECT_EQ(ports.front().name, "major_y");
    EXPECT_EQ(ports.back().name, "zmax");
  }
}

}  // namespace
}  // namespace hitpipe::rtl::major_formats_test
