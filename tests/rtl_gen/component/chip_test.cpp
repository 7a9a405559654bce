// What a chip's file may say of its tables and shift registers.
#include <string>

#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

namespace hitpipe::rtl::chip_test {
namespace {

constexpr std::string_view mapped_json = R"json({
  "name": "mapped_chip",
  "chip": {
    "device": "toy",
    "estimated": true,
    "lut_inputs": 6,
    "maps_tables": true,
    "register": {"delay_ps": 1, "shortest_shift_register": 3},
    "gate": {"delay_ps": 2, "luts_pct": 25},
    "mux2": {"delay_ps": 3, "luts_pct": 50},
    "carry": {"delay_ps": 10, "delay_ps_per_bit": 2, "luts_pct": 110, "takes_logic": true}
  }
})json";

TEST(Chip, SaysHowItsTablesAreMapped) {
  const Library library = Library::from_json(mapped_json, "mapped.json");
  EXPECT_TRUE(library.chip()->maps_tables);
  EXPECT_TRUE(library.chip()->carry_takes_logic);
  EXPECT_EQ(library.chip()->shortest_shift_register, 3);
  const Library ecp5 = library_called("ecp5");
  EXPECT_FALSE(ecp5.chip()->maps_tables);
  EXPECT_FALSE(ecp5.chip()->carry_takes_logic);
  EXPECT_EQ(ecp5.chip()->shortest_shift_register, 0);
}

TEST(Chip, BadEntriesOfMappingRejected) {
  expect_refusals(
      mapped_json,
      {{R"("maps_tables": true)", R"("maps_tables": 1)", R"(chip: "maps_tables" must be true or false)"},
       {R"("takes_logic": true)", R"("takes_logic": "yes")",
        R"(chip: carry: "takes_logic" must be true or false)"},
       {R"("shortest_shift_register": 3)", R"("shortest_shift_register": 1)",
        R"(chip: register: "shortest_shift_register" is 1, allowed are whole numbers )"
        "from 2 to 64"}});
}

}  // namespace
}  // namespace hitpipe::rtl::chip_test
