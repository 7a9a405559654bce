// A cache of models of one unit, for the tests of the cache and of the tools that fill it.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/model/stub_verilator.hpp"

namespace hitpipe::sim {

inline constexpr hls::IntBits model_bits{20, 24};

inline void build_in(const std::filesystem::path& cache) {
  const VerilatedDesign design(rtl::make_unit(int_slabs(), model_bits, rtl::Library::thesis()), cache);
}

/// The one line that a failed build ends with.
inline std::string error_of_build(const std::filesystem::path& cache) {
  return message_of<std::runtime_error>([&] { build_in(cache); });
}

inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename() != ".locks") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Builds go into a folder of the test, by a stand-in for Verilator and a compiler that is asked each time.
class ModelCache : public testing::Test {
 protected:
  StubVerilator stub_;
  EnvironmentValue compiler_{"CXX", "c++"};
  TemporaryFolder folder_;
  std::filesystem::path cache_ = folder_.path() / "cache";
};

}  // namespace hitpipe::sim
