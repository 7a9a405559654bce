#include "sim/feed.hpp"

#include <stdexcept>
#include <utility>

#include "sim/feeds/coarse.hpp"
#include "sim/software.hpp"

namespace hitpipe::sim {

std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, const rtl::Format& format,
                                     const ref::Bvh& bvh, const ref::CoarseAxes& coarse) {
  if (const std::string why = why_not_traced(design); !why.empty()) throw std::runtime_error(why);
  std::unique_ptr<SceneFeed> feed = software_of(design).feed(format, bvh);
  if (!coarse.any()) return feed;
  return with_step(std::move(feed), coarse_step(design.ports(format), coarse));
}

}  // namespace hitpipe::sim
