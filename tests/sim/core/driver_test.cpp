// The driver of examples/core_system refuses what a core would answer wrongly, and says why.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::sim::driver_test {
namespace {

/// Registers that keep what is written. Prints what core_start() says of IMAGE and BLOCKS, and what it wrote.
constexpr const char* program = R"(#include "driver.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
static uint32_t words[64];
static int writes;
void bus_write(uint32_t address, uint32_t value) {
  words[(address - CORE_REGISTERS) / 4] = value;
  ++writes;
}
uint32_t bus_read(uint32_t address) {
  return words[(address - CORE_REGISTERS) / 4];
}
bool fifo_send(uint32_t tag, const uint8_t* bytes) {
  return tag == bytes[0];
}
bool fifo_take(uint32_t* tag, uint8_t* bytes) {
  return *tag == bytes[0];
}
int main(int count, char** arguments) {
  if (count != 5) return 2;
  words[CORE_REG_IDENTITY / 4] = (uint32_t)strtoul(arguments[1], NULL, 0);
  words[CORE_REG_VERSION / 4] = (uint32_t)strtoul(arguments[2], NULL, 0);
  const char* const refused = core_start(strtoull(arguments[3], NULL, 0), strtoull(arguments[4], NULL, 0));
  if (refused) {
    printf("%s, %d writes", refused, writes);
  } else {
    printf("starts at 0x%" PRIx64 ", last %" PRIu32 ", rays %" PRIu32,
           (uint64_t)words[CORE_REG_BASE_HIGH / 4] << 32 | words[CORE_REG_BASE_LOW / 4],
           words[CORE_REG_LAST_BLOCK / 4], words[CORE_REG_MOST_RAYS / 4]);
  }
  return 0;
}
)";

TEST(CoreDriver, SaysWhyItDoesNotStart) {
  const rtl::Core core = rtl::make_core({.rays = 8, .address_bits = 12, .byte_bits = 36},
                                        rtl::library_called(rtl::default_library), "hitpipe_core");
  const host::ScratchFolder folder("core-driver");
  host::write_files(folder.path(), {{"hitpipe_core.h", rtl::c_header(core)}, {"main.c", program}});
  const rtl::ToolResult built =
      rtl::run_tool(folder.path(), "gcc", "cc",
                    "-std=c99 -Wall -Wextra -Wpedantic -Werror -I. -I" HITPIPE_SOURCE
                    "/examples/core_system main.c -o main");
  ASSERT_EQ(built.status, 0) << built.output;
  const auto says = [&](const std::string& arguments) {
    return rtl::run_tool(folder.path(), "main", "./main", arguments).output;
  };
  EXPECT_EQ(says("0x48697470 1 0x40 4096"), "starts at 0x40, last 4095, rays 8");
  EXPECT_EQ(says("0x48697470 1 0xfffffffe0 1"), "starts at 0xfffffffe0, last 0, rays 8");
  EXPECT_EQ(says("0x48697471 1 0x40 4096"), "no core answers at that address, 0 writes");
  EXPECT_EQ(says("0x48697470 2 0x40 4096"), "the core has another version than its header, 0 writes");
  EXPECT_EQ(says("0x48697470 1 0x44 4096"), "the image does not begin at a multiple of 32, 0 writes");
  EXPECT_EQ(says("0x48697470 1 0x40 0"), "the image has no block, 0 writes");
  EXPECT_EQ(says("0x48697470 1 0x40 4097"), "the image has more blocks than the core can name, 0 writes");
  EXPECT_EQ(says("0x48697470 1 0xfffffffe0 2"), "the image ends above the core's last address, 0 writes");
  EXPECT_EQ(says("0x48697470 1 0x1000000000 1"), "the image ends above the core's last address, 0 writes");
}

}  // namespace
}  // namespace hitpipe::sim::driver_test
