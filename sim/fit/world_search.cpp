#include "sim/fit/world_search.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "rtl_gen/catalogue/format.hpp"
#include "sw_ref/world/int_error.hpp"

namespace hitpipe::sim {

std::string text_of(const hls::WorldBits& world) {
  return rtl::to_string(rtl::Format(world));
}

namespace {

class WorldSearch {
 public:
  WorldSearch(const std::vector<ref::Scene>& scenes, const CoreFitOptions& options)
      : scenes_(scenes), options_(options) {}

  std::vector<TriedWorld> run() && {
    int least = hls::WorldBits::min_coord, most = hls::WorldBits::max_coord;
    if (error(usual(most)) > options_.error_pct)
      throw std::runtime_error(
          fmt::format("--error {:g}: {:g} % of the rays differ with {}; allowed is that or more",
                      options_.error_pct, error(usual(most)), text_of(usual(most))));
    while (least < most) {
      const int middle = (least + most) / 2;
      if (error(usual(middle)) <= options_.error_pct)
        most = middle;
      else
        least = middle + 1;
    }
    hls::WorldBits best = usual(least);
    const auto improve = [&](const auto& change) {
      hls::WorldBits next = best;
      change(next);
      if (!next.valid() || error(next) > options_.error_pct) return false;
      best = next;
      return true;
    };
    improve([](hls::WorldBits& bits) { bits.finer = 0; });
    while (improve([](hls::WorldBits& bits) { --bits.slope; })) {
    }
    for (TriedWorld& each : tried_) each.taken = each.bits == best;
    return std::move(tried_);
  }

 private:
  static hls::WorldBits usual(int coord) { return {coord, 1, coord}; }

  double error(const hls::WorldBits& bits) {
    for (const TriedWorld& each : tried_)
      if (each.bits == bits) return each.error_pct;
    options_.progress("comparing rays in " + text_of(bits));
    double most = 0;
    for (const ref::Scene& scene : scenes_) {
      ref::IntErrorOptions measured;
      measured.world = bits;
      measured.width = options_.width;
      measured.height = options_.height;
      measured.hierarchy = options_.hierarchy;
      const ref::IntError found = ref::int_error(scene, measured);
      most =
          std::max(most, 100.0 * static_cast<double>(found.different_rays) / static_cast<double>(found.rays));
    }
    tried_.push_back({bits, most});
    return most;
  }

  const std::vector<ref::Scene>& scenes_;
  const CoreFitOptions& options_;
  std::vector<TriedWorld> tried_;
};

}  // namespace

std::vector<TriedWorld> search_world(const std::vector<ref::Scene>& scenes, const CoreFitOptions& options) {
  return WorldSearch(scenes, options).run();
}

}  // namespace hitpipe::sim
