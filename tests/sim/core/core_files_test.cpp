// The files of a core: testbench and system pass in the simulators, and see damage. The tools have nothing to
// say of the Verilog.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/core/files.hpp"
#include "sim/core/core_vectors.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sim/core/run_make.hpp"

namespace hitpipe::sim::core_files_test {
namespace {

using testing::HasSubstr;

const rtl::Library& library() {
  static const rtl::Library own = rtl::library_called(rtl::default_library);
  return own;
}

std::vector<host::File> files_of(const rtl::CoreOptions& options, const std::string& module = "core") {
  const rtl::Core core = rtl::make_core(options, library(), module);
  return rtl::core_files(core, library(), core_test(core, 2000, 7));
}

struct Kind {
  const char* name;
  rtl::CoreOptions options;
  /// Verilator compiles the testbench too. It has one text for all kinds, but for widths.
  bool in_verilator = false;
};

const Kind usual{"Usual", {.bits = {12, 1, 7, 0, 12, 0}}, true};
const Kind questions{"Questions",
                     {.bits = {12, 1, 7, 0, 12, 0}, .rays = 8, .in_order = true, .questions = true}};

/// Those that are damaged are made once.
const std::vector<host::File>& files_of(const Kind& kind) {
  static std::map<std::string, std::vector<host::File>> made;
  const auto [files, is_new] = made.try_emplace(kind.name);
  if (is_new) files->second = files_of(kind.options);
  return files->second;
}

class CoreFiles : public testing::TestWithParam<Kind> {};

TEST_P(CoreFiles, PassInAllTools) {
  const host::ScratchFolder folder("core-files");
  host::write_files(folder.path(), files_of(GetParam()));
  rtl::expect_silent_tools(folder.path(), {{"core_axi", "core"}});
  for (const std::string target : {"icarus", "verilator"}) {
    if (target == "verilator" && !GetParam().in_verilator) continue;
    const rtl::ToolResult result = run_make(folder.path(), target);
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("PASS 2000 cycles"));
  }
  const rtl::ToolResult system = run_make(folder.path(), "harness");
  EXPECT_EQ(system.status, 0) << system.output;
  EXPECT_THAT(system.output, HasSubstr("PASS 1000 rays"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoreFiles,
                         testing::Values(usual,
                                         Kind{"OneRay",
                                              {.bits = {10, 2, 6, -1, 9, 2},
                                               .rays = 1,
                                               .stack_bits = 1,
                                               .levels = 20,
                                               .address_bits = 4,
                                               .byte_bits = 9,
                                               .tag_bits = 1,
                                               .triangle_interval = 3}},
                                         Kind{"ManyRays",
                                              {.bits = {16, 0, 8, 0, 14, 0},
                                               .rays = 200,
                                               .stack_bits = 2,
                                               .address_bits = 32,
                                               .byte_bits = 64,
                                               .tag_bits = 40,
                                               .triangle_interval = 9},
                                              true},
                                         Kind{"FloatsAndWeights",
                                              {.bits = {14, 1, 7, 0, 12, 1},
                                               .rays = 40,
                                               .tag_bits = 64,
                                               .data_bits = 128,
                                               .float_door = true,
                                               .weights = true}},
                                         Kind{"Serial",
                                              {.bits = {12, 0, 7, 0, 12, 0},
                                               .rays = 2,
                                               .stack_bits = 1,
                                               .levels = 24,
                                               .clock_ps = 40'000,
                                               .block_rams = 26,
                                               .serial_triangle = true}},
                                         questions,
                                         Kind{"NarrowAndCached",
                                              {.bits = {12, 1, 7, 0, 12, 0},
                                               .rays = 8,
                                               .levels = 24,
                                               .address_bits = 12,
                                               .number_bits = 8,
                                               .leaf_bits = 3,
                                               .step_bits = 8,
                                               .cache = {.kib = 4}}},
                                         Kind{"NarrowWithQuestionsInTwoBlocks",
                                              {.bits = {12, 1, 7, 0, 12, 0},
                                               .rays = 8,
                                               .levels = 5,
                                               .number_bits = 4,
                                               .leaf_bits = 2,
                                               .step_bits = 4,
                                               .data_bits = 512,
                                               .questions = true}},
                                         Kind{"CachedInOneBeat",
                                              {.bits = {8, 0, 4, 0, 8, 0},
                                               .rays = 40,
                                               .data_bits = 512,
                                               .serial_triangle = true,
                                               .cache = {.kib = 8, .ways = 4}}},
                                         Kind{"RingsAndACache",
                                              {.bits = {8, 0, 4, 0, 8, 0},
                                               .address_bits = 6,
                                               .byte_bits = 11,
                                               .tag_bits = 24,
                                               .data_bits = 64,
                                               .float_door = true,
                                               .cache = {.kib = 2, .line = 32},
                                               .rings = true}}),
                         [](const auto& each) { return each.param.name; });

/// A change of one file, and what sees it.
struct Damage {
  const char *name, *file, *good, *bad, *target;
  Kind of = usual;
};

class DamagedCore : public testing::TestWithParam<Damage> {};

TEST_P(DamagedCore, IsSeen) {
  const Damage& damage = GetParam();
  const host::ScratchFolder folder("damaged-core");
  std::vector<host::File> files = files_of(damage.of);
  for (host::File& file : files)
    if (file.name == damage.file) file.contents = rtl::replaced(file.contents, damage.good, damage.bad);
  host::write_files(folder.path(), files);
  const rtl::ToolResult result = run_make(folder.path(), damage.target);
  EXPECT_NE(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("FAIL"));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, DamagedCore,
    testing::Values(
        Damage{"StaleTag", "core.v", "tags[leaving_ray]", "tags[ray_1]", "icarus"},
        Damage{"StaleTagInTheSystem", "core.v", "tags[leaving_ray]", "tags[ray_1]", "harness"},
        Damage{"HalvesOfAWordTradePlaces", "core_axi.v", "(m_axi_rdata[63:0])",
               "({m_axi_rdata[31:0], m_axi_rdata[63:32]})", "harness"},
        Damage{"AnyForNearest", "core_axi.v", ".ray_any(s_axis_ray_tdata[0])",
               ".ray_any(~s_axis_ray_tdata[0])", "harness"},
        Damage{"WriteToAnotherRegister", "core.h", "REG_LAST_BLOCK 0x18", "REG_LAST_BLOCK 0x1c", "harness"},
        Damage{"AnswersAreCountedAlways", "core_axi.v", "count_answers <= next_count_answers_value",
               "count_answers <= next_count_answers_value + 40'h1", "harness"},
        Damage{"SecondMoveOfATieIsLeftOut", "core.v", "still = meets_word & zero_1", "still = 3'h0",
               "harness", questions},
        Damage{"TieCountsTwice", "core.v", "ties_and = hit_1 & ~again", "ties_and = hit_1 & ~again_and",
               "harness", questions},
        Damage{"TieIsMovedUpAlways", "core.v", "inner_1 ^ {3{tested_down_1}}", "inner_1", "harness",
               questions}),
    [](const auto& each) { return each.param.name; });

TEST(CoreFiles, HaveTheModulesName) {
  const std::vector<host::File> files = files_of({.bits = {12, 1, 7, 0, 12, 0}}, "tracer");
  for (const host::File& file : files) {
    EXPECT_THAT(file.name, testing::AnyOf(HasSubstr("tracer"), "tb/Makefile"));
    EXPECT_EQ(rtl::times(file.contents, "core_module"), 0) << file.name;
  }
  const auto is_manifest = [](const host::File& file) { return file.name == "tracer.json"; };
  const auto manifest =
      nlohmann::json::parse(std::find_if(files.begin(), files.end(), is_manifest)->contents);
  EXPECT_EQ(manifest["module"], "tracer");
  EXPECT_EQ(manifest["axi"]["module"], "tracer_axi");
  EXPECT_EQ(manifest["parts"].size(), 11U);
}

/// det is -4096, u 2048 and v -1024, and origins are twice as fine as corners.
TEST(CoreHeader, GivesWeightsAndSigns) {
  const host::ScratchFolder folder("core-header");
  host::write_files(folder.path(), files_of({.bits = {12, 1, 7, 0, 12, 0}, .weights = true}));
  host::write_files(folder.path(), {{"weights.c", R"(#include "core.h"
int main(void) {
  uint8_t bytes[CORE_HIT_BYTES];
  memset(bytes, 0xff, sizeof bytes);
  struct core_hit hit;
  core_unpack_hit(&hit, bytes);
  if (hit.det_high != -1 || hit.u_high != -1 || hit.v_high != -1) return 1;
  hit.det_high = hit.v_high = -1;
  hit.det_low = (1 << 18) - 4096;
  hit.u_high = 0;
  hit.u_low = 2048;
  hit.v_low = (1 << 19) - 1024;
  double weight_1, weight_2;
  core_weights(&hit, &weight_1, &weight_2);
  return weight_1 == 0.25 && weight_2 == 0.125 ? 0 : 2;
}
)"}});
  const rtl::ToolResult built =
      rtl::run_tool(folder.path(), "g++", "g++", "-x c -Wall -Wextra -o weights weights.c -lm");
  ASSERT_EQ(built.status, 0) << built.output;
  EXPECT_EQ(built.output, "");
  EXPECT_EQ(rtl::run_tool(folder.path(), "g++", "./weights", "").status, 0);
}

TEST(Core, RefusesOptions) {
  const auto said = [](const rtl::CoreOptions& options) {
    return message_of<std::runtime_error>([&] { (void)rtl::make_core(options, library()); });
  };
  EXPECT_EQ(said({.rays = 257}), "rays in flight 257: allowed is 1 to 256");
  EXPECT_EQ(said({.address_bits = 28}), "bits of an address 32: allowed is 33 to 64");
  EXPECT_EQ(said({.number_bits = 3}), "bits of a triangle's number 3: allowed is 4 to 32");
  EXPECT_EQ(said({.leaf_bits = 9}), "bits of the number of triangles in a leaf 9: allowed is 2 to 8");
  EXPECT_EQ(said({.step_bits = 21}), "bits of the number of steps 21: allowed is 4 to 20");
  EXPECT_EQ(said({.triangle_interval = 2}), "cycles from triangle to triangle 2: allowed is 3 to 64");
  EXPECT_THAT(said({.serial_triangle = true, .weights = true}), HasSubstr("not with the serial test"));
  EXPECT_THAT(said({.bits = {25, 1, 11, 0, 20, 0}}), HasSubstr("core: there is no format 25+1/11s20"));
}

}  // namespace
}  // namespace hitpipe::sim::core_files_test
