// Designs and ports as the library lists them, against the catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hitpipe/ref.hpp>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe {
namespace {

TEST(LibraryCatalogue, ListsAllDesigns) {
  const std::vector<DesignInfo> listed = designs();
  ASSERT_EQ(listed.size(), rtl::designs().size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const rtl::Design& design = rtl::designs()[i];
    EXPECT_EQ(listed[i].name, design.name);
    EXPECT_EQ(listed[i].summary, design.summary);
    EXPECT_EQ(listed[i].default_format, to_string(design.default_format));
    EXPECT_EQ(listed[i].formats, design.default_format.family().allowed());
    EXPECT_EQ(listed[i].conservative != 0, design.conservative);
    EXPECT_EQ(listed[i].boxes_per_test, design.kind.objects);
  }
}

TEST(LibraryCatalogue, AUnitHasThePortsAndResultsOfItsDesign) {
  for (const rtl::Design& design : rtl::designs()) {
    SCOPED_TRACE(design.name);
    const Unit unit{std::string(design.name)};
    EXPECT_EQ(unit.design(), design.name);
    EXPECT_EQ(unit.format(), to_string(design.default_format));
    EXPECT_EQ(unit.conservative(), design.conservative);
    const auto ports = design.ports(design.default_format);
    ASSERT_EQ(unit.ports().size(), ports.size());
    for (std::size_t i = 0; i < ports.size(); ++i) {
      const PortInfo& port = unit.ports()[i];
      EXPECT_EQ(port.name, ports[i].name);
      EXPECT_EQ(port.width, ports[i].width);
      EXPECT_EQ(port.is_signed != 0, ports[i].is_signed);
      EXPECT_EQ(static_cast<int>(port.role), static_cast<int>(ports[i].role));
      EXPECT_EQ(static_cast<int>(port.kind), static_cast<int>(*ports[i].kind));
      EXPECT_EQ(port.axis, static_cast<int>(ports[i].axis) - 1);
      EXPECT_EQ(port.box, ports[i].box);
      EXPECT_EQ(port.min, ports[i].range->low);
      EXPECT_EQ(port.max, ports[i].range->high);
    }
    const auto results = design.results(design.default_format);
    ASSERT_EQ(unit.results().size(), results.size());
    for (std::size_t i = 0; i < results.size(); ++i) {
      EXPECT_STREQ(unit.results()[i].name, results[i].name);
      EXPECT_EQ(unit.results()[i].width, results[i].width);
      EXPECT_EQ(unit.results()[i].is_signed != 0, results[i].is_signed);
      EXPECT_EQ(static_cast<int>(unit.results()[i].meaning), static_cast<int>(results[i].meaning));
      EXPECT_EQ(unit.results()[i].box, results[i].box);
    }
  }
}

TEST(LibraryCatalogue, AFormatIsSpelledAsTheProgramTakesIt) {
  EXPECT_EQ(Unit("int_slabs", "12/14").format(), "12/14");
  EXPECT_EQ(Unit("int_slabs", "12/14").ports()[0].width, 12);
  EXPECT_EQ(Unit("int_major", "16+1/11").format(), "16+1/11");
}

}  // namespace
}  // namespace hitpipe
