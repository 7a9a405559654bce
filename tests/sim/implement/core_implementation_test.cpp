// A small core, alone and behind AXI, in the cells of a chip and in standard cells. Its memories are counted
// apart from its logic.
#include "sim/implement/core_implementation.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/axi.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::core_implementation_test {
namespace {

const rtl::CoreOptions small{.bits = parse_bits<hls::RayBits>("8+0/4s8"),
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

struct Memories {
  std::int64_t bits = 0;
  int lut_rams = 0;  ///< of 16 words of 4 bits

  void add(const std::vector<hls::MemoryShape>& shapes) {
    for (const hls::MemoryShape& shape : shapes) {
      bits += std::int64_t{shape.words} * shape.width;
      lut_rams += (shape.words + 15) / 16 * ((shape.width + 3) / 4);
    }
  }
};

void expect_memories(const MappedCore& mapped, const Memories& memories) {
  EXPECT_EQ(mapped.chip.library, "ecp5");
  EXPECT_EQ(mapped.chip.excess(), "");
  EXPECT_EQ(mapped.memory_bits, memories.bits);
  EXPECT_EQ(mapped.chip.count_of("lut_rams")->used, memories.lut_rams);
  EXPECT_EQ(mapped.chip.count_of("luts")->used, 6 * memories.lut_rams);
  EXPECT_GT(mapped.chip.count_of("dsps")->used, 0);
}

TEST(CoreImplementation, MemoriesOfAChipAreLutRams) {
  Target target = target_called("ecp5");
  // Logic is not mapped, which would take the time.
  target.synthesis = {"synth_ecp5 -top {top} -run begin:map_gates", "chtype -set LOGIC t:$*",
                      "blackbox =A:whitebox"};
  const TemporaryFolder folder;
  // A bus whose beats are put together in a memory of the wrapper.
  rtl::CoreOptions narrow = small;
  narrow.data_bits = 64;
  const CoreImplementation made = implement_core(narrow, target, {.folder = folder.path(), .module = "box"});
  const rtl::Core core = rtl::make_core(narrow, rtl::library_called("ecp5"));
  Memories memories;
  memories.add(memories_of(core));
  EXPECT_EQ(made.core.chip.module, "box");
  expect_memories(made.core, memories);
  for (const rtl::Part& part : rtl::behind_axi(core).parts)
    if (part.graph) memories.add(part.graph->memories);
  EXPECT_GT(memories.bits, made.core.memory_bits);
  EXPECT_EQ(made.axi.chip.module, "box_axi");
  expect_memories(made.axi, memories);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "ecp5" / "box.v"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "ecp5" / "box_axi.v"));
}

TEST(CoreImplementation, SaysWhichModuleIsNotMapped) {
  Target target = target_called("xc7");
  target.synthesis = {"prep -flatten -top {top}", "chtype -set OTHER t:$*", "select -assert-none =box_axi"};
  const TemporaryFolder folder;
  EXPECT_EQ(
      message_of([&] { (void)implement_core(small, target, {.folder = folder.path(), .module = "box"}); }),
      "box_axi: yosys: failed with exit code 1; its output is in " +
          (folder.path() / "xc7" / "box_axi_synthesis.log").string());
}

TEST(CoreImplementation, MemoriesAreBlackBoxesAmongStandardCells) {
  Target target = target_called("osu018");
  // A recipe of less time.
  for (std::string& line : target.synthesis)
    if (line.starts_with("abc ")) line = "abc -fast -liberty {liberty}";
  const TemporaryFolder folder;
  const CoreImplementation made = implement_core(small, target, {.folder = folder.path()});
  const rtl::Core core = rtl::make_core(small, rtl::library_called("osu018"));
  EXPECT_EQ(made.clock_ps, core.clock_ps);
  for (const MappedCore* const mapped : {&made.core, &made.axi}) {
    const Implementation& chip = mapped->chip;
    EXPECT_EQ(chip.count_of("rams")->used, memories_of(core).size());
    // More bits than all registers: none of them is a register.
    EXPECT_GT(mapped->memory_bits, chip.count_of("registers")->used);
    EXPECT_GT(*chip.critical_path_ns, 0.0);
    std::ifstream timing(folder.path() / "osu018" / (chip.module + "_timing.log"));
    EXPECT_THAT(std::string(std::istreambuf_iterator<char>(timing), {}),
                testing::Not(testing::HasSubstr("Error")));
  }
  EXPECT_GT(*made.core.chip.synthesis.area_um2, 0.0);
  EXPECT_GT(*made.axi.chip.synthesis.area_um2, *made.core.chip.synthesis.area_um2);
}

}  // namespace
}  // namespace hitpipe::sim::core_implementation_test
