#include "sim/fit/world_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "host/format.hpp"
#include "sw_ref/world/int_error.hpp"

namespace hitpipe::sim {

std::string text_of(const hls::WorldBits& world) {
  return to_string(Format(world));
}

namespace {

/// A picture of the same shape with so many pixels, as far as pictures may be.
std::pair<int, int> with_pixels(int width, int height, double pixels) {
  const double longest = std::max(width, height);
  const double most = std::max(longest, double{most_compared_side}) / longest;
  const double scale = std::clamp(std::sqrt(pixels / width / height), 1.0, most);
  return {static_cast<int>(std::lround(width * scale)), static_cast<int>(std::lround(height * scale))};
}

class WorldSearch {
 public:
  WorldSearch(const std::vector<ref::Scene>& scenes, const CoreFitOptions& options)
      : scenes_(scenes), options_(options), needed_(rays_that_tell(options.error_pct)) {
    std::tie(width_, height_) =
        with_pixels(options.width, options.height,
                    needed_ ? static_cast<double>(*needed_) : std::numeric_limits<double>::infinity());
  }

  std::vector<TriedWorld> run() && {
    int least = hls::WorldBits::min_coord, most = hls::WorldBits::max_coord;
    if (!keeps(usual(most))) {
      const ref::Share& worst = tried(usual(most)).worst();
      throw std::runtime_error(fmt::format(
          "--error {:g}: {} of {} rays differ with {}, up to {:.2g} % by the 95 % interval; allowed is that "
          "or more",
          options_.error_pct, worst.part, worst.whole, text_of(usual(most)), worst.percent_interval().high));
    }
    while (least < most) {
      const int middle = (least + most) / 2;
      if (keeps(usual(middle)))
        most = middle;
      else
        least = middle + 1;
    }
    hls::WorldBits best = usual(least);
    const auto improve = [&](const auto& change) {
      hls::WorldBits next = best;
      change(next);
      if (!next.valid() || !keeps(next)) return false;
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

  bool keeps(const hls::WorldBits& bits) {
    return std::ranges::all_of(tried(bits).different, [&](const ref::Share& rays) {
      const bool telling = needed_ && rays.whole >= *needed_;
      return rays.percent_interval().high <= options_.error_pct || (!telling && rays.part == 0);
    });
  }
  const TriedWorld& tried(const hls::WorldBits& bits) {
    const auto known = std::ranges::find(tried_, bits, &TriedWorld::bits);
    if (known != tried_.end()) return *known;
    options_.progress("comparing rays in " + text_of(bits));
    TriedWorld made{.bits = bits, .different = {}};
    for (const ref::Scene& scene : scenes_) {
      ref::IntErrorOptions measured;
      measured.world = bits;
      measured.width = width_;
      measured.height = height_;
      measured.hierarchy = options_.hierarchy;
      made.different.push_back(ref::int_error(scene, measured).different());
    }
    return tried_.emplace_back(std::move(made));
  }

  const std::vector<ref::Scene>& scenes_;
  const CoreFitOptions& options_;
  std::optional<std::uint64_t> needed_;
  int width_ = 0, height_ = 0;
  std::vector<TriedWorld> tried_;
};

}  // namespace

std::optional<std::uint64_t> rays_that_tell(double error_pct) {
  const double error = error_pct / 100;
  if (error <= 0) return std::nullopt;
  constexpr double normal_quantile = 1.96;
  const double rays = 4 * normal_quantile * normal_quantile * (1 - error) / error;
  return static_cast<std::uint64_t>(std::ceil(std::max(rays, 1.0)));
}

const ref::Share& TriedWorld::worst() const {
  return *std::ranges::max_element(different, {},
                                   [](const ref::Share& s) { return s.percent_interval().high; });
}

std::vector<TriedWorld> search_world(const std::vector<ref::Scene>& scenes, const CoreFitOptions& options) {
  return WorldSearch(scenes, options).run();
}

}  // namespace hitpipe::sim
