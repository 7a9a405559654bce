// Formats n/t, n+g/p, eEmM and fp32: their spelling, what is refused, every format of the range, and the
// widths of ports that follow.
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/box/major_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::formats_test {
namespace {

using hls::FpBits;
using hls::IntBits;
using hls::MajorBits;

const std::string allowed_of_int = "allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24";
const std::string allowed_of_major =
    "allowed is n+g/p or n+g/pfFsS with n in 6..32, g in 0..3, p in 4..32, F in -2..3, S in 8..32 and n+g+p "
    "at most 63, and n at most 24 with s, "
    "for "
    "example 20+1/13";
const std::string allowed_of_any_float = "allowed is eEmM with E in 2..8 and M in 1..23, for example e8m15";
const std::string allowed_of_float = "allowed is fp32, which is e8m23";

TEST(Formats, AreReadAndWritten) {
  const struct {
    const char *design, *text;
    Format format;
    const char* written;
  } cases[] = {{"int_slabs", "20/24", IntBits{20, 24}, "20/24"},
               {"int_slabs", "6/6", IntBits{6, 6}, "6/6"},
               {"int_plucker", "32/63", IntBits{32, 63}, "32/63"},
               {"int_major", "20+1/13", MajorBits{20, 1, 13}, "20+1/13"},
               {"int_major", "20+1/13f0", MajorBits{20, 1, 13}, "20+1/13"},
               {"int_major", "6+0/4", MajorBits{6, 0, 4}, "6+0/4"},
               {"int_major", "12+2/10f1", MajorBits{12, 2, 10, 1}, "12+2/10f1"},
               {"int_major", "8+3/6f-1", MajorBits{8, 3, 6, -1}, "8+3/6f-1"},
               {"fp_slabs", "fp32", hls::Binary32{}, "fp32"},
               {"fp_slabs", "e8m23", hls::Binary32{}, "fp32"},
               {"fp_slabs_safe", "fp32", FpBits{8, 23}, "e8m23"}};
  for (const auto& [design, text, format, written] : cases) {
    EXPECT_EQ(find_design(design).parse_format(text), format) << text;
    EXPECT_EQ(to_string(format), written);
  }
  for (const auto& [design, usual] :
       {std::pair{"int_plucker", "20/24"}, {"int_major", "20+1/13"}, {"fp_slabs", "fp32"}})
    EXPECT_EQ(to_string(find_design(design).default_format), usual);
  EXPECT_EQ(parse_bits<IntBits>("20/24"), (IntBits{20, 24}));
  EXPECT_EQ(message_of([] { return parse_bits<IntBits>("5/6"); }), "bits 5/6: " + allowed_of_int);
}

TEST(Formats, HaveATypeForHighLevelSynthesis) {
  EXPECT_EQ(Format(MajorBits{20, 1, 13}).type(), "MajorFormat<20, 1, 13>");
  EXPECT_EQ(Format(MajorBits{8, 3, 6, -1}).type(), "MajorFormat<8, 3, 6, -1>");
  EXPECT_EQ(Format(FpBits{5, 10}).type(), "FpFormat<5, 10>");
}

/// Each line of `texts`.
void expect_refused(const char* design, const std::string& texts, const std::string& allowed) {
  std::istringstream lines(texts);
  for (std::string text; std::getline(lines, text);)
    EXPECT_EQ(message_of([&] { return find_design(design).parse_format(text); }),
              "bits " + text + ": no format of " + design + "; " + allowed);
}

TEST(Formats, OtherTextRejected) {
  expect_refused("int_slabs",
                 "\n/\n20\n20/\n/24\n20-24\n20/24/28\n20/24 \n 20/24\n20 /24\n+20/24\ntwenty/24\n20/x\n"
                 "99999999999/24\n20/99999999999\n5/6\n33/40\n20/5\n20/40\n6/12\n-20/24\n20/-24",
                 allowed_of_int);
  expect_refused("int_plucker", "fp32", allowed_of_int);
  expect_refused(
      "int_major",
      "\n+\n/\n20\n20+1\n20+1/\n20+/12\n+1/12\n20/12\n20/12+1\n20-1/12\n20+1/13 \n 20+1/13\n20 +1/12\n"
      "20+1/13f\n20+1/13F1\n20+1/13f+1\n20+1/13f1 \n20+1/13f1.\n20+1/13/0\n+20+1/13\n20++1/12\n"
      "20+1/+12\n20+1/x\ntwenty+1/12\n20+1/13-1\nfp32\n0x14+1/12\n5+1/12\n33+1/12\n-20+1/13\n"
      "20+-1/12\n20+4/12\n20+1/3\n20+1/33\n20+1/-12\n20+1/13f-3\n20+1/13f4\n32+0/32\n31+1/32\n29+3/32\n"
      "32+3/29\n4294967316+1/12\n20+4294967297/12\n20+1/4294967308\n20+1/13f4294967296",
      allowed_of_major);
  expect_refused("fp_slabs", "20/24\nfp64", allowed_of_float);
}

TEST(Formats, OfOtherFamiliesAndOutsideTheRangeRejected) {
  const struct {
    const char* design;
    Format format;
    std::string allowed;
  } cases[] = {
      {"int_slabs", IntBits{5, 6}, allowed_of_int},        {"int_slabs", IntBits{33, 40}, allowed_of_int},
      {"int_slabs", IntBits{20, 5}, allowed_of_int},       {"int_slabs", IntBits{20, 40}, allowed_of_int},
      {"int_slabs", MajorBits{20, 1, 13}, allowed_of_int}, {"int_plucker", hls::Binary32{}, allowed_of_int},
      {"int_major", IntBits{20, 24}, allowed_of_major},    {"fp_slabs", IntBits{20, 24}, allowed_of_float},
      {"fp_slabs", FpBits{8, 23}, allowed_of_float}};
  for (const auto& each : cases) {
    const Design& design = find_design(each.design);
    const std::string message =
        "bits " + to_string(each.format) + ": no format of " + each.design + "; " + each.allowed;
    EXPECT_EQ(message_of([&] { return design.trace(each.format); }), message);
    EXPECT_EQ(message_of([&] { return design.evaluate(each.format); }), message);
  }
}

TEST(Formats, OfEveryFloatAreReadBackAndNoOthersExist) {
  for (int e = 0; e <= 10; ++e) {
    for (int m = 0; m <= 25; ++m) {
      const std::string text = "e" + std::to_string(e) + "m" + std::to_string(m);
      if (e < 2 || e > 8 || m < 1 || m > 23) {
        expect_refused("fp_slabs_safe", text, allowed_of_any_float);
        continue;
      }
      EXPECT_EQ(find_design("fp_slabs_safe").parse_format(text), Format(FpBits{e, m}));
      EXPECT_EQ(to_string(Format(FpBits{e, m})), text);
    }
  }
}

/// The limits, written without MajorBits' own.
bool allowed(int n, int g, int p, int fraction) {
  return n >= 6 && n <= 32 && g >= 0 && g <= 3 && p >= 4 && p <= 32 && fraction >= -2 && fraction <= 3 &&
         n + g + p <= 63;
}

TEST(Formats, OfEveryMajorAxisAreReadBackAndNoOthersExist) {
  int formats = 0;
  for (int n = 3; n <= 35; ++n)
    for (int g = -1; g <= 5; ++g)
      for (int p = 2; p <= 35; ++p)
        for (int fraction = -4; fraction <= 5; ++fraction) {
          const Format format = MajorBits{n, g, p, fraction};
          ASSERT_EQ(format.valid(), allowed(n, g, p, fraction)) << to_string(format);
          const auto numbers = format.family().parse(to_string(format));
          ASSERT_TRUE(numbers && *numbers == format.numbers()) << to_string(format);
          formats += format.valid() ? 1 : 0;
        }
  EXPECT_EQ(formats, 18'672);
}

TEST(PortWidths, OfIntegersFollowTheFormat) {
  for (const IntBits bits : {IntBits{20, 24}, IntBits{24, 24}, IntBits{6, 11}}) {
    const std::vector<Port> ports = find_design("int_slabs").ports(bits);
    ASSERT_EQ(ports.size(), 17U);
    EXPECT_EQ(ports.front().name, "irx");
    EXPECT_EQ(ports.back().name, "izmax");
    for (const Port& port : ports) {
      const bool flag = port.name == "rinf";
      EXPECT_EQ(port.width, flag ? 1 : port.name == "irlen" ? bits.interval : bits.coord) << port.name;
      EXPECT_EQ(port.is_signed, !flag) << port.name;
    }
  }
}

/// Distances and lengths have no bit too few: their widths follow from the largest number.
TEST(PortWidths, OfAMajorAxisFollowTheFormat) {
  for (const MajorBits bits : {MajorBits{20, 1, 13}, MajorBits{6, 0, 4}, MajorBits{8, 3, 6, -1},
                               MajorBits{12, 2, 10, 3}, MajorBits{32, 0, 31}, MajorBits{32, 3, 28, -2}}) {
    const std::vector<Port> ports = find_design("int_major").ports(bits);
    ASSERT_EQ(ports.size(), 21U);
    for (const Port& port : ports) {
      SCOPED_TRACE(to_string(Format(bits)) + " " + port.name);
      const std::string start = port.name.substr(0, port.name.find('_'));
      const bool flag = start == "major" || start == "back";
      const bool mantissa = start == "floor" || start == "ceil";
      const int fine = bits.coord + bits.finer;
      EXPECT_EQ(port.width, flag       ? 1
                            : mantissa ? bits.mantissa
                            : start == "exp"
                                ? 3 + (fine > 8 ? 1 : 0) + (fine > 16 ? 1 : 0) + (fine > 32 ? 1 : 0)
                            : start == "len"    ? bits.coord + bits.fraction
                            : start == "origin" ? fine
                                                : bits.coord);
      EXPECT_EQ(port.is_signed, !flag && !mantissa && start != "exp");
    }
    EXPECT_EQ(ports.front().name, "major_y");
    EXPECT_EQ(ports.back().name, "zmax");
  }
}

TEST(PortWidths, OfFloatsFollowTheFormat) {
  const Design& safe_slabs = find_design("fp_slabs_safe");
  // Bounds of the origin only where the format does not hold a binary32.
  EXPECT_EQ(safe_slabs.ports(FpBits{8, 23}).size(), 20U);
  EXPECT_EQ(safe_slabs.ports(FpBits{8, 22}).size(), 23U);
  EXPECT_EQ(safe_slabs.ports(FpBits{7, 23}).size(), 23U);
  for (const Port& port : safe_slabs.ports(FpBits{5, 10})) {
    const int width = port.kind == hls::Kind::real ? 16 : port.kind == hls::Kind::natural ? 15 : 1;
    EXPECT_EQ(port.width, width) << port.name;
  }
}

}  // namespace
}  // namespace hitpipe::rtl::formats_test
