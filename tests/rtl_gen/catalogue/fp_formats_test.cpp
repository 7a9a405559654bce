// Formats eEmM of designs for which any of them will do.
#include <stdexcept>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::fp_formats_test {
namespace {

using hls::FpBits;

const Design& safe_slabs() {
  return find_design("fp_slabs_safe");
}

TEST(FpFormats, OfTheWholeRangeAreReadBackAndNoOthersExist) {
  for (int e = 0; e <= 10; ++e) {
    for (int m = 0; m <= 25; ++m) {
      const std::string text = "e" + std::to_string(e) + "m" + std::to_string(m);
      if (e >= 2 && e <= 8 && m >= 1 && m <= 23) {
        EXPECT_EQ(safe_slabs().parse_format(text), Format(FpBits{e, m}));
        EXPECT_EQ(to_string(Format(FpBits{e, m})), text);
      } else {
        EXPECT_EQ(
            message_of<std::runtime_error>([&] { (void)safe_slabs().parse_format(text); }),
            "bits " + text +
                ": no format of fp_slabs_safe; allowed is eEmM with E in 2..8 and M in 1..23, for example "
                "e8m15");
      }
    }
  }
  EXPECT_EQ(safe_slabs().parse_format("fp32"), Format(FpBits{8, 23}));
}

TEST(FpFormats, AreNoFormatsOfUnitsThatRoundToNearest) {
  EXPECT_EQ(message_of<std::runtime_error>([] {
              (void)find_design("fp_slabs").evaluate(FpBits{8, 23});
            }),
            "bits e8m23: no format of fp_slabs; allowed is fp32, which is e8m23");
}

TEST(FpFormats, NameTheModuleAndTheType) {
  EXPECT_EQ(safe_slabs().module_at(FpBits()), "fp_slabs_safe");
  EXPECT_EQ(safe_slabs().module_at(FpBits{8, 15}), "fp_slabs_safe_e8m15");
  EXPECT_EQ(Format(FpBits{5, 10}).type(), "FpFormat<5, 10>");
}

TEST(FpFormats, PortsHaveTheWidthsOfTheFormat) {
  // Bounds of the origin only where the format does not hold a binary32.
  EXPECT_EQ(safe_slabs().ports(FpBits{8, 23}).size(), 20U);
  EXPECT_EQ(safe_slabs().ports(FpBits{8, 22}).size(), 23U);
  EXPECT_EQ(safe_slabs().ports(FpBits{7, 23}).size(), 23U);
  for (const Port& port : safe_slabs().ports(FpBits{5, 10})) {
    const int width = port.kind == hls::Kind::real ? 16 : port.kind == hls::Kind::natural ? 15 : 1;
    EXPECT_EQ(port.width, width) << port.name;
  }
}

}  // namespace
}  // namespace hitpipe::rtl::fp_formats_test
