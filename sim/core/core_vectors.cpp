#include "sim/core/core_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "hls/machines/block_kind.hpp"
#include "rtl_gen/graph/word.hpp"
#include "sim/core/core_bench.hpp"
#include "sim/core/native_core.hpp"
#include "sw_ref/core/core_image.hpp"
#include "sw_ref/core/core_tracer.hpp"
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
  explicit Recorder(const rtl::Core& core) : core_(core) {
    for (const rtl::CorePort& port : core.ports) ++(port.pin.is_input ? inputs_ : outputs_);
  }

  void outputs(rtl::Word* outputs) override {
    core_.outputs(outputs);
    given_.assign(outputs, outputs + outputs_);
  }
  /// Throws Enough in place of one more cycle.
  void step(const rtl::Word* inputs, bool reset) override {
    if (full()) throw Enough();
    core_.step(inputs, reset);
    cycles.push_back({reset, {inputs, inputs + inputs_}, given_});
  }
  void state(rtl::Word* /*registers*/) const override {}
  /// So many in all.
  void record_until(std::size_t cycle) { most_ = cycle; }
  struct Enough {};

  std::vector<rtl::MachineCycle> cycles;

 private:
  NativeCore core_;
  [[nodiscard]] bool full() const { return cycles.size() >= most_; }

  std::size_t inputs_ = 0, outputs_ = 0, most_ = 0;
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

ref::Scene joined(ref::Scene scene, const ref::Scene& other) {
  const auto before = static_cast<std::uint32_t>(scene.mesh.vertices.size());
  scene.mesh.vertices.insert(scene.mesh.vertices.end(), other.mesh.vertices.begin(),
                             other.mesh.vertices.end());
  for (const glm::uvec3& triangle : other.mesh.triangles) scene.mesh.triangles.push_back(triangle + before);
  return scene;
}

/// Corners and origins have few places, and directions are 0 or as long as can be on each axis. So rays meet corners
/// and edges, run in planes of triangles, and tie.
class Lattice {
 public:
  Lattice(int coord_bits, Random& random)
      : random_(random), half_((1 << (coord_bits - 2)) - 1), step_(half_ / 4) {}

  ref::Scene scene(std::uint32_t triangles) {
    ref::Scene scene;
    for (std::uint32_t i = 0; i < triangles; ++i) {
      scene.mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
      // Some are there twice, or the other way round.
      const std::size_t before = i == 0 ? 0 : 3 * random_.below(i);
      const int copies = i == 0 ? 0 : random_.between(0, 3);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t from = before + (copies == 1 ? corner : 2 - corner);
        scene.mesh.vertices.push_back(copies == 1 || copies == 2 ? scene.mesh.vertices[from] : place());
      }
    }
    return scene;
  }
  ref::Ray ray() {
    ref::Ray ray{.origin = place(), .direction = {}};
    while (ray.direction == glm::vec3(0))
      for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = static_cast<float>(random_.between(-1, 1));
    // To a place, or without an end.
    ray.length = random_.below(3) == 0 ? ref::Ray::infinite : at(random_.between(0, 6));
    return ray;
  }

 private:
  [[nodiscard]] float at(int steps) const {
    return static_cast<float>(static_cast<double>(steps * step_) / half_);
  }
  glm::vec3 place() {
    const float x = at(random_.between(-3, 3)), y = at(random_.between(-3, 3)),
                z = at(random_.between(-3, 3));
    return {x, y, z};
  }

  Random& random_;
  int half_, step_;
};

struct Traced {
  ref::IntScene scene;
  ref::CoreImage image;
};

/// The scene that is made of so many triangles, or of half as many as long as the core cannot read its image.
template <class Make>
Traced traced(const rtl::CoreOptions& options, std::uint32_t triangles, const Make& make) {
  const std::uint64_t most_blocks = std::uint64_t{1} << options.address_bits;
  for (;; triangles /= 2) {
    ref::IntScene scene =
        ref::int_scene(make(triangles), options.bits.world(), {.build = ref::surface_area_build});
    ref::CoreImage image = ref::core_image(scene);
    if ((image.header.levels <= options.levels && image.blocks.size() <= most_blocks) || triangles == 1)
      return {std::move(scene), std::move(image)};
  }
}

/// Some blocks are of another kind or not there, and some records have another pointer or other children.
ref::CoreImage damaged(ref::CoreImage image, const rtl::CoreOptions& options, Random& random) {
  const int grid = options.bits.coord;
  const auto record_kind = static_cast<std::uint64_t>(hls::kind_byte(hls::record_block, grid));
  // Rays come to the first record, and then to some of the others.
  constexpr std::size_t first = 1 + ref::header_blocks;
  if (image.blocks.size() > first && image.blocks[first].back() >> 56 == record_kind) {
    ref::CoreRecord record = ref::record_of(image.blocks[first]);
    record.counts[0] = ref::PairChild::none;
    image.blocks[first] = to_block(record, grid);
  }
  for (std::size_t place = first + 1; place < image.blocks.size(); ++place) {
    ref::CoreBlock& block = image.blocks[place];
    const bool is_record = block.back() >> 56 == record_kind;
    if (random.below(is_record ? 2 : 8) != 0) continue;
    ref::CoreRecord record = ref::record_of(block);
    switch (random.between(0, is_record ? 4 : 1)) {
      case 0:
        block = {};
        break;
      case 1:
        block.back() ^= std::uint64_t{1} << random.between(56, 63);
        break;
      case 2:
        record.pointer = static_cast<std::uint32_t>(random.bits() >> random.between(32, 63));
        block = to_block(record, grid);
        break;
      default:
        record.counts[random.below(2)] = random.below(4) == 0 ? random.between(1, 254) : ref::PairChild::none;
        block = to_block(record, grid);
    }
  }
  return image;
}

/// By a test of each triangle. `weights` are those of a core that gives them.
rtl::CoreScene::Ray asked(const rtl::Core& core, const CoreJob& job, const ref::IntMesh& mesh) {
  const hls::WorldBits world = core.options.bits.world();
  const ref::IntRay ray = ref::int_ray(job.ray, world);
  const ref::TriangleNumbers numbers(mesh.mesh);
  ref::IntHit best{.triangle = ref::IntHit::none, .t = ray.length};
  std::vector<std::uint64_t> weights(core.options.weights ? 6 : 0);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto crossing = ref::int_crossing(ray, mesh.triangles[i], world);
    if (!crossing || !ref::keep_better(crossing->t, numbers.of_source(i), best) || weights.empty()) continue;
    const auto put = [&](std::size_t place, ref::Int128 size, int width) {
      weights[place] = static_cast<std::uint64_t>(size >> (width / 2));
      weights[place + 1] = static_cast<std::uint64_t>(size & ((ref::Int128{1} << (width / 2)) - 1));
    };
    put(0, crossing->det >> (2 * world.finer), world.determinant());
    put(2, crossing->e[1] >> world.finer, world.edge());
    put(4, crossing->e[2] >> world.finer, world.edge());
  }
  return {.fields = ray_fields(core, job),
          .number = best.triangle,
          .t = static_cast<std::uint64_t>(best.t),
          .weights = std::move(weights)};
}

/// How many blocks the core reads for it. A ray reads one after the other, so this depends on no timing.
ref::TraceCounts read_for(const ref::CoreTracer& walk, const CoreJob& job) {
  std::uint32_t triangle = 0;
  ref::TraceCounts counts;
  walk.trace({.rays = {&job.ray, 1},
              .query = job.any ? ref::Query::any : ref::Query::closest,
              .triangles = {&triangle, 1}},
             counts);
  return counts;
}

/// Some of a testbench's cycles: rays in an image, and what its surroundings do.
struct Episode {
  int percent;  ///< of all cycles
  const ref::CoreImage& image;
  std::function<CoreJob()> job;
  MemoryOptions memory;
  CoreBenchOptions bench;
};

/// The next episode begins with a reset, whatever is in the core.
void record(const rtl::Core& core, Recorder& recorder, const Episode& episode) {
  try {
    CoreBench bench(core, recorder, episode.image, episode.memory, episode.bench);
    for (;;) {
      std::vector<CoreJob> jobs(100);
      std::generate(jobs.begin(), jobs.end(), episode.job);
      std::vector<CoreAnswer> answers(jobs.size());
      bench.run(jobs, answers);
    }
  } catch (const Recorder::Enough&) {
  }
}

}  // namespace

rtl::CoreTest core_test(const rtl::Core& core, int cycles, std::uint64_t seed) {
  const rtl::CoreOptions& options = core.options;
  const hls::WorldBits world = options.bits.world();
  Random random(seed);
  Lattice lattice(world.coord, random);
  const Traced mesh = traced(options, 200, [&](std::uint32_t triangles) {
    return joined(random_scene(triangles - triangles / 4, random), lattice.scene(triangles / 4));
  });
  const Traced small = traced(options, 40, [&](std::uint32_t triangles) { return lattice.scene(triangles); });
  const auto job = [&]() -> CoreJob {
    ref::Ray ray{.origin = point(random), .direction = point(random)};
    ray.length = std::ldexp(1.0F, random.between(-6, 3));
    return {ray, random.below(3) == 0};
  };
  const auto lattice_job = [&]() -> CoreJob { return {lattice.ray(), random.below(4) == 0}; };
  const auto no_ray = [&]() -> CoreJob {
    CoreJob made = lattice_job();
    made.none = random.below(2) == 0;
    return made;
  };

  ref::CoreImage half = small.image;
  half.blocks.resize(half.blocks.size() / 2);
  const ref::CoreImage broken = damaged(small.image, options, random);
  const std::uint64_t last_base = static_cast<std::uint64_t>(rtl::ones_below(options.byte_bits - 6));
  const Episode episodes[] = {
      {35,
       mesh.image,
       job,
       {.least_latency = 1, .most_latency = 40, .refused_percent = 10},
       {.base = 2, .held_percent = 30}},
      {25, small.image, lattice_job, {.least_latency = 1, .most_latency = 4}, {.base = last_base}},
      {10,
       small.image,
       no_ray,
       {.least_latency = 1, .most_latency = 20, .refused_percent = 60},
       {.held_percent = 80, .gap_percent = 60}},
      {10,
       small.image,
       lattice_job,
       {.least_latency = 1, .most_latency = 20, .error_percent = 5},
       {.most_steps = 5, .gap_percent = 90}},
      {10,
       half,
       lattice_job,
       {.least_latency = 1, .most_latency = 10},
       {.base = last_base - 1, .held_percent = 95}},
      {10, broken, lattice_job, {.least_latency = 1, .most_latency = 10}, {.most_steps = 40}},
  };
  Recorder recorder(core);
  int percent = 0;
  for (Episode episode : episodes) {
    percent += episode.percent;
    recorder.record_until(static_cast<std::size_t>(cycles) * static_cast<std::size_t>(percent) / 100);
    episode.memory.seed = episode.bench.seed = random.bits();
    record(core, recorder, episode);
  }

  rtl::CoreTest test{.cycles = std::move(recorder.cycles),
                     .scene = {.blocks = mesh.image.blocks, .rays = {}}};
  const ref::CoreTracer walk(
      mesh.image, mesh.scene.mesh.mesh,
      {.world = world, .boxes = options.bits.boxes(), .places = 1 << options.stack_bits});
  for (int i = 0; i < 1000; ++i) {
    const CoreJob made = i % 2 == 0 ? job() : lattice_job();
    const ref::TraceCounts read = read_for(walk, made);
    test.scene.rays.push_back(asked(core, made, mesh.scene.mesh));
    test.scene.rays.back().records = read.nodes_loaded;
    test.scene.rays.back().triangles = read.triangles_loaded;
  }
  return test;
}

}  // namespace hitpipe::sim
