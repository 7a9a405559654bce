// The memory of rays before a unit: which operands it holds, that tools take it, that its memories become
// block RAM, and that manifest and core file tell of it. tests/sim/cosim/ray_slots_test.cpp runs it.
#include "rtl_gen/emit/ray_slots.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/emit/wrapper.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::ray_slots_test {
namespace {

using testing::HasSubstr;

RaySlots slots_of(const DesignFormat& d, int least) {
  return ray_slots(d.interface(), d.found().ports(d.parsed()), least);
}

std::string names_of(const std::vector<Port>& ports) {
  std::string text;
  for (const Port& port : ports) text += (text.empty() ? "" : " ") + port.name;
  return text;
}

TEST(RaySlotsOperands, FollowFromRoles) {
  const struct {
    const char *design, *format, *line, *end, *test;
  } cases[] = {
      {"int_slabs", "20/24", "irx iry irz iri_floor iri_ceil irj_floor irj_ceil irk_floor irk_ceil",
       "irlen rinf", "ixmin ixmax iymin iymax izmin izmax"},
      {"int_plucker", "20/24", "irx iry irz iri irj irk", "irex irey irez rinf",
       "ixmin ixmax iymin iymax izmin izmax"},
      {"int_major", "20+1/13",
       "major_y major_z back_m back_a back_b origin_m origin_a origin_b floor_a ceil_a floor_b ceil_b exp_a "
       "exp_b",
       "len", "xmin xmax ymin ymax zmin zmax"},
      {"int_major_pair", "20+1/13",
       "major_y major_z back_m back_a back_b origin_m origin_a origin_b floor_a ceil_a floor_b ceil_b exp_a "
       "exp_b",
       "",
       "parent_near parent_far xmin xmax ymin ymax zmin zmax own_xmin own_xmax own_ymin own_ymax own_zmin "
       "own_zmax"}};
  for (const auto& [design, format, line, end, test] : cases) {
    const RaySlots slots = slots_of({design, format}, 64);
    EXPECT_EQ(names_of(slots.line), line);
    EXPECT_EQ(names_of(slots.end), end);
    EXPECT_EQ(names_of(slots.test), test);
  }
}

TEST(RaySlotsOperands, OnlyItsOwnSetUpKnowsWhatAnotherOperandIs) {
  const std::vector<Port> ports{{.name = "a", .width = 4, .is_signed = false, .role = hls::Role::origin},
                                {.name = "b", .width = 4, .is_signed = false}};
  EXPECT_EQ(sent_with(ports), (std::vector{SentWith::line, SentWith::test}));
}

TEST(RaySlotsBits, CountSlotAndOperands) {
  const RaySlots slots = slots_of({"int_slabs", "20/24"}, 64);
  // Origin and six bounds, length and flag, six planes.
  EXPECT_EQ(slots.bits_without(), 9 * 20 + 24 + 1 + 6 * 20);
  EXPECT_EQ(slots.bits_of_test(), 6 + 6 * 20);
  EXPECT_EQ(slots.bits_of_ray(), 6 + 1 + 9 * 20 + 24 + 1);
  EXPECT_EQ(slots.bits_of_end(), 6 + 1 + 24 + 1);
  const RaySlots pair = slots_of({"int_major_pair", "20+1/13"}, 64);
  EXPECT_EQ(pair.bits_of_end(), 0);
  EXPECT_EQ(pair.bits_of_ray() + pair.bits_of_test(), pair.bits_without() + 2 * 6);
}

TEST(RaySlotsNumber, IsRoundedUpToAPowerOfTwo) {
  const DesignFormat d{"int_slabs", "6/6"};
  for (const auto& [least, slots] :
       {std::pair{2, 2}, {3, 4}, {4, 4}, {33, 64}, {64, 64}, {65, 128}, {65'536, 65'536}})
    EXPECT_EQ(slots_of(d, least).slots(), slots) << least;
  for (const int wrong : {-1, 0, 1, 65'537}) {
    EXPECT_EQ(message_of([&] { return slots_of(d, wrong); }),
              fmt::format("{} ray slots: allowed is 2 to 65536", wrong));
  }
}

TEST(RaySlotsRefusals, SayWhatIsMissingOrTaken) {
  const Port origin{.name = "ro", .width = 4, .is_signed = false, .role = hls::Role::origin};
  const Port plane{.name = "in_slot", .width = 4, .is_signed = false, .role = hls::Role::plane_low};
  const auto four_slots = [](const std::vector<Port>& ports) {
    return ray_slots(unit_interface("unit", ports, {{"hit", 1, false}}, FlowControl::stall), ports, 4);
  };
  const auto refusal = [&](const std::vector<Port>& ports) {
    return message_of([&] { return four_slots(ports); });
  };
  EXPECT_EQ(refusal({origin, plane}), "unit: its port in_slot has the name of one of unit_slots");
  Port renamed = plane;
  renamed.name = "low";
  EXPECT_EQ(refusal({renamed}),
            "unit: none of its operands says where a ray lies, so slots would hold nothing of it");
  EXPECT_EQ(four_slots({origin, renamed}).slots(), 4);
}

TEST(RaySlotsLint, IsSilent) {
  for (const int slots : {2, 64}) {
    const ScratchFolder folder;
    std::vector<std::vector<std::string>> modules;
    for (const DesignFormat& d : every_design({"20/24"})) {
      host::write_files(folder.path(), d.emitted({.ray_slots = slots}).files());
      modules.push_back({d.module() + "_slots", d.module()});
    }
    expect_silent_tools(folder.path(), modules, "; select -assert-none t:$dlatch");
  }
}

class RaySlotsOfDesign : public testing::TestWithParam<DesignFormat> {};

TEST_P(RaySlotsOfDesign, LeavesTheUnitAndTellsOfItself) {
  const std::string design = GetParam().module();
  const EmittedDesign with = GetParam().emitted({.ray_slots = 33});
  expect_only_wrapper_added(GetParam().emitted(), with, "_slots", "ray_slots");
  const Json& slots = with.manifest->at("ray_slots");
  const std::string& core = with.core.contents;
  EXPECT_EQ(slots.at("module"), design + "_slots");
  EXPECT_EQ(slots.at("file"), with.ray_slots.value().name);
  EXPECT_EQ(slots.at("slots"), 64);
  EXPECT_EQ(slots.at("latency"), with.manifest->at("latency").get<int>() + 1);
  const RaySlots expected = slots_of(GetParam(), 64);
  EXPECT_EQ(slots.at("bits").at("test"), expected.bits_of_test());
  EXPECT_EQ(slots.at("bits").at("ray"), expected.bits_of_ray());
  EXPECT_EQ(slots.at("bits").contains("end_only"), !expected.end.empty());
  // The Verilog has these ports. The memories hold all operands that a test does not send.
  const std::string& verilog = with.ray_slots.value().contents;
  const std::string head = verilog.substr(0, verilog.find(");"));
  for (const auto& port : slots.at("ports")) {
    const bool in = port.at("direction") == "in";
    const std::string width = port.at("width").is_string() ? std::string(tag_range) + " "
                                                           : vector_range(port.at("width").get<int>());
    const std::string sign = port.at("signed").get<bool>() ? "signed " : "";
    EXPECT_THAT(head, HasSubstr(fmt::format("\n  {} wire {}{}{}", in ? "input " : "output", sign, width,
                                            port.at("name").get<std::string>())));
  }
  EXPECT_EQ(slots.at("ports").size(), times(head, "put "));
  int memory_bits = 0;
  for (const auto& memory : slots.at("memories")) {
    EXPECT_EQ(memory.at("words"), 64);
    EXPECT_EQ(memory.at("bits"), 64 * memory.at("width").get<int>());
    memory_bits += memory.at("bits").get<int>();
  }
  EXPECT_EQ(memory_bits, 64 * (expected.bits_without() - expected.bits_of_test() + expected.slot_bits));
  EXPECT_THAT(core, HasSubstr("  slots:\n    files: [" + design + "_slots.v]\n"));
  EXPECT_THAT(core, HasSubstr("filesets: [rtl, slots]\n    toplevel: " + design + "_slots\n"));
}

INSTANTIATE_TEST_SUITE_P(Designs, RaySlotsOfDesign, testing::ValuesIn(every_small_design()), design_suffix);

/// What Yosys prints of the wrapper with 256 slots after a target's steps up to `until`. The unit is a black
/// box. Beside block RAM the box, the tag and one valid bit have registers, and nothing else has.
ToolResult mapped(const ScratchFolder& folder, const RaySlots& slots, const char* target, const char* until,
                  const char* rams) {
  const int registers = slots.bits_of_test() - slots.slot_bits + 16 + 1;
  return run_tool(
      folder.path(), "yosys", "yosys",
      fmt::format("-q -p 'read_verilog -lib {0}.v; read_verilog {1}.v; synth_{2} -run :{3} -top {1}; "
                  "simplemap t:$*dff* t:$*sdff*; select -assert-any {4}; "
                  "select -assert-none t:$mem* t:TRELLIS_DPR* t:RAM32* t:RAM64*; "
                  "select -assert-max {5} t:$_*DFF*_'",
                  slots.unit.module, slots.module(), target, until, rams, registers));
}

struct Target {
  const char *name, *until, *rams;
};
const Target targets[] = {{"ice40", "map_gates", "t:SB_RAM40_4K"},
                          {"ecp5", "map_gates", "t:DP16KD t:PDPW16KD"},
                          {"xilinx", "fine", "t:RAMB18E1 t:RAMB36E1"}};

TEST(RaySlotsInYosys, MemoriesAndTheirReadRegistersBecomeBlockRam) {
  const DesignFormat d{"int_slabs", "20/24"};
  const ScratchFolder folder;
  host::write_files(folder.path(), d.emitted({.ray_slots = 256}).files());
  for (const auto& [target, until, rams] : targets) {
    const ToolResult result = mapped(folder, slots_of(d, 256), target, until, rams);
    EXPECT_EQ(result.status, 0) << target << ": " << result.output;
  }
}

/// Without the wait a chip may read anything there, so Yosys adds registers that keep the old ray.
TEST(RaySlotsInYosys, ReadBesideAWriteWouldCostRegisters) {
  const DesignFormat d{"int_slabs", "20/24"};
  const ScratchFolder folder;
  host::write_files(folder.path(), d.emitted({.ray_slots = 256}).files());
  damage(folder / "int_slabs_slots.v", " & ~(written & (ray_slot == in_slot))", "");
  const auto& [target, until, rams] = targets[1];
  EXPECT_NE(mapped(folder, slots_of(d, 256), target, until, rams).status, 0);
}

}  // namespace
}  // namespace hitpipe::rtl::ray_slots_test
