// The folder tb in Icarus, in Verilator and as a C++ program: each target of its Makefile passes, and fails
// with a line and an exit code when the vectors or the Verilog are damaged.
#include <functional>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/emit/two_boxes.hpp"
#include "tests/rtl_gen/emit/vector_lines.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::simulators_test {
namespace {

using testing::HasSubstr;

/// A design with several results, one of them a signed number. It is written and compiled once for all tests,
/// in a folder whose name a shell would misread.
const std::filesystem::path& unit_folder() {
  static const ScratchFolder folder("it's-a-$folder-with-\"words\"-");
  static const bool written = [] {
    const Design design = two_boxes();
    const Pipeline pipeline = make_pipeline(design.trace(design.default_format), Library::thesis());
    host::write_files(folder.path(),
                      emit(make_unit(design, design.default_format, Library::thesis(), pipeline)).files());
    return true;
  }();
  static_cast<void>(written);
  return folder.path();
}

/// Changes a file until the end of its scope.
class Damaged {
 public:
  Damaged(const char* name, const std::function<std::string(std::string)>& change)
      : file_(unit_folder() / name), original_(read_text(file_)) {
    const std::string changed = change(original_);
    EXPECT_NE(changed, original_);
    write_text(file_, changed);
  }
  Damaged(const Damaged&) = delete;
  Damaged& operator=(const Damaged&) = delete;
  ~Damaged() { write_text(file_, original_); }

 private:
  std::filesystem::path file_;
  std::string original_;
};

constexpr const char* vectors_file = "tb/two_boxes_vectors.hex";

std::string with_digit(std::string text, std::size_t at, char digit) {
  text[at] = digit;
  return text;
}

/// Runs a target of the Makefile. What the C++ compiler can leave out, it does; Verilator's own code is
/// compiled once.
ToolResult simulated(const std::string& target) {
  return run_tool(unit_folder(), "make", "make",
                  "-C tb " + target +
                      " OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0 OBJCACHE='sh " HITPIPE_SOURCE
                      "/tests/rtl_gen/emit/kept_object.sh'");
}

/// A target of the Makefile, what it builds and runs, a damage of the Verilog, and what the target then says.
struct Target {
  const char *target, *program, *good, *bad, *verdict;
};
void PrintTo(const Target& target, std::ostream* out) {
  *out << target.target;
}

class Simulator : public testing::TestWithParam<Target> {
 protected:
  static ToolResult made() { return simulated(GetParam().target); }
  /// Only runs what was made, which reads the vectors.
  static ToolResult replayed() { return run_tool(unit_folder() / "tb", "", GetParam().program, ""); }

  static void expect_pass(const ToolResult& result) {
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT("\n" + result.output, HasSubstr("\nPASS 1000 vectors\n"));
    EXPECT_THAT(result.output, Not(HasSubstr("%Warning")));
  }
  static void expect_failure(const ToolResult& result, const std::string& line) {
    EXPECT_NE(result.status, 0);
    EXPECT_THAT("\n" + result.output, HasSubstr("\nFAIL " + line));
    EXPECT_THAT(result.output, Not(HasSubstr("PASS")));
  }
};

TEST_P(Simulator, PassesOnTheEmittedUnit) {
  expect_pass(made());
}

TEST_P(Simulator, TakesComments) {
  const Damaged commented(vectors_file, [](const std::string& text) {
    return "// " + std::string(500, '-') + "\n\n// two\n" + text;
  });
  expect_pass(made());
}

TEST_P(Simulator, FailsWithoutItsVectors) {
  const std::filesystem::path file = unit_folder() / vectors_file;
  const std::filesystem::path away = unit_folder() / "away";
  std::filesystem::rename(file, away);
  expect_failure(made(), "two_boxes_vectors.hex: cannot be opened\n");
  std::filesystem::rename(away, file);
}

TEST_P(Simulator, FailsOnADamagedVectorFile) {
  const std::string text = read_text(unit_folder() / vectors_file);
  const std::size_t at = place_of_vector(text, 4);
  const std::size_t last = place_of_vector(text, 999);
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  const std::string bad_line =
      fmt::format("two_boxes_vectors.hex, line {}: not 13 lower-case hexadecimal digits of 50 bits\n", line);
  ASSERT_EQ(text.find('\n', at) - at, 13U);
  const struct {
    const char* what;
    std::string text, line;
  } damages[] = {
      {"empty", "", "two_boxes_vectors.hex: 0 vectors, expected 1000\n"},
      {"one too few", text.substr(0, last), "two_boxes_vectors.hex: 999 vectors, expected 1000\n"},
      {"one too many", text + text.substr(last), "two_boxes_vectors.hex: 1001 vectors, expected 1000\n"},
      {"cut in a line", text.substr(0, at + 5), bad_line},
      {"a digit too many", replaced(text, text.substr(at), "0" + text.substr(at)), bad_line},
      {"a digit too few", replaced(text, text.substr(at), text.substr(at + 1)), bad_line},
      {"51 bits", with_digit(text, at, '4'), bad_line},
      {"an unknown digit", with_digit(text, at + 6, 'x'), bad_line},
      {"no digit", with_digit(text, at + 6, 'g'), bad_line},
  };
  expect_pass(made());
  for (const auto& damage : damages) {
    SCOPED_TRACE(damage.what);
    const Damaged damaged(vectors_file, [&](const std::string&) { return damage.text; });
    expect_failure(replayed(), damage.line);
  }
}

TEST_P(Simulator, FailsOnEveryWrongResult) {
  expect_pass(made());
  for (const int vector : {0, 999}) {
    // hit_b, hit_a, the lowest bit of entry, its sign.
    for (const int bit : {0, 1, 2, 7}) {
      const Damaged damaged(vectors_file,
                            [&](const std::string& good) { return with_bit_inverted(good, vector, bit); });
      expect_failure(replayed(), fmt::format("vector {} (", vector));
    }
  }
}

TEST_P(Simulator, FailsOnDamagedVerilog) {
  const Damaged damaged(
      "two_boxes.v", [](const std::string& text) { return replaced(text, GetParam().good, GetParam().bad); });
  expect_failure(made(), GetParam().verdict);
}

// Each build by Verilator takes seconds: one damage each, and the harness is what is built with waves.
INSTANTIATE_TEST_SUITE_P(Targets, Simulator,
                         testing::Values(Target{"icarus", "vvp -n build/icarus_two_boxes",
                                                "min_b_s0 - irx_s0", "min_b_s0 + irx_s0", "vector "},
                                         Target{"verilator", "build/tb_two_boxes/Vtwo_boxes_tb",
                                                "min_b_s0 - irx_s0", "min_b_s0 + irx_s0", "vector "},
                                         Target{"harness WAVES=vcd", "build/harness_two_boxes_vcd/Vtwo_boxes",
                                                "assign out_valid = ", "assign out_valid = rst & ",
                                                "0 of 1000 vectors came back\n"}),
                         [](const auto& parameter) {
                           const std::string target = parameter.param.target;
                           return target.substr(0, target.find(' '));
                         });

/// With this one Verilator's own code answers in place of the harness.
TEST(SimulatorFolder, HarnessTakesVerilatorsArguments) {
  EXPECT_EQ(simulated("harness WAVES=vcd").status, 0);
  const ToolResult result =
      run_tool(unit_folder() / "tb", "", "build/harness_two_boxes_vcd/Vtwo_boxes", "+verilator+help");
  EXPECT_THAT(result.output, HasSubstr("Exiting due to command line argument"));
}

TEST(SimulatorFolder, WritesWaves) {
  const struct {
    const char *target, *file;
  } waves[] = {{"waves", "two_boxes.vcd"},
               {"waves WAVES=fst", "two_boxes.fst"},
               {"harness WAVES=vcd", "two_boxes.vcd"}};
  for (const auto& [target, name] : waves) {
    const std::filesystem::path file = unit_folder() / "tb" / name;
    std::filesystem::remove(file);
    const ToolResult result = simulated(target);
    EXPECT_EQ(result.status, 0) << result.output;
    ASSERT_TRUE(std::filesystem::exists(file)) << target;
    EXPECT_GT(std::filesystem::file_size(file), 10'000U) << target;
  }
}

TEST(SimulatorFolder, WavesOfAnUnknownFormatRejected) {
  const ToolResult result = run_tool(unit_folder(), "make", "make", "-C tb icarus WAVES=png");
  EXPECT_NE(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("WAVES=png: allowed are vcd and fst"));
}

/// The build is elsewhere then, until `make clean`.
TEST(SimulatorFolder, TakesABlankInItsName) {
  const ScratchFolder above("two words-");
  const std::filesystem::path unit = above / "it's a $unit";
  std::filesystem::copy(unit_folder(), unit, std::filesystem::copy_options::recursive);
  std::filesystem::remove_all(unit / "tb/build");
  for (const std::string target : {"icarus", "verilator", "harness"}) {
    const ToolResult result = run_tool(unit, "make", "make", "-C tb " + target);
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("\nPASS 1000 vectors\n")) << target;
  }
  EXPECT_FALSE(std::filesystem::exists(unit / "tb/build"));
  EXPECT_EQ(run_tool(unit, "make", "make", "-C tb clean").status, 0);
}

TEST(SimulatorFolder, TakesSeveralUnitsAndCleansUp) {
  const ScratchFolder folder;
  for (const DesignFormat& d : {DesignFormat{"fp_slabs", "fp32"}, DesignFormat{"int_slabs", "20/24"}})
    host::write_files(folder.path(), d.emitted().files());
  const auto passes = [&](const std::string& arguments) {
    return times(run_tool(folder.path(), "make", "make", "-C tb " + arguments).output, "PASS");
  };
  EXPECT_EQ(passes("icarus"), 2);
  EXPECT_EQ(passes("waves UNITS=int_slabs"), 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "tb/build"));
  EXPECT_EQ(passes("clean"), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "tb/build"));
  EXPECT_FALSE(std::filesystem::exists(folder / "tb/int_slabs.vcd"));
}

// More warnings than Verilator's own makefile asks for; with FST too.
TEST(SimulatorFolder, HarnessCompilesWithoutAWarning) {
  for (const bool fst : {false, true}) {
    const ToolResult verilated =
        run_tool(unit_folder(), "verilator", "verilator",
                 std::string("--cc -Mdir lint_harness --top-module two_boxes two_boxes.v") +
                     (fst ? " --trace-fst" : ""));
    ASSERT_EQ(verilated.status, 0) << verilated.output;
    const ToolResult compiled =
        run_tool(unit_folder(), "g++", "c++",
                 std::string("-std=c++14 -fsyntax-only -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow "
                             "-isystem $(verilator --getenv VERILATOR_ROOT)/include -isystem lint_harness "
                             "tb/two_boxes_harness.cpp") +
                     (fst ? " -DVM_TRACE=1 -DVM_TRACE_FST=1" : ""));
    EXPECT_EQ(compiled.status, 0);
    EXPECT_EQ(compiled.output, "");
  }
}

}  // namespace
}  // namespace hitpipe::rtl::simulators_test
