// The catalogue: designs by name, formats by text, and the messages for those that do not exist.
#include "rtl_gen/catalogue/design.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/box/major_format.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::design_test {
namespace {

TEST(Designs, AreFoundByName) {
  EXPECT_EQ(find_design("int_slabs").name, "int_slabs");
  EXPECT_EQ(find_design("int_slabs").summary, "integer slabs test, figures 7.4-7.6");
  for (const Design& design : designs()) EXPECT_EQ(&find_design(design.name), &design);
}

TEST(Designs, UnknownNameRejected) {
  std::string names;
  for (const Design& design : designs()) names += (names.empty() ? "" : ", ") + std::string(design.name);
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(find_design("slabs")); }),
            "design slabs: unknown; there are: " + names);
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(find_design("")); }),
            "design : unknown; there are: " + names);
}

TEST(Designs, NameTheirModulesByFormat) {
  const auto module = [](const char* design, const char* bits) {
    return find_design(design).module_at(find_design(design).parse_format(bits));
  };
  EXPECT_EQ(module("int_slabs", "20/24"), "int_slabs");
  EXPECT_EQ(module("int_slabs", "16/16"), "int_slabs_16_16");
  EXPECT_EQ(module("fp_plucker", "e8m23"), "fp_plucker");
  EXPECT_EQ(module("int_major", "20+1/13"), "int_major");
  EXPECT_EQ(module("int_major", "16+1/12"), "int_major_16p1_12");
  EXPECT_EQ(module("int_major_pair", "16+1/12f2"), "int_major_pair_16p1_12f2");
  EXPECT_EQ(module("int_major_pair", "16+1/12f-2"), "int_major_pair_16p1_12fm2");
  EXPECT_EQ(Format(hls::FpBits{5, 10}).identifier(), "e5m10");
}

TEST(Designs, HaveNoModuleNameTwice) {
  std::set<std::string> units, modules;
  for (const Design& design : designs()) {
    const FormatFamily& family = design.default_format.family();
    for (int a = 6; a <= 32; a += 2)
      for (int b = 0; b <= 33; ++b)
        for (int c = 0; c <= 32; c += 4)
          for (int d = -2; d <= 3; ++d) {
            const Format format(family, {a, b, c, d});
            if (!format.valid()) continue;
            const std::string bits = to_string(format);  // without the numbers that the family does not have
            units.insert(std::string(design.name) + " " + bits);
            modules.insert(design.module_at(design.parse_format(bits)));
          }
  }
  EXPECT_GT(modules.size(), 2000U);
  EXPECT_EQ(modules.size(), units.size());
}

TEST(ParseBits, TakesTheThesissNotation) {
  EXPECT_EQ(parse_bits<hls::IntBits>("20/24"), (hls::IntBits{20, 24}));
  EXPECT_EQ(parse_bits<hls::IntBits>("6/6"), (hls::IntBits{6, 6}));
  EXPECT_EQ(parse_bits<hls::IntBits>("32/63"), (hls::IntBits{32, 63}));
  EXPECT_EQ(to_string(hls::IntBits{20, 24}), "20/24");
}

TEST(ParseBits, OtherTextRejected) {
  for (const char* text :
       {"",       "/",      "20",     "20/",       "/24",    "20-24",          "20/24/28",       "20/24 ",
        " 20/24", "20 /24", "+20/24", "twenty/24", "20/x",   "99999999999/24", "20/99999999999", "5/6",
        "33/40",  "20/5",   "20/40",  "6/12",      "-20/24", "20/-24"}) {
    EXPECT_EQ(
        message_of<std::runtime_error>([&] { static_cast<void>(parse_bits<hls::IntBits>(text)); }),
        "bits " + std::string(text) + ": allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24");
  }
}

TEST(Design, FormatThatIsNotThereRejected) {
  const Design& design = find_design("int_slabs");
  const auto expect_rejected = [&](hls::IntBits bits, const std::string& text) {
    const std::string message =
        "bits " + text +
        ": no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24";
    EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(design.trace(bits)); }), message);
    EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(design.evaluate(bits)); }), message);
  };
  expect_rejected({5, 6}, "5/6");
  expect_rejected({33, 40}, "33/40");
  expect_rejected({20, 5}, "20/5");
  expect_rejected({20, 40}, "20/40");
}

TEST(Design, FloatDesignsHaveBinary32Only) {
  const Design& design = find_design("fp_slabs");
  EXPECT_EQ(to_string(design.default_format), "fp32");
  EXPECT_EQ(design.parse_format("fp32"), Format(hls::Binary32{}));
  EXPECT_EQ(design.parse_format("e8m23"), design.default_format);
  const std::string message = "bits 20/24: no format of fp_slabs; allowed is fp32, which is e8m23";
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(design.parse_format("20/24")); }),
            message);
  EXPECT_EQ(message_of<std::runtime_error>([&] {
              static_cast<void>(design.trace(hls::IntBits{20, 24}));
            }),
            message);
  EXPECT_EQ(message_of<std::runtime_error>([&] {
              static_cast<void>(design.evaluate(hls::IntBits{20, 24}));
            }),
            message);
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(design.parse_format("fp64")); }),
            "bits fp64: no format of fp_slabs; allowed is fp32, which is e8m23");
}

TEST(Design, IntegerDesignsHaveNoBinary32) {
  const Design& design = find_design("int_plucker");
  EXPECT_EQ(to_string(design.default_format), "20/24");
  EXPECT_EQ(design.parse_format("12/14"), Format(hls::IntBits{12, 14}));
  const std::string message =
      "bits fp32: no format of int_plucker; allowed is n/t with n in 6..32 and t in 6..2n-1, for example "
      "20/24";
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(design.parse_format("fp32")); }), message);
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(design.trace(Format(hls::Binary32{}))); }),
            message);
}

class EveryIntegerDesign : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Designs, EveryIntegerDesign, testing::Values("int_slabs", "int_plucker"));

TEST_P(EveryIntegerDesign, HasEveryFormatOfItsRange) {
  const Design& design = find_design(GetParam());
  int formats = 0;
  for (int n = 0; n <= 40; ++n) {
    for (int t = 0; t <= 80; ++t) {
      const rtl::Format format = hls::IntBits{n, t};
      if (!format.valid()) {
        EXPECT_THROW(static_cast<void>(design.evaluate(format)), std::runtime_error) << n << "/" << t;
        continue;
      }
      EXPECT_EQ(input_ports(design.trace(format)).size(), design.ports(format).size()) << n << "/" << t;
      ++formats;
    }
  }
  EXPECT_EQ(formats, 864) << "sum over n of 2n-6";
}

TEST(Design, PortsHaveTheWidthsOfTheFormat) {
  for (const hls::IntBits bits : {hls::IntBits{20, 24}, hls::IntBits{24, 24}, hls::IntBits{6, 11}}) {
    const std::vector<Port> ports = find_design("int_slabs").ports(bits);
    ASSERT_EQ(ports.size(), 17U);
    EXPECT_EQ(ports.front().name, "irx");
    EXPECT_EQ(ports.back().name, "izmax");
    for (const Port& port : ports) {
      EXPECT_EQ(port.width, port.name == "rinf"    ? 1
                            : port.name == "irlen" ? bits.interval
                                                   : bits.coord)
          << port.name;
      EXPECT_EQ(port.is_signed, port.name != "rinf") << port.name;
    }
  }
}

TEST(Design, PortsAreThoseOfTheGraph) {
  for (const Design& design : designs()) {
    const std::vector<Port> ports = design.ports(design.default_format);
    const std::vector<Port> traced = input_ports(design.trace(design.default_format));
    ASSERT_EQ(ports.size(), traced.size()) << design.name;
    for (std::size_t i = 0; i < ports.size(); ++i) {
      EXPECT_EQ(ports[i].name, traced[i].name) << design.name;
      EXPECT_EQ(ports[i].width, traced[i].width) << ports[i].name;
      EXPECT_EQ(ports[i].is_signed, traced[i].is_signed) << ports[i].name;
      ASSERT_TRUE(ports[i].range) << ports[i].name;
    }
  }
}

TEST(Design, OriginAndBoxAreFoundByTheirRoles) {
  using hls::Axis;
  using hls::Role;
  for (const Design& design : designs()) {
    const std::vector<Port> ports = design.ports(design.default_format);
    // Designs with a major axis have the origin in slots, and their largest length is that of an endless ray.
    const bool slots = design.default_format.is<hls::MajorBits>();
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      for (const Role role : {Role::plane_low, Role::plane_high})
        EXPECT_TRUE(index_of(ports, role, axis)) << design.name;
      EXPECT_EQ(index_of(ports, Role::origin, axis).has_value(), !slots) << design.name;
    }
    const auto count = [&](Role role) {
      return std::count_if(ports.begin(), ports.end(), [&](const Port& port) { return port.role == role; });
    };
    EXPECT_EQ(count(Role::origin), 3) << design.name;
    const bool ends = count(Role::length) + count(Role::endpoint) > 0;
    EXPECT_EQ(count(Role::endless), ends && !slots ? 1 : 0) << design.name;
    EXPECT_EQ(count(Role::major), slots ? 2 : 0) << design.name;
    const bool mirrored = slots || design.default_format.is<hls::FpBits>();
    EXPECT_EQ(count(Role::backward), mirrored ? 3 : 0) << design.name;
    EXPECT_EQ(count(Role::exponent), slots ? 2 : 0) << design.name;
  }
}

TEST(AddDesign, SecondOfOneNameRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { add_design(find_design("int_slabs")); }),
            "design int_slabs: there is one of that name");
}

}  // namespace
}  // namespace hitpipe::rtl::design_test
