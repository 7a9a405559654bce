// Everything that is emitted, read as the strictest tools read it (Icarus from 13 on, Verilator from 5.04):
// each name is declared above its first use, and no two names of a module differ in case alone.
#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/board/top.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/emit/machine_files.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/verilog_names.hpp"

namespace hitpipe::rtl::emitted_names_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// How many Verilog files there were.
std::size_t expect_good_names(const std::vector<host::File>& files) {
  std::size_t count = 0;
  for (const host::File& file : files) {
    if (!file.name.ends_with(".v") && !file.name.ends_with(".sv")) continue;
    ++count;
    EXPECT_THAT(faulty_names(file.contents), IsEmpty()) << file.name;
  }
  return count;
}

TEST(FaultyNames, SeesAUseAboveADeclaration) {
  EXPECT_THAT(faulty_names("module m (input wire a, output wire b);\n  wire c = d;\n  reg [3:0] e, d;\n"
                           "  assign b = c & a; // f\nendmodule\n"),
              ElementsAre("m: d is used above its declaration"));
  EXPECT_THAT(faulty_names("module m #(parameter N = 1) (input wire [N-1:0] a);\n  x x_i (.p(late));\n"
                           "  wire late;\nendmodule\nmodule n (input wire late);\nendmodule\n"),
              ElementsAre("m: late is used above its declaration"));
  EXPECT_THAT(faulty_names("module m;\n  reg [W-1:0] r;\n  localparam W = 3;\nendmodule\n"),
              ElementsAre("m: W is used above its declaration"));
}

TEST(FaultyNames, SeesNamesThatDifferInCaseAlone) {
  EXPECT_THAT(faulty_names("module m;\n  localparam integer FULL = 3;\n  reg full;\nendmodule\n"
                           "module n;\n  reg Full;\nendmodule\n"),
              ElementsAre("m: FULL and full differ in case alone"));
}

TEST(FaultyNames, CommentsStringsNumbersAndPinsAreNoUses) {
  EXPECT_THAT(faulty_names("module m;\n  // late\n  /* late */ initial $display(\"late \\\" late\");\n"
                           "  x x_i (.late(1'b0));\n  wire [3:0] y = 4'hbad;\n  reg late, bad;\nendmodule\n"),
              IsEmpty());
}

/// Small formats have all that large ones have, and are scheduled in a tenth of the time.
std::vector<DesignFormat> small_designs() {
  return every_small_design();
}

/// The thesis's is the last.
std::vector<Library> every_library() {
  std::vector<Library> all;
  for (const std::string& name : built_in_names())
    if (name != default_library) all.push_back(library_called(name));
  all.push_back(Library::thesis());
  return all;
}

/// Units that take a test every few cycles have shared components. Scheduling is dear, so a design meets one
/// library at each interval, and the next design another one. Of a design that has no small format it is the
/// thesis's, which needs the least time.
TEST(EmittedNames, OfUnitsAtSeveralIntervals) {
  const std::vector<Library> libraries = every_library();
  const std::vector<DesignFormat> designs = small_designs();
  std::size_t files = 0, shared = 0;
  for (std::size_t place = 0; place < designs.size(); ++place) {
    const DesignFormat& d = designs[place];
    const Graph graph = d.found().trace(d.parsed());
    const bool is_large = d.parsed().family().single;
    for (const int interval : {1, 2, 3, 8}) {
      const Library& library =
          is_large ? libraries.back()
                   : libraries[(place + static_cast<std::size_t>(interval)) % libraries.size()];
      const Pipeline pipeline = make_pipeline(graph, library, {}, interval);
      files += expect_good_names(
          {{fmt::format("{} {} {}.v", d.module(), library.name(), interval), to_verilog(pipeline, library)}});
      for (const Register& r : pipeline.placement.registers) shared += r.is_shared() ? 1 : 0;
    }
  }
  EXPECT_EQ(files, 4 * designs.size());
  EXPECT_GT(shared, 100U);
}

/// With every wrapper and its testbench.
TEST(EmittedNames, OfWrappersAndTestbenches) {
  std::size_t files = 0;
  for (const DesignFormat& d : small_designs()) {
    const Graph graph = d.found().trace(d.parsed());
    for (const int interval : {1, 3}) {
      const Pipeline pipeline = make_pipeline(graph, Library::thesis(), {}, interval);
      for (const FlowControl flow : {FlowControl::stall, FlowControl::none})
        files += expect_good_names(
            emit(make_unit(d.found(), d.parsed(), Library::thesis(), pipeline, {.flow_control = flow}),
                 {.axi_stream = true, .fifo = flow == FlowControl::none})
                .files());
    }
    const Pipeline pipeline = d.pipeline();
    const ModuleInterface unit = d.interface();
    files += expect_good_names(
        {{"board.v", board_top(board_unit(d.found(), d.parsed(), d.module(), pipeline), 104)}});
  }
  EXPECT_GT(files, 100U);
}

TEST(EmittedNames, OfMachines) {
  std::size_t files = 0;
  for (const Machine& machine : machines())
    files +=
        expect_good_names(machine_files(machine, machine.default_format, Library::thesis(), {.cycles = 20}));
  EXPECT_EQ(files, 2 * machines().size());
}

/// The modules of a core, its wrapper and its testbench.
TEST(EmittedNames, OfCores) {
  const auto bits = parse_bits<hls::RayBits>("8+0/4s8");
  std::vector<CoreOptions> options{{.bits = bits, .serial_triangle = true},
                                   {.bits = bits, .float_door = true, .weights = true},
                                   {.bits = bits, .data_bits = 64}};
  for (const int interval : {CoreOptions::least_triangle_interval, 4, 8, 16})
    options.push_back({.bits = bits, .triangle_interval = interval});
  const std::vector<Library> libraries = every_library();
  std::size_t files = 0;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const Library& library = libraries[i % libraries.size()];
    files += expect_good_names(core_files(make_core(options[i], library), library, {}));
  }
  EXPECT_EQ(files, 3 * options.size());
}

}  // namespace
}  // namespace hitpipe::rtl::emitted_names_test
