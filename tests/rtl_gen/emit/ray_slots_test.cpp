// The memory of rays before a unit: which operands it holds, that tools take it, that its memories become
// block RAM, and that manifest and core file tell of it. tests/sim/ray_slots_test.cpp runs it.
#include "rtl_gen/emit/ray_slots.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
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
    EXPECT_EQ(message_of<std::runtime_error>([&] { (void)slots_of(d, wrong); }),
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
    return message_of<std::runtime_error>([&] { (void)four_slots(ports); });
  };
  EXPECT_EQ(refusal({origin, plane}), "unit: its port in_slot has the name of one of unit_slots");
  Port renamed = plane;
  renamed.name = "low";
  EXPECT_EQ(refusal({renamed}),
            "unit: none of its operands says where a ray lies, so slots would hold nothing of it");
  EXPECT_EQ(four_slots({origin, renamed}).slots(), 4);
}

std::vector<File> emitted(const DesignFormat& d, int slots) {
  return emit(d.found(), d.parsed(), Library::thesis(), d.pipeline(), {.ray_slots = slots}).files();
}

TEST(RaySlotsRefusals, TwoWrappersAtOnce) {
  const DesignFormat d{"int_slabs", "6/6"};
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              (void)emit(d.found(), d.parsed(), Library::thesis(), d.pipeline(),
                         {.axi_stream = true, .ray_slots = 4});
            }),
            "AXI4-Stream and ray slots: a unit has one wrapper or the other");
}

TEST(RaySlotsLint, IsSilent) {
  for (const int slots : {2, 64}) {
    const ScratchFolder folder;
    std::vector<std::vector<std::string>> modules;
    for (const DesignFormat& d : every_design({"20/24"})) {
      host::write_files(folder.path(), emitted(d, slots));
      modules.push_back({d.design + "_slots", d.design});
    }
    expect_silent_tools(folder.path(), modules, "; select -assert-none t:$dlatch");
  }
}

class RaySlotsOfDesign : public testing::TestWithParam<DesignFormat> {};

TEST_P(RaySlotsOfDesign, LeavesTheUnitAndTellsOfItself) {
  const std::string& design = GetParam().design;
  nlohmann::json with;
  std::string core;
  std::map<std::string, std::string> files;
  for (const File& file : emitted(GetParam(), 33)) files[file.name] = file.contents;
  const EmittedDesign bare =
      emit(GetParam().found(), GetParam().parsed(), Library::thesis(), GetParam().pipeline());
  for (const File& file : bare.files()) {
    const bool speaks_of_it = file.name == bare.core.name || file.name == bare.manifest_file().name;
    EXPECT_EQ(files.at(file.name) == file.contents, !speaks_of_it) << file.name;
  }
  nlohmann::json manifest = nlohmann::json::parse(files.at(bare.manifest_file().name));
  const nlohmann::json slots = manifest.at("ray_slots");
  manifest.erase("ray_slots");
  nlohmann::json without = nlohmann::json::parse(bare.manifest_file().contents);
  auto& all = without.at("files");
  all.insert(all.begin() + 7, design + "_slots.v");
  EXPECT_EQ(manifest, without);
  EXPECT_EQ(slots.at("module"), design + "_slots");
  EXPECT_TRUE(files.contains(slots.at("file")));
  EXPECT_EQ(slots.at("slots"), 64);
  EXPECT_EQ(slots.at("latency"), manifest.at("latency").get<int>() + 1);
  const RaySlots expected = slots_of(GetParam(), 64);
  EXPECT_EQ(slots.at("bits").at("test"), expected.bits_of_test());
  EXPECT_EQ(slots.at("bits").at("ray"), expected.bits_of_ray());
  EXPECT_EQ(slots.at("bits").contains("end_only"), !expected.end.empty());
  // The ports are those of the Verilog, and the memories hold what is neither handshake nor test.
  const std::string& verilog = files.at(slots.at("file"));
  const std::string head = verilog.substr(0, verilog.find(");"));
  std::size_t lines = 0;
  for (const auto& port : slots.at("ports")) {
    const bool in = port.at("direction") == "in";
    std::string width = " ";
    if (port.at("width").is_string()) width = " [TAG_BITS-1:0] ";
    if (port.at("width").is_number() && port.at("width") > 1)
      width = fmt::format(" [{}:0] ", port.at("width").get<int>() - 1);
    EXPECT_THAT(head, HasSubstr(fmt::format("\n  {}{}{}", in ? "input  wire" : "output wire", width,
                                            port.at("name").get<std::string>())));
    ++lines;
  }
  EXPECT_EQ(lines,
            static_cast<std::size_t>(std::count(head.begin(), head.end(), ',')) + 1 -
                static_cast<std::size_t>(std::count(head.begin(), head.begin() + head.find("module"), ',')));
  int memory_bits = 0;
  for (const auto& memory : slots.at("memories")) {
    EXPECT_EQ(memory.at("words"), 64);
    EXPECT_EQ(memory.at("bits"), 64 * memory.at("width").get<int>());
    memory_bits += memory.at("bits").get<int>();
  }
  EXPECT_EQ(memory_bits, 64 * (expected.bits_without() - expected.bits_of_test() + expected.slot_bits));
  EXPECT_THAT(files.at(bare.core.name), HasSubstr("  slots:\n    files: [" + design + "_slots.v]\n"));
  EXPECT_THAT(files.at(bare.core.name),
              HasSubstr("filesets: [rtl, slots]\n    toplevel: " + design + "_slots\n"));
}

INSTANTIATE_TEST_SUITE_P(Designs, RaySlotsOfDesign, testing::ValuesIn(every_design({"20/24"})),
                         design_suffix);

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
  host::write_files(folder.path(), emitted(d, 256));
  for (const auto& [target, until, rams] : targets) {
    const ToolResult result = mapped(folder, slots_of(d, 256), target, until, rams);
    EXPECT_EQ(result.status, 0) << target << ": " << result.output;
  }
}

/// Without the wait a chip may read anything there, so Yosys adds registers that keep the old ray.
TEST(RaySlotsInYosys, ReadBesideAWriteWouldCostRegisters) {
  const DesignFormat d{"int_slabs", "20/24"};
  const ScratchFolder folder;
  host::write_files(folder.path(), emitted(d, 256));
  const std::string wait = " & ~(written & (ray_slot == in_slot))";
  std::string text = read_text(folder / "int_slabs_slots.v");
  const std::size_t at = text.find(wait);
  ASSERT_NE(at, std::string::npos);
  write_text(folder / "int_slabs_slots.v", text.erase(at, wait.size()));
  const auto& [target, until, rams] = targets[1];
  EXPECT_NE(mapped(folder, slots_of(d, 256), target, until, rams).status, 0);
}

}  // namespace
}  // namespace hitpipe::rtl::ray_slots_test
