#include "sim/fit/core_cuts.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "rtl_gen/core/feature.hpp"
#include "sim/fit/world_search.hpp"

namespace hitpipe::sim {

namespace {

std::string boxes_text(const hls::RayBits& bits) {
  return fmt::format("/{}", bits.mantissa) +
         (bits.box_fraction == 0 ? "" : fmt::format("f{}", bits.box_fraction));
}

/// By what the coordinates' bits were chosen.
std::string error_text(const CoreFit& fit) {
  const ref::Share& worst = fit.taken()->worst();
  return fmt::format("{} of {} rays differ, at most {:.2g} % (95 %)", worst.part, worst.whole,
                     worst.percent_interval().high);
}

}  // namespace

CoreNeeds needs_of(const std::vector<CoreFitScene>& scenes) {
  CoreNeeds all;
  for (const CoreFitScene& scene : scenes) {
    const ref::CoreHeader& header = scene.image.header;
    all.levels = std::max(all.levels, header.levels);
    all.most_in_leaf = std::max(all.most_in_leaf, header.most_in_leaf);
    all.triangles = std::max(all.triangles, header.in_source());
    all.blocks = std::max<std::uint64_t>(all.blocks, scene.image.blocks.size());
    all.steps = std::max(all.steps, scene.most_steps);
  }
  return all;
}

hls::RayBits with_world(hls::RayBits bits, const hls::WorldBits& world) {
  bits.coord = world.coord;
  bits.finer = world.finer;
  bits.slope = world.slope;
  bits.fraction = world.fraction;
  bits.box_fraction = std::min(bits.box_fraction, world.finer + world.fraction);
  return bits;
}

std::vector<CoreCut> cuts_of(const CoreFit& fit, const CoreFitOptions& options, const rtl::Library& library) {
  std::vector<CoreCut> cuts;
  const CoreNeeds needs = needs_of(fit.scenes);
  const rtl::CoreOptions &was = fit.before, &is = fit.core;
  const auto cut = [&](std::string what, std::string why, const auto& undo) {
    CoreCut made{std::move(what), std::move(why), is, {}};
    undo(made.before);
    try {
      made.without = area::price(rtl::make_core(made.before, library), library).all;
    } catch (const std::runtime_error&) {
      return;  // no such core
    }
    if (size_of(made.without, library) != size_of(fit.price.all, library)) cuts.push_back(std::move(made));
  };
  if (!(was.bits.world() == is.bits.world()))
    cut(fmt::format("coordinates {} of {}", text_of(is.bits.world()), text_of(was.bits.world())),
        options.fixed.world ? "as asked" : error_text(fit),
        [&](rtl::CoreOptions& core) { core.bits = with_world(is.bits, was.bits.world()); });
  const auto number = [&](const char* what, int rtl::CoreOptions::*field, bool fixed, std::string why) {
    if (is.*field == was.*field) return;
    cut(fmt::format("{}: {} of {}", what, is.*field, was.*field), fixed ? "as asked" : std::move(why),
        [&](rtl::CoreOptions& core) { core.*field = was.*field; });
  };
  const CoreFixed& fixed = options.fixed;
  const std::string by_size = options.goal == CoreGoal::rate
                                  ? "least size times blocks that are read"
                                  : fmt::format("at most {:g} % more blocks are read", options.overhead_pct);
  if (is.bits.mantissa != was.bits.mantissa || is.bits.box_fraction != was.bits.box_fraction)
    cut(fmt::format("boxes {} of {}", boxes_text(is.bits), boxes_text(was.bits)),
        fixed.boxes ? "as asked" : by_size, [&](rtl::CoreOptions& core) {
          core.bits.mantissa = was.bits.mantissa;
          core.bits.box_fraction = std::min(was.bits.box_fraction, core.bits.finer + core.bits.fraction);
        });
  number("levels", &rtl::CoreOptions::levels, fixed.levels,
         fmt::format("a path has {} records", needs.levels));
  number("bits of a block's number", &rtl::CoreOptions::address_bits, fixed.block_bits,
         fmt::format("{} blocks", needs.blocks));
  number("bits of an address", &rtl::CoreOptions::byte_bits, fixed.byte_bits, "a memory for one image");
  number("bits of a tag", &rtl::CoreOptions::tag_bits, fixed.tag_bits, "rays in flight have different ones");
  number("bits of a triangle's number", &rtl::CoreOptions::number_bits, fixed.number_bits,
         fmt::format("{} triangles", needs.triangles));
  number("bits of a leaf's count", &rtl::CoreOptions::leaf_bits, fixed.leaf_bits,
         fmt::format("a leaf has at most {} triangles", needs.most_in_leaf));
  number("bits of the steps", &rtl::CoreOptions::step_bits, fixed.step_bits,
         fmt::format("{} times the {} of a ray of the pictures", spare_steps, needs.steps));
  if (is.stack_bits != was.stack_bits)
    cut(fmt::format("places of a stack: {} of {}", 1 << is.stack_bits, 1 << was.stack_bits),
        fixed.stack ? "as asked" : by_size,
        [&](rtl::CoreOptions& core) { core.stack_bits = was.stack_bits; });
  const std::string by_rate = options.rays_per_second > 0
                                  ? fmt::format("{:g} rays a second", options.rays_per_second)
                              : options.goal == CoreGoal::rate ? "most rays a second"
                                                               : "no rate is asked for";
  number("rays in flight", &rtl::CoreOptions::rays, fixed.rays, by_rate);
  const auto option = [&](const char* what, const char* name, bool is_fixed) {
    const rtl::CoreOption& of = rtl::core_option(name);
    if (of.get(is) != of.get(was))
      cut(fmt::format("{}: {} of {}", what, of.text(of.get(is)), of.text(of.get(was))),
          is_fixed ? "as asked" : by_rate, [&](rtl::CoreOptions& core) { of.set(core, of.get(was)); });
  };
  option("cycles a triangle", "--triangle-ii", fixed.triangles);
  option("KiB of the cache", "--cache", fixed.cache);
  if (is.clock_ps != was.clock_ps)
    cut(fmt::format("a clock of {} ps", is.clock_ps.value_or(0)),
        options.core.clock_ps ? "as asked" : by_rate,
        [&](rtl::CoreOptions& core) { core.clock_ps = was.clock_ps; });
  std::stable_sort(cuts.begin(), cuts.end(), [&](const CoreCut& a, const CoreCut& b) {
    return size_of(a.without, library) > size_of(b.without, library);
  });
  return cuts;
}

}  // namespace hitpipe::sim
