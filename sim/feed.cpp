#include "sim/feed.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "sim/feeds/coarse.hpp"
#include "sim/feeds/feeds.hpp"

namespace hitpipe::sim {

namespace {

struct Makers {
  std::string_view design;
  std::unique_ptr<SceneFeed> (*feed)(rtl::Format, const ref::Bvh&);
  std::unique_ptr<BoxTest> (*test)(const rtl::Design&, rtl::Format);
};

constexpr Makers makers[] = {{"fp_slabs", fp_slabs_feed, fp_slabs_test},
                             {"int_slabs", int_slabs_feed, int_slabs_test},
                             {"fp_plucker", fp_plucker_feed, fp_plucker_test},
                             {"int_plucker", int_plucker_feed, int_plucker_test}};

const Makers& makers_of(const rtl::Design& design) {
  for (const Makers& found : makers) {
    if (found.design == design.name) return found;
  }
  throw std::runtime_error(
      fmt::format("design {}: there is no set-up of rays and boxes for its operands", design.name));
}

}  // namespace

std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, rtl::Format format, const ref::Bvh& bvh,
                                     const ref::CoarseAxes& coarse) {
  std::unique_ptr<SceneFeed> feed = makers_of(design).feed(format, bvh);
  if (!coarse.any()) return feed;
  return with_step(std::move(feed), coarse_step(rtl::input_ports(design.trace(format)), coarse));
}

std::unique_ptr<BoxTest> make_box_test(const rtl::Design& design, rtl::Format format) {
  return makers_of(design).test(design, format);
}

}  // namespace hitpipe::sim
