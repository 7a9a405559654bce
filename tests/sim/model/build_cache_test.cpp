// The cache of Verilated models: all runs share one build, and races and kills leave it whole.
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/sim/model/model_cache_fixture.hpp"

namespace hitpipe::sim::build_cache_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::MatchesRegex;

/// The only model in the cache. The cache holds only it and Verilator's own code.
fs::path only_entry(const fs::path& cache) {
  const auto names = names_in(cache);
  EXPECT_THAT(names, ElementsAre(MatchesRegex("int_slabs-[0-9a-f]+"), MatchesRegex("verilated-[0-9a-f]+")));
  return cache / names.front();
}

/// Entries with this name.
std::ptrdiff_t count_in(const fs::path& cache, const std::string& name) {
  const auto names = names_in(cache);
  return std::count_if(names.begin(), names.end(),
                       [&](const std::string& each) { return each.starts_with(name + "-"); });
}

/// A process in its own process group. It builds, and its exit code says whether that succeeded.
pid_t start_build(const fs::path& cache) {
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    _exit(error_of_build(cache) == "no exception" ? 0 : 1);
  }
  return child;
}

int exit_code(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ModelCacheOfVerilator, SecondConstructionLeavesTheModelAlone) {
  // By the real Verilator. The tests before this one have built it already. Others may be building theirs
  // now, in folders that come and go.
  build_in(default_cache());
  std::vector<std::pair<fs::path, fs::file_time_type>> before;
  for (const std::string& name : names_in(default_cache()))
    if (name.starts_with("int_slabs-")) {
      const fs::path model = default_cache() / name / "model.so";
      before.emplace_back(model, fs::last_write_time(model));
    }
  ASSERT_GE(before.size(), 1U);
  build_in(default_cache());
  for (const auto& [model, time] : before) EXPECT_EQ(fs::last_write_time(model), time) << model;
}

/// A run with one flow control must not get the model of another.
TEST_F(ModelCache, FlowControlIsPartOfTheKey) {
  for (const auto flow : {rtl::FlowControl::stall, rtl::FlowControl::none, rtl::FlowControl::none}) {
    const VerilatedDesign design(
        rtl::make_unit(int_slabs(), model_bits, rtl::Library::thesis(), {.flow_control = flow}), cache_);
  }
  EXPECT_EQ(count_in(cache_, "int_slabs"), 2);
}

/// No shell reads the names of folders on the way from Verilog to a model.
TEST(ModelCacheOfVerilator, TakesAnyFolderNames) {
  const TemporaryFolder folder;
  const fs::path temporary = folder / "it's temporary";
  const fs::path cache = folder / "it's a $cache; with \"words\"";
  fs::create_directory(temporary);
  fs::create_directory(cache);
  // Verilator's own code need not be compiled again.
  build_in(default_cache());
  for (const std::string& name : names_in(default_cache()))
    if (name.starts_with("verilated-")) fs::copy(default_cache() / name, cache / name);
  const EnvironmentValue variable("TMPDIR", temporary.string());
  const VerilatedDesign design(rtl::make_unit(int_slabs(), hls::IntBits{6, 6}, rtl::Library::thesis()),
                               cache);
  Model model(design);
  Pins pins{.out_ready = true};
  model.cycle(nullptr, pins);
  EXPECT_TRUE(pins.in_ready);
  EXPECT_EQ(count_in(cache, "int_slabs_6_6"), 1);
  EXPECT_TRUE(fs::is_empty(temporary));
}

TEST_F(ModelCache, BuildsOnce) {
  build_in(cache_);
  const fs::path entry = only_entry(cache_);
  EXPECT_EQ(names_in(entry), (std::vector<std::string>{"identity", "int_slabs.v", "log", "model.cpp",
                                                       "model.so", "pins.hpp", "unit.cpp"}));
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
  EXPECT_EQ(only_entry(cache_), entry);
}

TEST_F(ModelCache, NeedsNoWorkingVerilatorForWhatItHolds) {
  build_in(cache_);
  stub_.set_exit_code(3);
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
}

TEST_F(ModelCache, BuildsAgainForAnotherVersionFormatOrCompiler) {
  build_in(cache_);
  stub_.set_version("Stub 2");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 2);
  const VerilatedDesign other_format(
      rtl::make_unit(int_slabs(), hls::IntBits{16, 16}, rtl::Library::thesis()), cache_);
  EXPECT_EQ(stub_.runs(), 3);
  folder_.write_program("compiler", "#!/bin/sh\nexec c++ \"$@\"\n");
  const EnvironmentValue compiler("CXX", folder_.path() / "compiler");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 4);
  EXPECT_EQ(count_in(cache_, "int_slabs"), 3);
  EXPECT_EQ(count_in(cache_, "int_slabs_16_16"), 1);
  EXPECT_EQ(count_in(cache_, "verilated"), 3) << "one for each version and compiler, whatever the format";
}

/// A header that was compiled for other options or an older C++ library is left out.
TEST_F(ModelCache, BuildsWithoutACompiledHeaderThatDoesNotFit) {
  build_in(cache_);
  for (const auto& each : fs::directory_iterator(cache_)) {
    if (each.path().filename().string().starts_with("verilated-"))
      std::ofstream(each.path() / "verilated.h.gch") << "of another compiler";
  }
  const VerilatedDesign other_format(
      rtl::make_unit(int_slabs(), hls::IntBits{16, 16}, rtl::Library::thesis()), cache_);
  EXPECT_EQ(count_in(cache_, "int_slabs_16_16"), 1);
}

/// As it is installed: a script that starts the binary beside it.
TEST_F(ModelCache, AsksAnInstalledVerilatorForItsVersionOnce) {
  const fs::path folder = stub_.program().parent_path();
  const EnvironmentValue verilator("VERILATOR", "");
  const EnvironmentValue programs("PATH", folder.string() + ":" + std::getenv("PATH"));
  fs::copy("/bin/true", folder / "verilator_bin");
  build_in(cache_);
  stub_.set_version("Stub 2");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
  fs::last_write_time(folder / "verilator_bin", fs::file_time_type::clock::now() + std::chrono::hours(1));
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 2);
  EXPECT_EQ(count_in(cache_, "verilator"), 2);
}

TEST_F(ModelCache, CompilesVerilatorsOwnCodeOnce) {
  build_in(cache_);
  for (const auto& each : fs::directory_iterator(cache_)) {
    if (!each.path().filename().string().starts_with("verilated-")) continue;
    EXPECT_EQ(names_in(each.path()), (std::vector<std::string>{"identity", "log", "verilated.h.gch",
                                                               "verilated.o", "verilated_threads.o"}));
    // This source can no longer be compiled, so a second compilation would fail.
    std::ofstream(stub_.program().parent_path() / "include/verilated.cpp") << "no C++";
    const VerilatedDesign other_format(
        rtl::make_unit(int_slabs(), hls::IntBits{16, 16}, rtl::Library::thesis()), cache_);
    fs::remove(each.path() / "verilated_threads.o");
    EXPECT_THROW(
        VerilatedDesign(rtl::make_unit(int_slabs(), hls::IntBits{24, 24}, rtl::Library::thesis()), cache_),
        std::runtime_error);
  }
  EXPECT_TRUE(fs::exists(cache_ / "failed-verilated.log"));
}

TEST_F(ModelCache, TakesAnyFolderName) {
  cache_ = folder_.path() / "it's a $cache; with \"words\"";
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
  only_entry(cache_);
}

TEST_F(ModelCache, TakesRelativePaths) {
  const fs::path before = fs::current_path();
  fs::current_path(stub_.program().parent_path());
  const EnvironmentValue verilator("VERILATOR", "./verilator");
  build_in("relative");
  EXPECT_TRUE(fs::exists(only_entry("relative") / "model.so"));
  fs::current_path(before);
}

TEST_F(ModelCache, OneOfRacingProcessesBuildsAndTheOtherWaits) {
  stub_.set_seconds("0.5");
  const pid_t one = start_build(cache_);
  const pid_t other = start_build(cache_);
  EXPECT_EQ(exit_code(one), 0);
  EXPECT_EQ(exit_code(other), 0);
  EXPECT_EQ(stub_.runs(), 1);
  only_entry(cache_);
}

TEST_F(ModelCache, KilledBuildLeavesAFolderThatTheNextRemoves) {
  stub_.set_seconds("100000");
  const pid_t child = start_build(cache_);
  while (stub_.runs() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_EQ(stub_.runs(), 1);
  kill(-child, SIGKILL);
  EXPECT_EQ(exit_code(child), -1);
  ASSERT_EQ(names_in(cache_).size(), 1U);
  const fs::path left = cache_ / names_in(cache_).front();
  EXPECT_THAT(left.filename().string(), MatchesRegex("building-[0-9a-f]{8}-[0-9a-f]{16}"));

  stub_.set_seconds("0");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 2);
  only_entry(cache_);
}

TEST_F(ModelCache, DamagedEntriesAreBuiltAgain) {
  build_in(cache_);
  const fs::path entry = only_entry(cache_);
  fs::remove(entry / "model.so");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 2);
  std::ofstream(entry / "identity") << "other sources of the same hash";
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 3);
  fs::remove_all(entry);
  std::ofstream(entry) << "a file in its place";
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 4);
  EXPECT_EQ(only_entry(cache_), entry);
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 4);
}

TEST_F(ModelCache, ModelThatCannotBeLoadedRejected) {
  build_in(cache_);
  const fs::path entry = only_entry(cache_);
  const std::string model = (entry / "model.so").string();
  const std::string advice = "; remove the folder to have it built again";
  std::ofstream(model)
      << "no library, though it has more than the sixty-four bytes that its header would take";
  EXPECT_EQ(error_of_build(cache_),
            entry.string() + ": cannot be loaded (" + model + ": invalid ELF header)" + advice);
  folder_.write("empty.cpp", "");
  ASSERT_EQ(
      std::system(
          fmt::format("c++ -shared -o '{}' '{}'", model, (folder_.path() / "empty.cpp").string()).c_str()),
      0);
  EXPECT_EQ(error_of_build(cache_),
            entry.string() + ": cannot be loaded (" + model + ": undefined symbol: hitpipe_create)" + advice);
}

TEST(ModelCacheFolder, IsTheFirstOfThreeVariables) {
  const EnvironmentValue home("HOME", "/home/someone");
  const EnvironmentValue user_cache("XDG_CACHE_HOME", "/var/caches");
  const EnvironmentValue own("HITPIPE_CACHE", "/fast/hitpipe models");
  EXPECT_EQ(default_cache(), "/fast/hitpipe models");
  const EnvironmentValue no_own("HITPIPE_CACHE", std::nullopt);
  EXPECT_EQ(default_cache(), "/var/caches/hitpipe");
  const EnvironmentValue empty_user_cache("XDG_CACHE_HOME", "");
  EXPECT_EQ(default_cache(), "/home/someone/.cache/hitpipe");
  const EnvironmentValue no_home("HOME", std::nullopt);
  const EnvironmentValue temporary("TMPDIR", "/var/tmp");
  EXPECT_EQ(default_cache(), fmt::format("/var/tmp/hitpipe-cache-{}", geteuid()));
  const EnvironmentValue no_temporary("TMPDIR", std::nullopt);
  EXPECT_EQ(default_cache(), fmt::format("/tmp/hitpipe-cache-{}", geteuid()));
}

TEST_F(ModelCache, OfOthersIsNotLoaded) {
  const mode_t mask = umask(0);
  build_in(cache_);
  umask(mask);
  EXPECT_EQ(fs::status(cache_).permissions(), fs::perms::owner_all);
  const fs::path entry = only_entry(cache_);
  const std::string advice = ", so the code in it is not run; set HITPIPE_CACHE to another folder";
  for (const fs::path& folder : {cache_, entry}) {
    for (const fs::perms more : {fs::perms::group_write, fs::perms::others_write}) {
      fs::permissions(folder, more, fs::perm_options::add);
      EXPECT_EQ(error_of_build(cache_), folder.string() + ": other users may write to it" + advice +
                                            ", or take that right from them (chmod go-w)");
      fs::permissions(folder, more, fs::perm_options::remove);
    }
  }
  fs::create_directory_symlink(cache_, folder_.path() / "link");
  if (geteuid() == 0) {
    for (const fs::path& path : {cache_, entry, entry / "model.so", folder_.path() / "link"}) {
      ASSERT_EQ(lchown(path.c_str(), 1, 1), 0);
      EXPECT_EQ(error_of_build(path.filename() == "link" ? path : cache_),
                path.string() + ": belongs to another user" + advice);
      ASSERT_EQ(lchown(path.c_str(), 0, 0), 0);
    }
  }
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
}

}  // namespace
}  // namespace hitpipe::sim::build_cache_test
