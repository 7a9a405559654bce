// Answers say where in its triangle a ray hits (hls/machines/weights.hpp). The machine `weights` keeps det, u and v of
// each ray's best hit, and stands behind `replies`.
#include "hls/machines/weights.hpp"

#include <array>

#include <fmt/format.h>

#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::weights {

namespace {

using namespace hls::channels;

constexpr std::array links{
    link<Divides>("divider", "weights"),
    link<Hits, HitsToWeights>("replies", "weights"),
    link<Freed, FreedToWeights>("replies", "weights"),
    link<Freed>("weights", "door"),
};

std::vector<CorePin> pins() {
  using namespace hls::weights;
  return {
      output(HitDet::high, "weights", "det, u and v of the hit; weight 1 is |u| / (2^g |det|)"),
      output(HitDet::low, "weights", ""),
      output(HitU::high, "weights", ""),
      output(HitU::low, "weights", ""),
      output(HitV::high, "weights", "weight 2 is |v| / (2^g |det|)"),
      output(HitV::low, "weights", ""),
  };
}

void change(CorePlan& plan, const CoreOptions& options) {
  const hls::WorldBits world = options.bits.world();
  plan.add_behind("replies", {"weights", "weights",
                              hls::WeightBits{.determinant = world.determinant(),
                                              .edge = world.edge(),
                                              .distance = options.bits.distance(),
                                              .tag = options.tag_bits,
                                              .ray = options.ray_bits()}});
  plan.change<hls::WorldBits>("triangle", [](hls::WorldBits& bits) { bits.weights = 1; });
  plan.remove_link("replies", "door");
  plan.add_links(links);
  plan.units.push_back({"", "triangle", {"weights"}});
  for (CorePin& pin : plan.pins)
    if (pin.part == "replies") pin.part = "weights";
  for (const CorePin& pin : pins())
    plan.pins.push_back(
        pin.meant("want_hit_valid && want_hit_failed == 3'd0 && want_hit_number != 32'hffffffff"));
}

CHeaderPart c_header(const Core& core) {
  const hls::WorldBits world = core.options.bits.world();
  const auto size = [](const char* name, int bits) {
    return fmt::format("fabs(ldexp((double)hit->{0}_high, {1}) + (double)hit->{0}_low)", name, bits / 2);
  };
  return {.includes = {"math.h"},
          .functions = fmt::format(R"(
/* Weights of corners 1 and 2 where the ray hits its triangle; that of corner 0 is the rest to 1. */
static inline void core_weights(const struct core_hit* hit, double* weight_1, double* weight_2) {{
  const double det = ldexp({0}, {1});
  *weight_1 = {2} / det;
  *weight_2 = {3} / det;
}}
)",
                                   size("det", world.determinant()), world.finer, size("u", world.edge()),
                                   size("v", world.edge()))};
}

}  // namespace

const Feature& feature() {
  static const Feature feature{
      .name = "weights",
      .what = "weights of the corners",
      .summary = "answers say where in its triangle a ray hits",
      .smallest = "--weights",
      .is_in = [](const CoreOptions& options) { return options.weights; },
      .options = {{.group = CoreOption::Group::core,
                   .name = "--weights",
                   .help = "Answers say where in its triangle a ray hits",
                   .get = number_at<&CoreOptions::weights>,
                   .set = put_number<&CoreOptions::weights>,
                   .is_flag = true}},
      .excludes = {{"rings", "rays at pins"}, {"serial_triangle", "a triangle unit"}},
      .change = change,
      .identify = [](CoreIdentity& identity,
                     const CoreOptions& options) { identity.put("weights", options.weights ? 1 : 0); },
      .c_header = c_header,
      .harness = "weights",
      .promises = {{"an answer has its best hit",
                    "weights",
                    "d25e25t4g1i1",
                    {{R"(s/best_det\[ray_wanted\]/best_det[ray]/)"}}},
                   {.what = "the core with them", .test = "PairedCore.PassesInAllTools"}}};
  return feature;
}

}  // namespace hitpipe::rtl::features::weights
