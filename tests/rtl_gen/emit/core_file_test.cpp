// The FuseSoC core file: YAML that names existing files. Its targets work when a script does with them what
// FuseSoC does.
#include "rtl_gen/emit/core_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::core_file_test {
namespace {

using Json = nlohmann::json;

struct Placed {
  std::string name, type;
};

class CoreFile : public testing::TestWithParam<DesignFormat> {
 protected:
  /// Writes the design and reads its core file with a YAML parser.
  void read_core(bool axi_stream) {
    read_core_of(emit(GetParam().found(), GetParam().parsed(), Library::thesis(), GetParam().pipeline(),
                      {.axi_stream = axi_stream}));
  }
  /// The core file of a fitted unit, whose demands include a fixed origin.
  void read_fitted_core() {
    const Graph traced = GetParam().found().trace(GetParam().parsed());
    const std::vector<Port> ports = input_ports(traced);
    const Demands demands = demand_sets(GetParam().found(), GetParam().parsed()).back().demands;
    const Pruned pruned = prune(traced, demands, {.shares = false});
    const PrunedFrom from{ports, demands, pruned.report};
    read_core_of(emit(GetParam().found(), GetParam().parsed(), Library::thesis(),
                      make_pipeline(pruned.graph, Library::thesis()), {.pruned_from = &from}));
  }
  void read_core_of(const EmittedDesign& emitted) {
    host::write_files(folder.path(), emitted.files());
    const std::string& file = emitted.core.name;
    const ToolResult result = run_tool(
        folder.path(), "python3-yaml", "python3",
        python_text(
            "import json, yaml; text = open(\"" + file +
            "\").read(); assert text.startswith(\"CAPI=2:\\n\"); print(json.dumps(yaml.safe_load(text)))"));
    ASSERT_EQ(result.status, 0) << result.output;
    core = Json::parse(result.output);
  }
  static std::string python_text(const std::string& program) { return "-c '" + program + "'"; }

  /// Copies a target's files to a work folder of its own, where FuseSoC would put them.
  std::vector<Placed> place(const std::string& target) {
    const std::filesystem::path root = folder / "work" / target;
    std::vector<Placed> placed;
    for (const Json& set : core.at("targets").at(target).at("filesets")) {
      const Json& fileset = core.at("filesets").at(set.get<std::string>());
      for (const Json& entry : fileset.at("files")) {
        const bool plain = entry.is_string();
        const std::string name = plain ? entry.get<std::string>() : entry.begin().key();
        const Json attributes = plain ? Json::object() : entry.begin().value();
        const std::string to = attributes.value("copyto", name);
        std::filesystem::create_directories((root / to).parent_path());
        std::filesystem::copy_file(folder / name, root / to);
        placed.push_back({to, attributes.value("file_type", fileset.value("file_type", ""))});
      }
    }
    return placed;
  }

  /// A target's Verilog files and top, as a tool's arguments.
  std::string sources(const std::string& target) {
    std::string list;
    for (const Placed& file : place(target)) {
      if (file.type == "verilogSource" || file.type == "systemVerilogSource") list += " " + file.name;
    }
    return list;
  }
  [[nodiscard]] std::string top(const std::string& target) const {
    return core.at("targets").at(target).at("toplevel");
  }
  [[nodiscard]] const Json& flow_options(const std::string& target) const {
    return core.at("targets").at(target).at("flow_options");
  }
  [[nodiscard]] std::string options(const std::string& target) const {
    const std::string tool = flow_options(target).at("tool");
    std::string list;
    for (const Json& option :
         flow_options(target).at(tool == "icarus" ? "iverilog_options" : "verilator_options"))
      list += option.get<std::string>() + " ";
    return list;
  }
  /// Verilator with a target's files, top and options, and with more options.
  void expect_lint_clean(const std::string& target, const std::string& more = "") {
    const std::string files = sources(target);
    const ToolResult result =
        run_tool(folder / "work" / target, "verilator", "verilator",
                 "--lint-only " + more + options(target) + "--top-module " + top(target) + files);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.output, "");
  }
  void expect_icarus_to_pass() {
    const std::string files = sources("sim");
    const std::filesystem::path root = folder / "work" / "sim";
    const ToolResult compiled =
        run_tool(root, "iverilog", "iverilog", options("sim") + "-o sim -s " + top("sim") + files);
    ASSERT_EQ(compiled.status, 0) << compiled.output;
    EXPECT_EQ(compiled.output, "");
    const ToolResult replay = run_tool(root, "iverilog", "vvp", "-n sim");
    EXPECT_EQ(replay.status, 0);
    EXPECT_THAT(replay.output, testing::HasSubstr("PASS 1000 vectors"));
  }

  ScratchFolder folder;
  Json core;
};

TEST_P(CoreFile, HasItsFilesetsAndTargets) {
  read_core(false);
  EXPECT_EQ(core.at("name"), "hitpipe:ray_box:" + GetParam().module() + ":" HITPIPE_VERSION);
  EXPECT_THAT(core.at("description").get<std::string>(), testing::EndsWith(" at " + GetParam().format));
  EXPECT_EQ(core.at("targets").size(), 7U);
  EXPECT_FALSE(core.at("filesets").contains("axis"));
  EXPECT_EQ(top("default"), GetParam().design);
  EXPECT_EQ(flow_options("lint").at("tool"), "verilator");
  EXPECT_EQ(flow_options("sim").at("tool"), "icarus");
  EXPECT_EQ(flow_options("sim_verilator").at("tool"), "verilator");
  EXPECT_EQ(flow_options("sim_verilator").at("mode"), "binary");
  EXPECT_EQ(flow_options("harness").at("tool"), "verilator");
  EXPECT_EQ(flow_options("harness").at("mode"), "cc");
  EXPECT_EQ(flow_options("synth").at("tool"), "yosys");
  EXPECT_EQ(flow_options("synth_vivado").at("pnr"), "none");
}

TEST_P(CoreFile, LintTargetIsSilentWithAndWithoutTheWrapper) {
  for (const bool axi_stream : {false, true}) {
    std::filesystem::remove_all(folder / "work");
    read_core(axi_stream);
    EXPECT_EQ(top("lint"), GetParam().design + (axi_stream ? "_axis" : ""));
    expect_lint_clean("lint");
  }
}

TEST_P(CoreFile, SimTargetPasses) {
  read_core(false);
  expect_icarus_to_pass();
}

TEST_P(CoreFile, VerilatorTargetsAreLintClean) {
  read_core(false);
  EXPECT_EQ(top("sim_verilator"), GetParam().design + "_tb");
  expect_lint_clean("sim_verilator", "--timing ");
  EXPECT_EQ(top("harness"), GetParam().design);
  expect_lint_clean("harness");
  EXPECT_TRUE(std::filesystem::exists(folder / "work/harness/tb" / (GetParam().design + "_harness.cpp")));
  EXPECT_TRUE(std::filesystem::exists(folder / "work/harness" / (GetParam().design + "_vectors.hex")));
}

TEST_P(CoreFile, OfAFittedUnitHasItsCheckModule) {
  read_fitted_core();
  EXPECT_THAT(core.at("description").get<std::string>(), testing::EndsWith(GetParam().format + ", fitted"));
  EXPECT_EQ(core.at("targets").size(), 8U);
  EXPECT_EQ(top("check"), GetParam().design + "_check");
  EXPECT_EQ(sources("check"), " " + GetParam().design + "_check.v");
  std::filesystem::remove_all(folder / "work");
  expect_lint_clean("check");
}

TEST_P(CoreFile, SimTargetOfAFittedUnitPassesWithItsChecksOn) {
  read_fitted_core();
  for (const char* const target : {"sim", "sim_verilator", "harness"})
    EXPECT_THAT(options(target), testing::HasSubstr("-DHITPIPE_CHECK ")) << target;
  expect_icarus_to_pass();
}

TEST_P(CoreFile, SynthTargetHasItsTop) {
  read_core(true);
  const std::string files = sources("synth");
  EXPECT_EQ(flow_options("synth").at("arch"), "xilinx");
  const ToolResult result =
      run_tool(folder / "work" / "synth", "yosys", "yosys",
               "-q -p 'read_verilog" + files + "; hierarchy -check -top " + top("synth") + "'");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, "");
}

INSTANTIATE_TEST_SUITE_P(Designs, CoreFile, testing::ValuesIn(every_design({"20/24"})), design_suffix);

/// FuseSoC itself, where it is installed.
TEST(FuseSoC, RunsTheTargetsAndFailsWithAWrongVector) {
  const ScratchFolder folder;
  if (host::run({"sh", "-c", "command -v fusesoc"}).out.empty())
    GTEST_SKIP() << "fusesoc was not found: its targets are run by a script alone";
  const DesignFormat d{"int_slabs", "6/6"};
  host::write_files(folder / "rtl", emit(d.found(), d.parsed(), Library::thesis(), d.pipeline()).files());
  const auto run = [&](const std::string& target) {
    return run_tool(folder.path(), "fusesoc", "fusesoc",
                    "--cores-root rtl run --target=" + target + " hitpipe:ray_box:int_slabs");
  };
  const ToolResult lint = run("lint");
  EXPECT_EQ(lint.status, 0) << lint.output;
  for (const char* const target : {"sim", "sim_verilator", "harness"}) {
    const ToolResult good = run(target);
    EXPECT_EQ(good.status, 0) << good.output;
    EXPECT_THAT(good.output, testing::HasSubstr("PASS 1000 vectors")) << target;
  }
  const std::filesystem::path vectors = folder / "rtl/tb/int_slabs_vectors.hex";
  std::string text = read_text(vectors);
  char& last_hit = text[text.size() - 2];
  last_hit = "1032547698badcfe"[std::stoi(std::string(1, last_hit), nullptr, 16)];
  write_text(vectors, text);
  for (const char* const target : {"sim", "sim_verilator", "harness"}) {
    const ToolResult bad = run(target);
    EXPECT_NE(bad.status, 0) << target;
    EXPECT_THAT(bad.output, testing::HasSubstr("FAIL vector 999 (")) << target;
  }
}

}  // namespace
}  // namespace hitpipe::rtl::core_file_test
