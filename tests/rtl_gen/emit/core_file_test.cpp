// The FuseSoC core file: YAML that names existing files. Its targets work when a script does with them what
// FuseSoC does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/emit/fusesoc_cores.hpp"
#include "tests/rtl_gen/emit/vector_lines.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::core_file_test {
namespace {

std::vector<std::string> names_of(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

TEST(CoreFiles, OfEveryDesignNameItAndItsTargets) {
  const ScratchFolder folder;
  for (const DesignFormat& d : every_design({"20/24"}))
    write_text(folder / (d.design + ".core"), d.emitted().core.contents);
  const Json cores = cores_in(folder.path());
  for (const DesignFormat& d : every_design({"20/24"})) {
    const Json& core = cores.at(d.design + ".core");
    EXPECT_EQ(core.at("name"), "hitpipe:ray_box:" + d.module() + ":" HITPIPE_VERSION);
    EXPECT_THAT(core.at("description").get<std::string>(), testing::EndsWith(" at " + d.format));
    // The thesis's library is of no chip.
    EXPECT_THAT(names_of(core.at("targets")),
                testing::ElementsAre("default", "harness", "lint", "sim", "sim_verilator"));
    for (const Json& target : core.at("targets"))
      EXPECT_FALSE(target.at("description").get<std::string>().empty());
    EXPECT_FALSE(core.at("filesets").contains("axis"));
    EXPECT_EQ(core.at("targets").at("default").at("toplevel"), d.module());
  }
}

/// A unit in a folder. What a core file says differs between designs by their names alone.
class CoreFile : public testing::Test {
 protected:
  void write(const EmittedDesign& unit) {
    host::write_files(folder.path(), unit.files());
    core = cores_in(folder.path()).at(unit.core.name);
  }
  /// Fitted to demands that include a fixed origin.
  void write_fitted() {
    const Graph traced = d.found().trace(d.parsed());
    const Demands demands = demand_sets(d.found(), d.parsed()).back().demands;
    Pruned pruned = prune(traced, demands, {.shares = false});
    write(emit(make_unit(d.found(), d.parsed(), Library::thesis(),
                         make_pipeline(pruned.graph, Library::thesis()), demands, std::move(pruned.report))));
  }

  /// Copies a target's files to a work folder of its own, where FuseSoC would put them. Returns the Verilog.
  std::string sources(const std::string& target) {
    const std::filesystem::path root = folder / "work" / target;
    std::string list;
    for (const Json& set : core.at("targets").at(target).at("filesets")) {
      const Json& fileset = core.at("filesets").at(set.get<std::string>());
      for (const Json& entry : fileset.at("files")) {
        const bool plain = entry.is_string();
        const std::string name = plain ? entry.get<std::string>() : entry.begin().key();
        const Json attributes = plain ? Json::object() : entry.begin().value();
        const std::string to = attributes.value("copyto", name);
        std::filesystem::create_directories((root / to).parent_path());
        std::filesystem::copy_file(folder / name, root / to);
        if (attributes.value("file_type", fileset.value("file_type", "")).ends_with("erilogSource"))
          list += " " + to;
      }
    }
    return list;
  }
  [[nodiscard]] std::string top(const std::string& target) const {
    return core.at("targets").at(target).at("toplevel");
  }
  [[nodiscard]] std::string option(const std::string& target, const char* name) const {
    return core.at("targets").at(target).at("flow_options").at(name);
  }
  [[nodiscard]] std::string tool_options(const std::string& target) const {
    const char* const key = option(target, "tool") == "icarus" ? "iverilog_options" : "verilator_options";
    std::string list;
    for (const Json& each : core.at("targets").at(target).at("flow_options").at(key))
      list += each.get<std::string>() + " ";
    return list;
  }
  /// Verilator with a target's files, top and options, and with more options.
  void expect_lint_clean(const std::string& target, const std::string& more = "") {
    const std::string files = sources(target);
    expect_silence(folder / "work" / target, "verilator",
                   "--lint-only " + more + tool_options(target) + "--top-module " + top(target) + files);
  }
  void expect_icarus_to_pass() {
    const std::string files = sources("sim");
    const std::filesystem::path root = folder / "work" / "sim";
    expect_silence(root, "iverilog", tool_options("sim") + "-o sim -s " + top("sim") + files);
    const ToolResult replay = run_tool(root, "iverilog", "vvp", "-n sim");
    EXPECT_EQ(replay.status, 0);
    EXPECT_THAT(replay.output, testing::HasSubstr("PASS 1000 vectors"));
  }

  const DesignFormat d{"int_major_pair", "20+1/13"};
  ScratchFolder folder;
  Json core;
};

TEST_F(CoreFile, TargetsOfAUnitWork) {
  write(d.emitted());
  EXPECT_EQ(top("lint"), d.design);
  expect_lint_clean("lint");
  expect_icarus_to_pass();
  EXPECT_EQ(option("sim_verilator", "mode"), "binary");
  EXPECT_EQ(top("sim_verilator"), d.design + "_tb");
  expect_lint_clean("sim_verilator", "--timing ");
  EXPECT_EQ(option("harness", "mode"), "cc");
  EXPECT_EQ(top("harness"), d.design);
  expect_lint_clean("harness");
  EXPECT_TRUE(std::filesystem::exists(folder / "work/harness/tb" / (d.design + "_harness.cpp")));
  EXPECT_TRUE(std::filesystem::exists(folder / "work/harness" / (d.design + "_vectors.hex")));
}

TEST_F(CoreFile, TargetsWithTheWrapperHaveItAsTheirTop) {
  write(d.emitted({.axi_stream = true}));
  EXPECT_EQ(top("lint"), d.design + "_axis");
  expect_lint_clean("lint");
}

TEST_F(CoreFile, SynthesisIsWhatTheLibrarySays) {
  for (const std::string& name : built_in_names()) {
    const Library library = library_called(name);
    write(emit(make_unit(d.found(), d.parsed(), library), {.axi_stream = true}));
    EXPECT_EQ(core.at("targets").size(), 5 + library.synthesis_targets().size()) << name;
    for (const SynthesisTarget& target : library.synthesis_targets()) {
      const Json& written = core.at("targets").at(target.name);
      EXPECT_EQ(written.at("description"), target.description);
      EXPECT_EQ(written.at("flow"), target.flow);
      EXPECT_EQ(written.at("flow_options"), Json::parse(target.options));
      EXPECT_EQ(top(target.name), d.design + "_axis");
      const std::string files = sources(target.name);
      expect_silence(folder / "work" / target.name, "yosys",
                     "-q -p 'read_verilog" + files + "; hierarchy -check -top " + top(target.name) + "'");
      std::filesystem::remove_all(folder / "work");
    }
  }
}

TEST_F(CoreFile, OfAFittedUnitHasItsCheckModuleAndChecksOn) {
  write_fitted();
  EXPECT_THAT(core.at("description").get<std::string>(), testing::EndsWith(d.format + ", fitted"));
  EXPECT_EQ(core.at("targets").size(), 6U);
  EXPECT_FALSE(core.at("targets").at("check").at("description").get<std::string>().empty());
  EXPECT_EQ(top("check"), d.design + "_check");
  EXPECT_EQ(core.at("filesets").at("check").at("files"), Json({d.design + "_check.v"}));
  expect_lint_clean("check");
  for (const char* const target : {"sim", "sim_verilator", "harness"})
    EXPECT_THAT(tool_options(target), testing::HasSubstr("-DHITPIPE_CHECK ")) << target;
  expect_icarus_to_pass();
}

/// FuseSoC itself, where it is installed.
TEST(FuseSoC, RunsTheTargetsAndFailsWithAWrongVector) {
  const ScratchFolder folder;
  if (host::run({"sh", "-c", "command -v fusesoc"}).out.empty())
    GTEST_SKIP() << "fusesoc was not found: its targets are run by a script alone";
  host::write_files(folder / "rtl", DesignFormat{"int_slabs", "6/6"}.emitted().files());
  const auto run = [&](const std::string& target) {
    return run_tool(folder.path(), "fusesoc", "fusesoc",
                    "--cores-root rtl run --target=" + target + " hitpipe:ray_box:int_slabs_6_6");
  };
  EXPECT_EQ(run("lint").status, 0);
  const std::filesystem::path vectors = folder / "rtl/tb/int_slabs_6_6_vectors.hex";
  for (const bool good : {true, false}) {
    if (!good) write_text(vectors, with_bit_inverted(read_text(vectors), 999, 0));
    for (const char* const target : {"sim", "sim_verilator", "harness"}) {
      const ToolResult result = run(target);
      EXPECT_EQ(result.status == 0, good) << result.output;
      EXPECT_THAT(result.output, testing::HasSubstr(good ? "PASS 1000 vectors" : "FAIL vector 999 ("))
          << target;
    }
  }
}

}  // namespace
}  // namespace hitpipe::rtl::core_file_test
