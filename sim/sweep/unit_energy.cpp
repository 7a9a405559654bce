#include "sim/sweep/unit_energy.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

namespace {

constexpr std::size_t sampled_tests = 2000;

/// Whether the cells have every component of the pipeline.
bool has_all(const rtl::Library& cells, const rtl::Graph& graph) {
  for (rtl::NodeId id = 0; id < graph.size(); ++id) {
    if (!is_component(graph[id].op)) continue;
    const rtl::ComponentUse use = component_of(graph, id);
    try {
      static_cast<void>(cells.cell(use.component, use.bits));
    } catch (const std::runtime_error&) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<area::Toggles> scene_toggles(const rtl::Design& design, const Format& format,
                                           const rtl::Pipeline& pipeline, const ref::Scene& scene,
                                           const ref::Bvh& bvh, const SceneTestOptions& options) {
  static const rtl::Library cells = rtl::library_called("osu018");
  if (!has_all(cells, pipeline.graph)) return std::nullopt;
  const std::unique_ptr<BoardTests> drawn = scene_tests(design, format, scene, bvh, options);
  std::vector<std::vector<std::int64_t>> tests;
  while (tests.size() < sampled_tests) {
    std::optional<rtl::Vector> test = drawn->next();
    if (!test) break;
    tests.push_back(std::move(test->operands));
  }
  if (tests.size() < 2) return std::nullopt;
  // One ray comes after the other; in the unit tests of many rays alternate.
  ref::adversary::Random random(options.seed);
  for (std::size_t i = tests.size(); i-- > 1;) std::swap(tests[i], tests[random.below(i + 1)]);
  return area::toggles_of(pipeline, cells, tests);
}

}  // namespace hitpipe::sim
