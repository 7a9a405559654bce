#include "sim/core/core_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include "rays/image/core_image.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/world/crossing.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_scene.hpp"
#include "rtl_gen/graph/word.hpp"
#include "sim/core/core_bench.hpp"
#include "sim/core/native_core.hpp"
#include "sim/core/vector_scenes.hpp"
#include "sim/vectors/design_vectors.hpp"
#include "sw_ref/core/core_tracer.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/world/edge_lines.hpp"

namespace hitpipe::sim {

namespace {

using ref::adversary::Random;

constexpr std::size_t unit_vectors = 1000;

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

/// By a test of each triangle. `weights` are those of a core that gives them.
rtl::CoreScene::Ray asked(const rtl::Core& core, const CoreJob& job, const ref::IntMesh& mesh) {
  const hls::WorldBits world = core.options.bits.world();
  const ref::IntRay ray = ref::int_ray(job.ray, world);
  const ref::TriangleNumbers numbers(mesh.mesh);
  ref::IntHit best{.triangle = ref::IntHit::none, .t = ray.length};
  std::vector<std::uint64_t> weights(has_weights(core) ? 6 : 0);
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

/// Numbers of triangles in the same order, and with bits in all places.
using Spread = std::function<std::uint32_t(std::uint32_t)>;

/// By a test of each triangle: the count, or the next crossing.
rtl::CoreScene::Ray asked_once(const rtl::Core& core, const CoreJob& job, const ref::IntMesh& mesh,
                               const Spread& spread) {
  const hls::WorldBits world = core.options.bits.world();
  const ref::IntRay ray = ref::int_ray(job.ray, world);
  const ref::TriangleNumbers numbers(mesh.mesh);
  std::uint64_t count = 0;
  std::int64_t sides = 0;
  std::pair<std::int64_t, std::uint32_t> next{ray.length, ref::IntHit::none};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto crossing = ref::crossing_of(ray, mesh.triangles[i], world);
    if (!crossing || !crossing->once) continue;
    ++count;
    sides += crossing->side;
    const std::pair place{crossing->t, spread(numbers.of_source(i))};
    if (place >= std::pair{job.from_t, job.from_number}) next = std::min(next, place);
  }
  const auto bits_of_t = static_cast<std::uint64_t>(rtl::ones_below(core.answer_bits()));
  return {.fields = ray_fields(core, job),
          .number = job.any ? count : next.second,
          .t = static_cast<std::uint64_t>(job.any ? sides : next.first) & bits_of_t,
          .weights = std::vector<std::uint64_t>(has_weights(core) ? 6 : 0)};
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

/// All bits of a triangle's number.
std::uint32_t numbers_of(const rtl::CoreOptions& options) {
  return static_cast<std::uint32_t>(rtl::ones_below(options.number_bits));
}

/// No ray tests more records than the core has bits to count.
rtl::CoreScene scene_with_answers(const rtl::Core& core, const Traced& mesh,
                                  const std::function<CoreJob()>& job) {
  const auto step = std::max(
      1U, static_cast<std::uint32_t>(numbers_of(core.options) / (mesh.image.header.in_source() + 1)));
  const Spread spread = [&](std::uint32_t number) { return number * step + step / 2; };
  const ref::CoreTracer walk(mesh.image, mesh.scene.mesh.mesh,
                             {.world = core.options.bits.world(),
                              .boxes = core.options.bits.boxes(),
                              .places = 1 << core.options.stack_bits});
  const ref::CoreImage image = renumbered(mesh.image, spread);
  rtl::CoreScene scene{.blocks = image.blocks, .rays = {}};
  // Software does not say how often a tie is tested. Alone in the core, a ray reads as much as among others.
  NativeCore alone(core);
  std::optional<CoreBench> bench;
  if (has_questions(core)) bench.emplace(core, alone, image, MemoryOptions{});
  std::optional<CoreJob> behind;  // a ray walks from crossing to crossing
  const auto most_steps = static_cast<std::uint64_t>(rtl::ones_below(core.options.step_bits));
  while (scene.rays.size() < 1000) {
    const CoreJob made = behind ? *behind : job();
    behind.reset();
    if (made.once) {
      const CoreCounts before = bench->counts();
      CoreAnswer answer;
      bench->run({&made, 1}, {&answer, 1});
      if (answer.failed == hls::too_many_steps) continue;
      rtl::CoreScene::Ray& ray = scene.rays.emplace_back(asked_once(core, made, mesh.scene.mesh, spread));
      ray.records = bench->counts().records - before.records;
      ray.triangles = bench->counts().triangles - before.triangles;
      if (!made.any && ray.number != ref::IntHit::none) {
        behind = made;
        behind->from_t = static_cast<std::int64_t>(ray.t);
        behind->from_number = static_cast<std::uint32_t>(ray.number) + 1;
      }
      continue;
    }
    const ref::TraceCounts read = read_for(walk, made);
    if (read.nodes_loaded > most_steps) continue;
    rtl::CoreScene::Ray& ray = scene.rays.emplace_back(asked(core, made, mesh.scene.mesh));
    if (ray.number != ref::IntHit::none) ray.number = spread(static_cast<std::uint32_t>(ray.number));
    ray.records = read.nodes_loaded;
    ray.triangles = read.triangles_loaded;
  }
  return scene;
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
  const auto in_world = [&](const ref::Scene& scene, int most_in_leaf) {
    const int most = std::min(most_in_leaf, (1 << options.leaf_bits) - 2);
    return ref::int_scene(scene, world, {.build = {.builder = ref::Builder::sah, .max_triangles = most}});
  };
  // Walks are long, and some begin again.
  const Traced mesh = traced(options, 84, [&](std::uint32_t triangles) {
    const std::uint32_t some = triangles / 4;
    return chained(in_world(joined(random_scene(triangles - some, 0.1F, random), lattice.scene(some)), 4),
                   std::min({options.levels - 1, 40, 1 << (options.step_bits - 1)}), random);
  });
  // A ray takes some 20 cycles for each block, so these have few.
  const Traced some = traced(options, 16, [&](std::uint32_t triangles) {
    return in_world(
        joined(random_scene(triangles - triangles / 4, 0.4F, random), largest_scene(triangles / 4, random)),
        4);
  });
  const Traced small =
      traced(options, 20, [&](std::uint32_t triangles) { return in_world(lattice.scene(triangles), 2); });
  // A stack has less places, so walks begin again.
  const int places = 1 << options.stack_bits;
  const Traced chain = traced(options, static_cast<std::uint32_t>(4 * places), [&](std::uint32_t triangles) {
    return chained(in_world(largest_scene(triangles, random), 2), options.levels - 1, random);
  });
  // Rays pass 30 levels before they meet much.
  const Traced deep = traced(options, 36, [&](std::uint32_t triangles) {
    const std::uint32_t large = triangles / 6;
    return chained(
        in_world(joined(random_scene(triangles - large, 0.05F, random), random_scene(large, 1.0F, random)),
                 2),
        options.levels - 1, random);
  });
  // Half of the rays want crossings, if they may: count, or the next one behind a place.
  bool is_cycle = true;
  const auto with_a_question = [&](CoreJob made) {
    if (!has_questions(core) || random.below(2) == 0) return made;
    made.once = true;
    // The weights of a count mean nothing, so cycles with one could not be compared.
    made.any = random.below(2) == 0 && (!has_weights(core) || !is_cycle);
    if (random.below(2) == 0) {
      made.from_t =
          static_cast<std::int64_t>(random.bits() % static_cast<rtl::Word>(world.largest_distance()));
      // Of half of them the core may have all bits.
      const rtl::Word drawn = random.bits();
      made.from_number = static_cast<std::uint32_t>(drawn) & (drawn >> 63 == 0 ? ~0U : numbers_of(options));
    }
    return made;
  };
  const auto job = [&]() -> CoreJob {
    ref::Ray ray{.origin = random_point(random), .direction = random_point(random)};
    ray.length = std::ldexp(1.0F, random.between(-6, 3));
    return with_a_question({ray, random.below(3) == 0});
  };
  const auto aimed_job = [&](const ref::IntScene& scene) -> CoreJob {
    CoreJob made = job();
    // A ray from this corner of the cube to the first triangle of largest_scene() has the largest numbers.
    if (random.below(3) == 0) made.ray.origin = glm::vec3(-1);
    if (random.below(3) != 0) made.ray.length = ref::Ray::infinite;
    made.ray.direction = point_of_one(scene, random) - made.ray.origin;
    if (made.ray.direction == glm::vec3(0)) made.ray.direction.x = 1.0F;
    return made;
  };
  const auto lattice_job = [&]() -> CoreJob {
    return with_a_question({lattice.ray(), random.below(4) == 0});
  };
  const auto nearest_job = [&]() -> CoreJob {
    return {{.origin = random_point(random), .direction = random_point(random)}, random.below(16) == 0};
  };
  const auto no_ray = [&]() -> CoreJob {
    CoreJob made = lattice_job();
    made.none = random.below(64) != 0;
    return made;
  };

  // Numbers that differ in two bits. The two images together have all bits.
  const std::uint32_t number = static_cast<std::uint32_t>(random.bits()) & numbers_of(options);
  int bit = 0;
  const auto alike = [&](std::uint32_t) { return number ^ 1U << bit++ % options.number_bits; };
  const ref::CoreImage tied = renumbered(small.image, alike);
  const ref::CoreImage also_tied =
      renumbered(small.image, [&](std::uint32_t each) { return numbers_of(options) ^ alike(each); });
  const ref::CoreImage broken = damaged(renumbered(some.image, alike), options, random);
  const auto all_blocks = static_cast<std::uint64_t>(rtl::ones_below(options.address_bits)) + 1;
  const auto last_base = static_cast<std::uint64_t>(rtl::ones_below(options.byte_bits - 6));
  const Episode episodes[] = {
      {16,
       some.image,
       [&] { return aimed_job(some.scene); },
       {.least_latency = 1, .most_latency = 40, .refused_percent = 10},
       {.base = 2, .held_percent = 30}},
      {16, tied, lattice_job, {.least_latency = 1, .most_latency = 4}, {.base = last_base}},
      {14,
       also_tied,
       lattice_job,
       {.least_latency = 1, .most_latency = 4},
       {.most_steps = 20, .wild_percent = 100, .unruly = true}},
      {18, chain.image, nearest_job, {.least_latency = 1, .most_latency = 1}, {.unruly = true}},
      {14, deep.image, nearest_job, {.least_latency = 1, .most_latency = 1}, {.unruly = true}},
      {4,
       small.image,
       no_ray,
       {.least_latency = 1, .most_latency = 4},
       {.most_steps = 1, .held_percent = 99}},
      {4,
       small.image,
       lattice_job,
       {.least_latency = 1, .most_latency = 20, .error_percent = 20},
       {.most_steps = 5, .gap_percent = 90}},
      {4,
       small.image,
       lattice_job,
       {.least_latency = 1, .most_latency = 10},
       {.base = last_base - 1, .held_percent = 80, .blocks = small.image.blocks.size() / 2}},
      {10,
       broken,
       lattice_job,
       {.least_latency = 1, .most_latency = 4},
       {.most_steps = 20, .blocks = all_blocks, .unruly = true}},
  };
  Recorder recorder(core);
  int percent = 0;
  for (Episode episode : episodes) {
    percent += episode.percent;
    recorder.record_until(static_cast<std::size_t>(cycles) * static_cast<std::size_t>(percent) / 100);
    episode.memory.seed = episode.bench.seed = random.bits();
    record(core, recorder, episode);
  }

  // These begin at odd places too, where a tie moves the origin down. Those of the lattice are even.
  std::vector<ref::IntRay> at_edges;
  if (has_questions(core)) at_edges = ref::edge_rays(mesh.scene.mesh, world, random.bits(), 0, 1000);
  is_cycle = false;
  const auto scene_job = [&]() -> CoreJob {
    if (!at_edges.empty() && random.coin())
      return with_a_question({ref::binary32_ray(at_edges[random.below(at_edges.size())], world)});
    return random.below(4) == 0 ? lattice_job() : aimed_job(mesh.scene);
  };
  rtl::CoreTest test{
      .cycles = std::move(recorder.cycles), .scene = scene_with_answers(core, mesh, scene_job), .units = {}};
  for (const rtl::Part& part : core.parts)
    if (part.pipeline)
      test.units.push_back(design_vectors(*part.design, part.format, unit_vectors, random.bits()));
  return test;
}

}  // namespace hitpipe::sim
