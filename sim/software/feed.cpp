#include "sim/software/feed.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "sim/software/software.hpp"
#include "sim/software/step_feed.hpp"

namespace hitpipe::sim {

std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, const Format& format, const ref::Bvh& bvh,
                                     const ref::CoarseAxes& coarse) {
  if (const std::string why = why_not_traced(design); !why.empty()) throw std::runtime_error(why);
  std::unique_ptr<SceneFeed> feed = software_of(design).feed(format, bvh);
  const int boxes = design.kind.objects;
  if (const int fed = feed->boxes_per_test(); boxes != fed)
    throw std::runtime_error(fmt::format("design {}: answers for {} {} at a time, and its feed is for {}",
                                         design.name, boxes, boxes == 1 ? "box" : "boxes",
                                         fed == 1 ? "one" : "two"));
  if (!coarse.any()) return feed;
  return with_step(std::move(feed), coarse_step(design.ports(format), coarse));
}

}  // namespace hitpipe::sim
