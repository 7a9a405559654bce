// Prices and formats of the library, against the program's.
#include "area_model/price.hpp"

#include <gtest/gtest.h>
#include <hitpipe/ref.hpp>

#include "rtl_gen/component/library.hpp"
#include "tests/message_of.hpp"

namespace hitpipe {
namespace {

TEST(LibraryPrice, IsTheBuiltPriceOfEveryDesignInEveryLibrary) {
  std::size_t priced = 0;
  for (const std::string& name : rtl::built_in_names()) {
    const rtl::Library library = rtl::library_called(name);
    for (const rtl::Design& design : rtl::designs()) {
      SCOPED_TRACE(name + " " + std::string(design.name));
      const auto ours = [&] { return price(std::string(design.name), "", name); };
      std::optional<area::Price> expected;
      const std::string refused = message_of(
          [&] { expected = area::price(design, design.default_format, library, area::Account::built); });
      if (!expected) {
        EXPECT_EQ(message_of([&] { static_cast<void>(ours()); }), refused);
        continue;
      }
      const PriceInfo found = ours();
      EXPECT_EQ(found.stages, expected->stages);
      EXPECT_EQ(found.stage_delay_ps, expected->stage_delay_ps);
      EXPECT_EQ(found.area_um2, expected->area_um2);
      EXPECT_EQ(found.is_chip != 0, library.chip() != nullptr);
      EXPECT_EQ(found.lookup_tables, expected->taken.luts);
      EXPECT_EQ(found.registers, expected->taken.registers);
      EXPECT_EQ(found.multiplier_blocks, expected->taken.blocks);
      ++priced;
    }
  }
  EXPECT_GE(priced, 30U);
}

/// Table 7.2 prints int_slabs 20/24 in the cells of the thesis, as docs/reproduction.md has it.
TEST(LibraryPrice, WithoutALibraryIsInTheCellsOfTheThesis) {
  const PriceInfo found = price("int_slabs", "16/16");
  const PriceInfo named = price("int_slabs", "16/16", "thesis_250nm");
  EXPECT_EQ(found.area_um2, named.area_um2);
  EXPECT_GT(found.area_um2, 100'000);
  EXPECT_LT(found.area_um2, price("int_slabs", "20/24").area_um2);
}

TEST(LibraryPrice, BadInputIsNamed) {
  EXPECT_EQ(message_of([] { static_cast<void>(price("slabs")); }).substr(0, 22), "design slabs: unknown;");
  EXPECT_EQ(message_of([] { static_cast<void>(price("int_slabs", "3/3")); }).substr(0, 30),
            "bits 3/3: no format of int_sla");
  PriceInfo info{};
  info.stages = 7;
  EXPECT_EQ(hitpipe_price("int_slabs", nullptr, "gold", &info), HITPIPE_BAD_LIBRARY);
  EXPECT_EQ(std::string(hitpipe_error()), message_of([] { static_cast<void>(rtl::library_called("gold")); }));
  EXPECT_EQ(hitpipe_price("int_slabs", nullptr, "/nowhere.json", &info), HITPIPE_BAD_LIBRARY);
  EXPECT_EQ(hitpipe_price(nullptr, nullptr, nullptr, &info), HITPIPE_BAD_ARGUMENT);
  EXPECT_STREQ(hitpipe_error(), "design: a null pointer is not allowed");
  EXPECT_EQ(hitpipe_price("int_slabs", nullptr, nullptr, nullptr), HITPIPE_BAD_ARGUMENT);
  EXPECT_STREQ(hitpipe_error(), "out: a null pointer is not allowed");
  EXPECT_EQ(info.stages, 7);
}

TEST(LibraryFormat, IsCheckedAsAUnitChecksIt) {
  EXPECT_EQ(hitpipe_check_format("int_major", "16+1/11"), HITPIPE_OK);
  EXPECT_EQ(hitpipe_check_format("int_major", ""), HITPIPE_OK);
  EXPECT_EQ(hitpipe_check_format("int_slabs", "16+1/11"), HITPIPE_BAD_FORMAT);
  const std::string line = hitpipe_error();
  EXPECT_EQ(message_of([] { Unit("int_slabs", "16+1/11"); }), line);
  EXPECT_EQ(hitpipe_check_format("slabs", "16/16"), HITPIPE_BAD_DESIGN);
  EXPECT_EQ(hitpipe_check_format(nullptr, "16/16"), HITPIPE_BAD_ARGUMENT);
}

}  // namespace
}  // namespace hitpipe
