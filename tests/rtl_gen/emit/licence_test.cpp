// What hitpipe writes says that it belongs to its user.
#include "rtl_gen/emit/licence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/core/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/emit/machine_files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"

namespace hitpipe::rtl::licence_test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

void expect_licence(const std::vector<host::File>& files) {
  EXPECT_FALSE(files.empty());
  for (const host::File& file : files) {
    SCOPED_TRACE(file.name);
    if (file.name.ends_with(".json"))
      EXPECT_THAT(file.contents, HasSubstr("\n  \"license\": \"0BSD\",\n"));
    else
      EXPECT_THAT(file.contents, AnyOf(StartsWith("// SPDX-License-Identifier: 0BSD\n"),
                                       StartsWith("# SPDX-License-Identifier: 0BSD\n"),
                                       StartsWith("CAPI=2:\n# SPDX-License-Identifier: 0BSD\n"),
                                       StartsWith("#!/bin/sh\n# SPDX-License-Identifier: 0BSD\n"),
                                       StartsWith("#!/usr/bin/env bash\n# SPDX-License-Identifier: 0BSD\n")));
  }
}

TEST(WithLicence, IsInEveryFileOfAUnitWithItsWrappers) {
  const EmittedDesign unit = DesignFormat{"int_slabs", "8/8"}.emitted(
      {.axi_stream = true, .fifo = true, .hls = true}, {.flow_control = FlowControl::none});
  expect_licence(unit.files());
}

TEST(WithLicence, IsInEveryFileOfAMachine) {
  const Machine& machine = machines().front();
  expect_licence(machine_files(machine, machine.default_format, Library::thesis(), {.cycles = 5}));
}

TEST(WithLicence, IsInEveryFileOfACore) {
  const Core core = make_core({.bits = parse_bits<hls::RayBits>("8+0/4s8")}, Library::thesis());
  expect_licence(core_files(core, Library::thesis(), {}));
}

TEST(WithLicence, IsThereOnce) {
  const host::File once = with_licence(host::File{"u.v", "module u;\nendmodule\n"});
  EXPECT_EQ(with_licence(once).contents, once.contents);
}

TEST(WithLicence, LeavesAFileWithoutCommentsAsItIs) {
  EXPECT_EQ(with_licence(host::File{"drawing.svg", "<svg/>"}).contents, "<svg/>");
}

}  // namespace
}  // namespace hitpipe::rtl::licence_test
