// A small core in the cells of a chip and in standard cells. Its memories are counted apart from its logic.
#include "sim/implement/core_implementation.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::core_implementation_test {
namespace {

const rtl::CoreOptions small{.bits = rtl::parse_bits<hls::RayBits>("8+0/4s8"),
                             .rays = 16,
                             .stack_bits = 1,
                             .address_bits = 8,
                             .byte_bits = 13,
                             .tag_bits = 1,
                             .triangle_interval = 8};

/// Of all machines.
std::vector<hls::MemoryShape> memories_of(const rtl::Core& core) {
  std::vector<hls::MemoryShape> memories;
  for (const rtl::Part& part : core.parts)
    if (part.graph) memories.insert(memories.end(), part.graph->memories.begin(), part.graph->memories.end());
  return memories;
}

TEST(CoreImplementation, MemoriesOfAChipAreLutRams) {
  Target target = target_called("ecp5");
  // Logic is not mapped, which would take the time.
  target.synthesis = {"synth_ecp5 -top {top} -run begin:map_gates", "chtype -set LOGIC t:$*",
                      "blackbox =A:whitebox"};
  const TemporaryFolder folder;
  const CoreImplementation core = implement_core(small, target, {.folder = folder.path(), .module = "box"});
  EXPECT_EQ(core.chip.module, "box");
  EXPECT_EQ(core.chip.library, "ecp5");
  EXPECT_EQ(core.chip.excess(), "");
  std::int64_t bits = 0;
  int lut_rams = 0;  // of 16 words of 4 bits
  for (const hls::MemoryShape& memory : memories_of(rtl::make_core(small, rtl::library_called("ecp5")))) {
    bits += std::int64_t{memory.words} * memory.width;
    lut_rams += (memory.words + 15) / 16 * ((memory.width + 3) / 4);
  }
  EXPECT_EQ(core.memory_bits, bits);
  EXPECT_EQ(core.chip.count_of("lut_rams")->used, lut_rams);
  EXPECT_EQ(core.chip.count_of("luts")->used, 6 * lut_rams);
  EXPECT_GT(core.chip.count_of("dsps")->used, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "ecp5" / "box.v"));
}

TEST(CoreImplementation, MemoriesAreBlackBoxesAmongStandardCells) {
  Target target = target_called("osu018");
  // A recipe of less time.
  for (std::string& line : target.synthesis)
    if (line.starts_with("abc ")) line = "abc -fast -liberty {liberty}";
  const TemporaryFolder folder;
  const CoreImplementation core = implement_core(small, target, {.folder = folder.path()});
  const rtl::Core made = rtl::make_core(small, rtl::library_called("osu018"));
  EXPECT_EQ(core.clock_ps, made.clock_ps);
  EXPECT_EQ(core.chip.count_of("rams")->used, memories_of(made).size());
  // More bits than all registers: none of them is a register.
  EXPECT_GT(core.memory_bits, core.chip.count_of("registers")->used);
  EXPECT_GT(*core.chip.synthesis.area_um2, 0.0);
  EXPECT_GT(*core.chip.critical_path_ns, 0.0);
  std::ifstream timing(folder.path() / "osu018" / (small.module() + "_timing.log"));
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(timing), {}),
              testing::Not(testing::HasSubstr("Error")));
}

}  // namespace
}  // namespace hitpipe::sim::core_implementation_test
