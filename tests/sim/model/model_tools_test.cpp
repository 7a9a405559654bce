// The tools that build a model and the folder that it goes to: which tools are taken, and that every failure
// says in one line what was wrong and what to do.
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include "tests/sim/model/model_cache_fixture.hpp"

namespace hitpipe::sim::model_tools_test {
namespace {

namespace fs = std::filesystem;
using testing::MatchesRegex;

using ModelTools = ModelCache;

TEST_F(ModelTools, MissingVerilatorRejected) {
  const EnvironmentValue verilator("VERILATOR", "/nonexistent/verilator");
  EXPECT_EQ(
      error_of_build(cache_),
      "/nonexistent/verilator: cannot be run; install the package verilator or set VERILATOR to the program");
  EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(ModelTools, ProgramThatSaysNoVersionRejected) {
  const std::string program = folder_.write_program("silent", "#!/bin/sh\nexit 1\n").string();
  const EnvironmentValue verilator("VERILATOR", program);
  EXPECT_EQ(
      error_of_build(cache_),
      program +
          ": cannot be run (it failed with exit code 1); install the package verilator or set VERILATOR to "
          "the program");
  EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(ModelTools, MissingCompilerRejected) {
  const EnvironmentValue compiler("CXX", "no-such-compiler");
  EXPECT_EQ(error_of_build(cache_),
            "no-such-compiler: cannot be run; install the package g++ or set CXX to the program");
  EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(ModelTools, TakesACompilerWithArguments) {
  const EnvironmentValue compiler("CXX", "env HITPIPE_TEST=1 c++");
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
}

TEST_F(ModelTools, SaysWhichWordOfACompilerIsMissing) {
  const EnvironmentValue language("LC_ALL", "C");
  const EnvironmentValue compiler("CXX", "env no-such-compiler");
  EXPECT_EQ(
      error_of_build(cache_),
      "env no-such-compiler: cannot be run (it failed with exit code 127: env: 'no-such-compiler': No such "
      "file or directory); install the package g++ or set CXX to the program");
  const EnvironmentValue launcher("CXX", "no-such-launcher c++");
  EXPECT_EQ(
      error_of_build(cache_),
      "no-such-launcher c++: cannot be run (no-such-launcher was not found); install the package g++ or set "
      "CXX to the program");
}

TEST_F(ModelTools, VerilatorRootThatIsNoFolderRejected) {
  const EnvironmentValue root("VERILATOR_ROOT", "/none");
  EXPECT_EQ(error_of_build(cache_),
            "VERILATOR_ROOT is /none, which is no folder; set it to Verilator's folder, or do not set it");
  const EnvironmentValue wrong("VERILATOR_ROOT", folder_.path().string());
  EXPECT_EQ(error_of_build(cache_),
            "VERILATOR_ROOT is " + folder_.path().string() +
                ", which has no include/verilated.h; set it to Verilator's folder, or do not set it");
}

/// A stand-in for clang++ comes first in PATH.
TEST_F(ModelTools, TakesClangWhereItFindsItsLibraryAndElseTheOtherCompiler) {
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

TEST_F(ModelTools, TakesAPathOfACompilerWithBlanks) {
  const EnvironmentValue compiler(
      "CXX", folder_.write_program("it's a compiler", "#!/bin/sh\nexec c++ \"$@\"\n").string());
  build_in(cache_);
  EXPECT_EQ(stub_.runs(), 1);
}

/// A stand-in keeps how it is called.
TEST_F(ModelTools, GivesTheCompilerMoreOptionsAndBuildsAModelForEach) {
  const fs::path calls = folder_.path() / "calls";
  const EnvironmentValue compiler(
      "CXX",
      folder_.write_program("compiler", "#!/bin/sh\necho \"$@\" >>" + calls.string() + "\nexec c++ \"$@\"\n")
          .string());
  for (const char* const options : {"-O0 -DMORE", "", "-O0 -DMORE"}) {
    const EnvironmentValue more("CXXFLAGS", options);
    build_in(cache_);
  }
  EXPECT_EQ(stub_.runs(), 2);
  std::size_t with = 0, without = 0;
  std::ifstream in(calls);
  for (std::string call; std::getline(in, call);) {
    if (call.find("-shared") == std::string::npos) continue;
    const bool more = call.find(" -O0 -DMORE ") != std::string::npos;
    ++(more ? with : without);
    if (more) {
      EXPECT_LT(call.find("-O2"), call.find("-O0"));
    }
  }
  EXPECT_EQ(with, 1U);
  EXPECT_EQ(without, 1U);
}

TEST_F(ModelTools, KilledCompilerRejected) {
  const fs::path compiler = folder_.write_program(
      "compiler", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\nkill -9 $$\n");
  const EnvironmentValue variable("CXX", compiler);
  EXPECT_EQ(error_of_build(cache_), compiler.string() +
                                        ": was ended by signal 9 (Killed); its output is in " +
                                        (cache_ / "failed-verilated.log").string());
}

TEST_F(ModelTools, FailingVerilatorRejected) {
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

TEST_F(ModelTools, FailingCompilerRejected) {
  const fs::path compiler = folder_.write_program(
      "compiler", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\necho no space >&2\nexit 4\n");
  const EnvironmentValue variable("CXX", compiler);
  EXPECT_EQ(error_of_build(cache_), compiler.string() + ": failed with exit code 4; its output is in " +
                                        (cache_ / "failed-verilated.log").string());
  EXPECT_EQ(names_in(cache_), (std::vector<std::string>{"failed-verilated.log"}));
}

TEST_F(ModelTools, ToolThatFindsNoSpaceRejected) {
  const fs::path compiler =
      folder_.write_program("compiler",
                            "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 1; exit; fi\n"
                            "echo 'error: unable to write a.o: No space left on device' >&2\nexit 1\n");
  const EnvironmentValue variable("CXX", compiler);
  EXPECT_EQ(
      error_of_build(cache_),
      cache_.string() + ": no space left on the disk for " + compiler.string() +
          "; make room, or set HITPIPE_CACHE, and TMPDIR for the tools' own files, to folders elsewhere");
  EXPECT_TRUE(names_in(cache_).empty());
}

TEST_F(ModelTools, VerilatorWithoutRootRejected) {
  stub_.set_root("");
  EXPECT_EQ(error_of_build(cache_),
            stub_.program().string() + ": does not say its VERILATOR_ROOT; set it in the environment");
  EXPECT_TRUE(names_in(cache_).empty());
}

TEST_F(ModelTools, FolderThatCannotBeMadeRejected) {
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

TEST_F(ModelTools, FullDiskRejected) {
  // A limit on the size of files comes closest to a full disk in a test.
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = error_of_build(cache_);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(
      error,
      MatchesRegex(cache_.string() +
                   "/building-[0-9a-f]{8}-[0-9a-f]{16}/int_slabs.v: cannot write the file: File too large"));
  EXPECT_TRUE(names_in(cache_).empty());
}

}  // namespace
}  // namespace hitpipe::sim::model_tools_test
