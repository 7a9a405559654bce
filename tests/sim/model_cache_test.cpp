// The cache of Verilated models: all runs share one build, races and kills leave it whole, and every failure
// says in one line what was wrong and what to do.
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/message_of.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/stub_verilator.hpp"

namespace hitpipe::sim {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::MatchesRegex;

constexpr hls::IntBits bits{20, 24};

void build_in(const fs::path& cache) {
  const VerilatedDesign design(int_slabs(), bits, rtl::Library::thesis(), cache);
}

/// The one line that a failed build ends with.
std::string error_of_build(const fs::path& cache) {
  return message_of<std::runtime_error>([&] { build_in(cache); });
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

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

class ModelCache : public testing::Test {
 protected:
  StubVerilator stub_;
  TemporaryFolder folder_;
  fs::path cache_ = folder_.path() / "cache";
};

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
    const VerilatedDesign design(int_slabs(), bits, rtl::Library::thesis(), cache_, flow);
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
  const VerilatedDesign design(int_slabs(), hls::IntBits{6, 6}, rtl::Library::thesis(), cache);
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
  const VerilatedDesign other_format(int_slabs(), hls::IntBits{16, 16}, rtl::Library::thesis(), cache_);
  EXPECT_EQ(stub_.runs(), 3);
  folder_.write_program("compiler", "#!/bin/sh\nexec c++ \"$@\"\n");
  const EnvironmentValue compiler("CXX", folder_.path() / "compiler");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 4);
  EXPECT_EQ(count_in(cache_, "int_slabs"), 3);
  EXPECT_EQ(count_in(cache_, "int_slabs_16_16"), 1);
  EXPECT_EQ(count_in(cache_, "verilated"), 3) << "one for each version and compiler, whatever the format";
}

TEST_F(ModelCache, CompilesVerilatorsOwnCodeOnce) {
  build_in(cache_);
  for (const auto& each : fs::directory_iterator(cache_)) {
    if (!each.path().filename().string().starts_with("verilated-")) continue;
    EXPECT_EQ(names_in(each.path()),
              (std::vector<std::string>{"identity", "log", "verilated.o", "verilated_threads.o"}));
    // This source can no longer be compiled, so a second compilation would fail.
    std::ofstream(stub_.program().parent_path() / "include/verilated.cpp") << "no C++";
    const VerilatedDesign other_format(int_slabs(), hls::IntBits{16, 16}, rtl::Library::thesis(), cache_);
    fs::remove(each.path() / "verilated_threads.o");
    EXPECT_THROW(VerilatedDesign(int_slabs(), hls::IntBits{24, 24}, rtl::Library::thesis(), cache_),
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

TEST_F(ModelCache, RacingProcessesBothSucceedAndLeaveOneEntry) {
  stub_.set_seconds("0.5");
  const pid_t one = start_build(cache_);
  const pid_t other = start_build(cache_);
  EXPECT_EQ(exit_code(one), 0);
  EXPECT_EQ(exit_code(other), 0);
  EXPECT_EQ(stub_.runs(), 2) << "they did not race";
  only_entry(cache_);
}

TEST_F(ModelCache, KilledBuildLeavesNoEntry) {
  stub_.set_seconds("30");
  const pid_t child = start_build(cache_);
  for (int i = 0; i < 1000 && stub_.runs() == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_EQ(stub_.runs(), 1);
  kill(-child, SIGKILL);
  EXPECT_EQ(exit_code(child), -1);
  ASSERT_EQ(names_in(cache_).size(), 1U);
  const fs::path left = cache_ / names_in(cache_).front();
  EXPECT_THAT(left.filename().string(), MatchesRegex("building-......"));

  stub_.set_seconds("0");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 2);
  EXPECT_TRUE(fs::exists(left)) << "it could be a build that still runs";
  // An hour later, the next build removes it.
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::minutes(61));
  stub_.set_version("Stub 2");
  build_in(cache_);
  EXPECT_EQ(count_in(cache_, "int_slabs"), 2);
  EXPECT_EQ(count_in(cache_, "verilated"), 2);
  EXPECT_EQ(names_in(cache_).size(), 4U);
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

TEST_F(ModelCache, MissingVerilatorRejected) {
  const EnvironmentValue verilator("VERILATOR", "/nonexistent/verilator");
  EXPECT_EQ(
      error_of_build(cache_),
      "/nonexistent/verilator: cannot be run; install the package verilator or set VERILATOR to the program");
  EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(ModelCache, ProgramThatSaysNoVersionRejected) {
  const EnvironmentValue verilator("VERILATOR", "/bin/false");
  EXPECT_EQ(error_of_build(cache_),
            "/bin/false: cannot be run; install the package verilator or set VERILATOR to the program");
  EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(ModelCache, MissingCompilerRejected) {
  const EnvironmentValue compiler("CXX", "no-such-compiler");
  EXPECT_EQ(error_of_build(cache_),
            "no-such-compiler: cannot be run; install the package g++ or set CXX to the program");
  EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(ModelCache, TakesACompilerWithArguments) {
  const EnvironmentValue compiler("CXX", "env HITPIPE_TEST=1 c++");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
  const EnvironmentValue missing("CXX", "env no-such-compiler");
  EXPECT_EQ(error_of_build(cache_),
            "env no-such-compiler: cannot be run; install the package g++ or set CXX to the program");
}

/// A stand-in for clang++ comes first in PATH.
TEST_F(ModelCache, TakesClangWhereItFindsItsLibraryAndElseTheOtherCompiler) {
  const fs::path clang = folder_.write_program("clang++", "#!/bin/sh\nexec c++ \"$@\"\n");
  const std::string path = clang.parent_path().string() + ":" + std::getenv("PATH");
  const EnvironmentValue variable("CXX", "");
  const EnvironmentValue programs("PATH", path);
  const auto compilers = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(cache_)) {
      std::ifstream identity(entry.path() / "identity");
      std::string line;
      while (std::getline(identity, line))
        if (line == "clang++" || line == "c++") names.insert(line);
    }
    return names;
  };
  build_in(cache_);
  EXPECT_EQ(compilers(), (std::set<std::string>{"clang++"}));
  folder_.write_program("clang++", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\nexit 1\n");
  build_in(cache_);
  EXPECT_EQ(compilers(), (std::set<std::string>{"c++", "clang++"}));
}

TEST_F(ModelCache, TakesAPathOfACompilerWithBlanks) {
  const EnvironmentValue compiler(
      "CXX", folder_.write_program("it's a compiler", "#!/bin/sh\nexec c++ \"$@\"\n").string());
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
}

TEST_F(ModelCache, KilledCompilerRejected) {
  const fs::path compiler = folder_.write_program(
      "compiler", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\nkill -9 $$\n");
  const EnvironmentValue variable("CXX", compiler);
  EXPECT_EQ(error_of_build(cache_), compiler.string() +
                                        ": was ended by signal 9 (Killed); its output is in " +
                                        (cache_ / "failed-verilated.log").string());
}

TEST_F(ModelCache, FailingVerilatorRejected) {
  stub_.set_exit_code(3);
  const fs::path log = cache_ / "failed-int_slabs.log";
  EXPECT_EQ(error_of_build(cache_),
            stub_.program().string() + ": failed with exit code 3; its output is in " + log.string());
  EXPECT_EQ(names_in(cache_), (std::vector<std::string>{"failed-int_slabs.log"}));
  std::string line;
  std::getline(std::ifstream(log), line);
  EXPECT_EQ(line, "stub fails");
  stub_.set_exit_code(0);
  build_in(cache_);
  EXPECT_EQ(names_in(cache_).size(), 3U);
}

TEST_F(ModelCache, FailingCompilerRejected) {
  const fs::path compiler = folder_.write_program(
      "compiler", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\necho no space >&2\nexit 4\n");
  const EnvironmentValue variable("CXX", compiler);
  EXPECT_EQ(error_of_build(cache_), compiler.string() + ": failed with exit code 4; its output is in " +
                                        (cache_ / "failed-verilated.log").string());
  EXPECT_EQ(names_in(cache_), (std::vector<std::string>{"failed-verilated.log"}));
}

TEST_F(ModelCache, VerilatorWithoutRootRejected) {
  stub_.set_root("");
  EXPECT_EQ(error_of_build(cache_),
            stub_.program().string() + ": does not say its VERILATOR_ROOT; set it in the environment");
  EXPECT_TRUE(fs::is_empty(cache_));
}

TEST_F(ModelCache, FolderThatCannotBeMadeRejected) {
  folder_.write("file", "");
  const std::string advice = ": cannot write to the cache; set HITPIPE_CACHE to another folder";
  const fs::path below_file = folder_.path() / "file" / "cache";
  EXPECT_EQ(error_of_build(below_file), below_file.string() + advice);
  const fs::path too_long = folder_.path() / std::string(300, 'a');
  EXPECT_EQ(error_of_build(too_long), too_long.string() + advice);
  const fs::path is_file = folder_.path() / "file";
  EXPECT_EQ(error_of_build(is_file), is_file.string() + advice);
  EXPECT_EQ(stub_.runs(), 0);
}

TEST_F(ModelCache, FullDiskRejected) {
  // A limit on the size of files comes closest to a full disk in a test.
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = error_of_build(cache_);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(error, MatchesRegex(cache_.string() +
                                  "/building-....../int_slabs.v: cannot write the file: File too large"));
  EXPECT_TRUE(fs::is_empty(cache_));
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
}

}  // namespace
}  // namespace hitpipe::sim
