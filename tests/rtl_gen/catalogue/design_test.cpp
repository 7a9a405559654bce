// The catalogue: designs by name, formats by text, and the messages for unknown names.
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
  EXPECT_EQ(message_of([] { return find_design("slabs"); }), "design slabs: unknown; there are: " + names);
  EXPECT_EQ(message_of([] { return find_design(""); }), "design : unknown; there are: " + names);
}

TEST(Designs, NameTheirModulesByFormat) {
  const auto module = [](const char* design, const char* bits) {
    return find_design(design).module_at(find_design(design).parse_format(bits));
  };
  EXPECT_EQ(module("int_slabs", "20/24"), "int_slabs");
  EXPECT_EQ(module("int_slabs", "16/16"), "int_slabs_16_16");
  EXPECT_EQ(module("fp_plucker", "e8m23"), "fp_plucker");
  EXPECT_EQ(module("fp_slabs_safe", "e8m15"), "fp_slabs_safe_e8m15");
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

TEST(Design, PortsAreThoseOfTheGraph) {
  for (const Design& design : designs()) {
    const std::vector<Port> stated = design.ports(design.default_format);
    const std::vector<Port> traced = input_ports(design.trace(design.default_format));
    ASSERT_EQ(stated.size(), traced.size()) << design.name;
    for (std::size_t i = 0; i < stated.size(); ++i) {
      EXPECT_EQ(stated[i].name, traced[i].name) << design.name;
      EXPECT_EQ(stated[i].width, traced[i].width) << stated[i].name;
      EXPECT_EQ(stated[i].is_signed, traced[i].is_signed) << stated[i].name;
      EXPECT_TRUE(stated[i].range) << stated[i].name;
    }
  }
}

TEST(Design, OriginAndBoxAreFoundByTheirRoles) {
  using hls::Axis;
  using hls::Role;
  for (const Design& design : designs()) {
    if (!design.kind.of_boxes) continue;
    const std::vector<Port> ports = design.ports(design.default_format);
    // Designs with a major axis have the origin in slots, and an endless ray has their largest length.
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

TEST(AddDesign, AfterTheFirstUseOfTheListRejected) {
  Design late = find_design("int_slabs");
  late.name = "late_slabs";
  EXPECT_EQ(message_of<std::invalid_argument>([&] { add_design(late); }),
            "design late_slabs: add it before the first use of the list of designs");
  EXPECT_FALSE(place_of(late));
}

}  // namespace
}  // namespace hitpipe::rtl::design_test
