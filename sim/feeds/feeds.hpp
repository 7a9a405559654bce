// The set-up of each design: what make_feed() and make_box_test() look up by name.
#pragma once

#include <memory>

#include "rtl_gen/catalogue/format.hpp"
#include "sim/check/box_test.hpp"
#include "sim/feed.hpp"
#include "sw_ref/bvh/bvh.hpp"

namespace hitpipe::sim {

/// As make_feed(), for a format of the design.
[[nodiscard]] std::unique_ptr<SceneFeed> fp_slabs_feed(rtl::Format format, const ref::Bvh& bvh);
[[nodiscard]] std::unique_ptr<SceneFeed> int_slabs_feed(rtl::Format format, const ref::Bvh& bvh);
[[nodiscard]] std::unique_ptr<SceneFeed> fp_plucker_feed(rtl::Format format, const ref::Bvh& bvh);
[[nodiscard]] std::unique_ptr<SceneFeed> int_plucker_feed(rtl::Format format, const ref::Bvh& bvh);

/// As make_box_test(), likewise.
[[nodiscard]] std::unique_ptr<BoxTest> fp_slabs_test(const rtl::Design& design, rtl::Format format);
[[nodiscard]] std::unique_ptr<BoxTest> int_slabs_test(const rtl::Design& design, rtl::Format format);
[[nodiscard]] std::unique_ptr<BoxTest> fp_plucker_test(const rtl::Design& design, rtl::Format format);
[[nodiscard]] std::unique_ptr<BoxTest> int_plucker_test(const rtl::Design& design, rtl::Format format);

}  // namespace hitpipe::sim
