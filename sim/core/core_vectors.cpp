#include "sim/core/core_vectors.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "sim/core/core_bench.hpp"
#include "sim/core/native_core.hpp"
#include "sw_ref/core/core_image.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/scene/triangle_numbers.hpp"
#include "sw_ref/world/int_ray.hpp"
#include "sw_ref/world/int_scene.hpp"

namespace hitpipe::sim {

namespace {

using ref::adversary::Random;

/// Keeps what goes in and comes out, until it has enough.
class Recorder final : public rtl::NativeMachine {
 public:
  Recorder(const rtl::Core& core, std::size_t most) : core_(core), most_(most) {
    for (const rtl::CorePort& port : core.ports) ++(port.pin.is_input ? inputs_ : outputs_);
  }

  void outputs(rtl::Word* outputs) override {
    core_.outputs(outputs);
    given_.assign(outputs, outputs + outputs_);
  }
  void step(const rtl::Word* inputs, bool reset) override {
    core_.step(inputs, reset);
    if (!full()) cycles.push_back({reset, {inputs, inputs + inputs_}, given_});
  }
  void state(rtl::Word* /*registers*/) const override {}
  [[nodiscard]] bool full() const { return cycles.size() == most_; }

  std::vector<rtl::MachineCycle> cycles;

 private:
  NativeCore core_;
  std::size_t inputs_ = 0, outputs_ = 0, most_;
  std::vector<rtl::Word> given_;
};

/// -1..1
float coordinate(Random& random) {
  return static_cast<float>(random.between(-1'000'000, 1'000'000)) * 1e-6F;
}
glm::vec3 point(Random& random) {
  const float x = coordinate(random), y = coordinate(random), z = coordinate(random);
  return {x, y, z};
}

ref::Scene random_scene(std::uint32_t triangles, Random& random) {
  ref::Scene scene;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const glm::vec3 corner = point(random);
    scene.mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    for (int other = 0; other < 3; ++other)
      scene.mesh.vertices.push_back(glm::clamp(corner + 0.4F * point(random), -1.0F, 1.0F));
  }
  return scene;
}

/// The scene and its image, with at most so many triangles, and with no more levels than the core walks.
std::pair<ref::IntScene, ref::CoreImage> scene_for(const rtl::CoreOptions& options,
                                                   std::uint64_t most_triangles, Random& random) {
  for (auto triangles = static_cast<std::uint32_t>(most_triangles);; triangles /= 2) {
    ref::IntScene scene = ref::int_scene(random_scene(triangles, random), options.bits.world(),
                                         {.build = ref::surface_area_build});
    ref::CoreImage image = ref::core_image(scene);
    if (image.header.levels <= options.levels || triangles == 1) return {std::move(scene), std::move(image)};
  }
}

/// By a test of each triangle.
ref::IntHit nearest(const ref::IntRay& ray, const ref::IntMesh& mesh, const hls::WorldBits& world) {
  const ref::TriangleNumbers numbers(mesh.mesh);
  ref::IntHit best{.triangle = ref::IntHit::none, .t = ray.length};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto crossing = ref::int_crossing(ray, mesh.triangles[i], world);
    if (crossing) ref::keep_better(crossing->t, numbers.of_source(i), best);
  }
  return best;
}

}  // namespace

rtl::CoreTest core_test(const rtl::Core& core, int cycles, std::uint64_t seed) {
  const hls::WorldBits world = core.options.bits.world();
  Random random(seed);
  // A tree of n leaves has less than n records beside the root's own; a header and perhaps an empty block follow.
  const std::uint64_t most_blocks = std::uint64_t{1} << core.options.address_bits;
  const auto [scene, image] =
      scene_for(core.options, std::min<std::uint64_t>(200, most_blocks / 2 - 2), random);
  const auto job = [&]() -> CoreJob {
    const ref::Ray ray{.origin = point(random), .direction = point(random), .length = 2.0F};
    return {ray, random.below(3) == 0};
  };

  Recorder recorder(core, static_cast<std::size_t>(cycles));
  CoreBench bench(core, recorder, image,
                  {.least_latency = 1, .most_latency = 40, .refused_percent = 10, .seed = seed},
                  {.base = 5, .held_percent = 30, .seed = seed});
  while (!recorder.full()) {
    std::vector<CoreJob> jobs(100);
    std::generate(jobs.begin(), jobs.end(), job);
    std::vector<CoreAnswer> answers(jobs.size());
    bench.run(jobs, answers);
  }

  rtl::CoreTest test{.cycles = std::move(recorder.cycles), .scene = {.blocks = image.blocks, .rays = {}}};
  for (int i = 0; i < 1000; ++i) {
    const CoreJob next = job();
    const ref::IntHit hit = nearest(ref::int_ray(next.ray, world), scene.mesh, world);
    test.scene.rays.push_back({ray_fields(core, next), hit.triangle, static_cast<std::uint64_t>(hit.t)});
  }
  return test;
}

}  // namespace hitpipe::sim
