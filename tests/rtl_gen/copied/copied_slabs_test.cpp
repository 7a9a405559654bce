// A copied pipeline with one changed line, linked with the original: each gives its own hardware.
#include "tests/rtl_gen/copied/copied_slabs.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hls/pipelines/int_slabs.hpp"
#include "rtl_gen/catalogue/traced.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module.hpp"

namespace hitpipe::rtl::copied_slabs_test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr hls::IntBits bits{20, 24};

std::string verilog(const Graph& graph) {
  return to_verilog(make_pipeline(graph, Library::thesis()), Library::thesis(),
                    {.module_name = graph.name(), .bits = "20/24"});
}

/// HIT of an endless ray along +x that starts in the middle, against the point at 100.
std::uint64_t hit_of_a_point(const Graph& graph) {
  std::vector<std::uint64_t> operands;
  for (const NodeId id : graph.inputs()) {
    const std::string& name = graph[id].name;
    const bool one = name == "rinf" || name == "iri_floor" || name == "iri_ceil";
    operands.push_back(name == "ixmin" || name == "ixmax" ? 100U : one ? 1U : 0U);
  }
  return evaluate(graph, operands).front();
}

TEST(CopiedPipeline, HasTheChangedLineAndTheOriginalHasNot) {
  const Graph original = traced<hls::IntSlabs>(bits);
  const Graph copy = copied_slabs(bits);
  EXPECT_EQ(hit_of_a_point(original), 1U) << "near and far are equal: not apart";
  EXPECT_EQ(hit_of_a_point(copy), 0U) << "the copy says ~(near < far)";

  EXPECT_THAT(verilog(original), HasSubstr("// stage 4, hls/pipelines/int_slabs.hpp:"));
  EXPECT_THAT(verilog(original), Not(HasSubstr("copied_slabs")));
  EXPECT_THAT(verilog(copy), HasSubstr("// stage 4, hls/pipelines/copied_slabs.hpp:"));
  EXPECT_THAT(verilog(copy), Not(HasSubstr("int_slabs")));
}

}  // namespace
}  // namespace hitpipe::rtl::copied_slabs_test
