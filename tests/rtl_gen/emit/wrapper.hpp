// What a wrapper around a unit may change of what is emitted.
#pragma once

#include <map>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/files.hpp"

namespace hitpipe::rtl {

/// `with` is `bare`, one more Verilog file "<module><suffix>.v" with its testbench, one more object in the
/// manifest, and more in the core.
inline void expect_only_wrapper_added(const EmittedDesign& bare, const EmittedDesign& with,
                                      const std::string& suffix, const char* object) {
  std::map<std::string, std::string> files;
  for (const File& file : with.files()) files[file.name] = file.contents;
  EXPECT_EQ(files.erase(bare.module + suffix + ".v"), 1U);
  EXPECT_EQ(files.erase("tb/" + bare.module + suffix + "_tb.sv"), 1U);
  for (const File& file : bare.files()) {
    const bool speaks_of_it = file.name == bare.core.name || file.name == bare.module + ".json";
    EXPECT_EQ(files.at(file.name) == file.contents, !speaks_of_it) << file.name;
    files.erase(file.name);
  }
  EXPECT_TRUE(files.empty());
  Json manifest = *with.manifest;
  EXPECT_EQ(manifest.erase(object), 1U);
  EXPECT_EQ(manifest, *bare.manifest);
}

}  // namespace hitpipe::rtl
