// FuseSoC core files, as a YAML parser reads them.
#pragma once

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl {

/// What a YAML parser reads from the core files of a folder, by name.
inline nlohmann::json cores_in(const std::filesystem::path& folder) {
  const ToolResult result = run_tool(
      folder, "python3-yaml", "python3",
      "-c 'import glob, json, yaml; texts = {name: open(name).read() for name in glob.glob(\"*.core\")}; "
      "assert all(text.startswith(\"CAPI=2:\\n\") for text in texts.values()); "
      "print(json.dumps({name: yaml.safe_load(text) for name, text in texts.items()}))'");
  EXPECT_EQ(result.status, 0) << result.output;
  return nlohmann::json::parse(result.output);
}

}  // namespace hitpipe::rtl
