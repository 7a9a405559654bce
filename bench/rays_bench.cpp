// Rays per second of tracers in software, as tables in markdown: Embree 3, if it is installed, today's
// tracer of single boxes, and the fast tracer; in the integer world 20+1s20 today's tracer and the fast walk, rays
// becoming integers in the time that is measured. Primary rays are those of 512 x 512 pixels; from each hit one
// diffuse ray leaves by the cosine of the angle to the plane of the triangle. All trace the same binary32
// rays. Tracers take turns, so that all see the same moods of the machine, and the median of their turns counts.
//   rays_bench [SCENE...]      HITPIPE_BENCH_REPEATS=n
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "host/machine.hpp"
#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/cosine_rays.hpp"
#include "sw_ref/scene/scene.hpp"
#include "sw_ref/trace/fast_tracer.hpp"
#include "sw_ref/trace/ray_queries.hpp"
#include "sw_ref/world/int_tracer.hpp"
#ifdef HITPIPE_EMBREE
#include "bench/embree_tracer.hpp"
#endif

namespace {

namespace ref = hitpipe::ref;
using Rays = std::vector<ref::Ray>;
using Triangles = std::vector<std::uint32_t>;

constexpr int image_side = 512;
constexpr int tile_side = 8;
constexpr std::size_t kinds = 2;  // primary, diffuse
constexpr hitpipe::hls::WorldBits world_bits{20, 1, 20};

/// Whose answers are right. Embree's are compared with nobody's.
enum class World : std::uint8_t { none, floats, integers };
constexpr std::size_t worlds = 3;

struct Contestant {
  std::string name;
  std::function<void(std::span<const ref::Ray>, std::span<std::uint32_t>)> trace;
  World world = World::none;             ///< in which its answers are compared
  std::vector<std::size_t> rivals = {};  ///< with whose rates its own are compared
  std::vector<double> seconds[kinds] = {};

  [[nodiscard]] double rate(std::size_t kind, std::size_t rays) const {
    std::vector<double> sorted = seconds[kind];
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    return static_cast<double>(rays) / sorted[sorted.size() / 2] * 1e-6;
  }
};

Rays primary_rays(const ref::Camera& camera) {
  Rays rays;
  for (int top = 0; top < image_side; top += tile_side)
    for (int left = 0; left < image_side; left += tile_side)
      for (int i = 0; i < tile_side * tile_side; ++i)
        rays.push_back(
            ref::primary_ray(camera, left + i % tile_side, top + i / tile_side, image_side, image_side));
  return rays;
}

Rays diffuse_rays(const ref::Mesh& mesh, const Rays& rays, const Triangles& triangles) {
  constexpr std::uint64_t seed = 1;
  Rays diffuse;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (triangles[i] == ref::Hit::none) continue;
    diffuse.push_back(ref::cosine_ray(ref::flat_surface_point(mesh, triangles[i], rays[i]), seed << 32U | i,
                                      ref::Ray::infinite));
  }
  return diffuse;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Each thread traces a part of the rays. The time of the slowest counts, without what other programs take.
double seconds_of(const Contestant& who, const Rays& rays, Triangles& triangles, std::size_t threads) {
  std::vector<double> seconds(threads);
  const auto part = [&](std::size_t number) {
    const double start = thread_seconds();
    const std::size_t first = rays.size() * number / threads;
    const std::size_t count = rays.size() * (number + 1) / threads - first;
    who.trace(std::span(rays).subspan(first, count), std::span(triangles).subspan(first, count));
    seconds[number] = thread_seconds() - start;
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads; ++i) others.emplace_back(part, i);
    part(0);
  }
  return *std::max_element(seconds.begin(), seconds.end());
}

#ifdef HITPIPE_EMBREE
Contestant embree(const std::string& name, const ref::Mesh& mesh,
                  const hitpipe::bench::EmbreeOptions& options) {
  const auto tracer = std::make_shared<hitpipe::bench::EmbreeTracer>(mesh, options);
  return {.name = name, .trace = [=](auto rays, auto triangles) { tracer->trace(rays, triangles); }};
}
#endif

Contestant ours(const std::string& name, std::shared_ptr<const ref::Tracer> tracer,
                const std::vector<std::size_t>& rivals, World world = World::floats) {
  return {.name = name,
          .trace =
              [=](auto rays, auto triangles) {
                ref::TraceCounts counts;
                tracer->trace({rays, ref::Query::closest, triangles}, counts);
              },
          .world = world,
          .rivals = rivals};
}

Contestant integers(const std::string& name, std::shared_ptr<const ref::RayQueries> queries,
                    const std::vector<std::size_t>& rivals) {
  return {.name = name,
          .trace =
              [=](auto rays, auto triangles) {
                for (std::size_t i = 0; i < rays.size(); ++i)
                  triangles[i] = queries->nearest(rays[i], ref::HitDetail::triangle).triangle;
              },
          .world = World::integers,
          .rivals = rivals};
}

/// Embree's own choice may be wider than AVX2.
std::vector<Contestant> contestants(const ref::Mesh& mesh, const ref::Bvh& bvh, const ref::IntMesh& on_grid,
                                    const ref::Bvh& grid_bvh) {
  std::vector<Contestant> all;
  std::vector<std::size_t> of_four, of_eight;
#ifdef HITPIPE_EMBREE
  constexpr const char* sse2 = "threads=1,isa=sse2";
  constexpr const char* own_choice = "threads=1";
  all.push_back(embree("Embree SSE2", mesh, {sse2, false}));
  all.push_back(embree("Embree robust SSE2", mesh, {sse2, true}));
  all.push_back(embree("Embree robust AVX2", mesh, {"threads=1,isa=avx2", true}));
  all.push_back(embree("Embree best", mesh, {own_choice, false}));
  all.push_back(embree("Embree robust best", mesh, {own_choice, true}));
  of_four = {1};
  of_eight = {2, 4};
#endif
  all.push_back(ours("binary", ref::make_tracer(mesh, bvh, {}), of_four));
  all.push_back(ours("fast, 4", ref::fast_tracer(mesh, bvh, ref::VectorWidth::four), of_four));
  if (ref::has_vectors(ref::VectorWidth::eight))
    all.push_back(ours("fast, 8", ref::fast_tracer(mesh, bvh, ref::VectorWidth::eight), of_eight));
  all.push_back(ours("integer, today", ref::int_tracer(on_grid, &grid_bvh, {.world = world_bits}), of_four,
                     World::integers));
  const auto queries = [&](ref::VectorWidth width) {
    return ref::int_queries(on_grid, &grid_bvh, world_bits, width);
  };
  all.push_back(integers("integer, 4", queries(ref::VectorWidth::four), of_four));
  if (ref::has_vectors(ref::VectorWidth::eight))
    all.push_back(integers("integer, 8", queries(ref::VectorWidth::eight), of_eight));
  return all;
}

struct Row {
  std::string head, cells, ratio_head, ratios;
};

Row row(const std::string& name, std::size_t threads, int repeats) {
  const ref::Scene scene = ref::load_scene(name);
  ref::BuildOptions options = ref::surface_area_build;
  options.max_triangles = 4;
  const ref::Bvh bvh = ref::build_bvh(scene.mesh, options);
  const ref::IntMesh on_grid = ref::int_mesh(scene.mesh, world_bits.coord);
  options.padding = 0;
  const ref::Bvh grid_bvh = ref::build_bvh(on_grid.mesh, options);
  std::vector<Contestant> all = contestants(scene.mesh, bvh, on_grid, grid_bvh);
  Rays rays[kinds] = {primary_rays(scene.camera), {}};
  Triangles right[worlds][kinds];
  const auto judge = [&](World world, const ref::Tracer& tracer, std::size_t kind) {
    Triangles& found = right[static_cast<std::size_t>(world)][kind];
    found.resize(rays[kind].size());
    ref::TraceCounts counts;
    tracer.trace({rays[kind], ref::Query::closest, found}, counts);
    return found;
  };
  const auto of_floats = ref::make_tracer(scene.mesh, bvh, {});
  rays[1] = diffuse_rays(scene.mesh, rays[0], judge(World::floats, *of_floats, 0));
  judge(World::floats, *of_floats, 1);
  const auto of_integers = ref::int_tracer(on_grid, &grid_bvh, {.world = world_bits});
  for (std::size_t kind = 0; kind < kinds; ++kind) judge(World::integers, *of_integers, kind);
  std::string wrong;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    for (int turn = 0; turn < repeats; ++turn) {
      for (Contestant& who : all) {
        Triangles found(rays[kind].size());
        who.seconds[kind].push_back(seconds_of(who, rays[kind], found, threads));
        if (who.world != World::none && found != right[static_cast<std::size_t>(who.world)][kind])
          wrong = who.name;
      }
    }
  }
  if (!wrong.empty()) {
    fmt::print(stderr, "rays_bench: {}: {} finds other triangles\n", name, wrong);
    std::exit(1);
  }
  Row made{"| scene |", "| " + name + " |", "| scene |", "| " + name + " |"};
  for (const Contestant& who : all) {
    const auto rate = [&](const Contestant& whose, std::size_t kind) {
      return whose.rate(kind, rays[kind].size());
    };
    made.head += ' ' + who.name + " |";
    made.cells += fmt::format(" {:.2f} / {:.2f} |", rate(who, 0), rate(who, 1));
    for (const std::size_t number : who.rivals) {
      const Contestant& rival = all[number];
      made.ratio_head += fmt::format(" {} of {} |", who.name, rival.name);
      made.ratios += fmt::format(" {:.0f} / {:.0f} % |", 100 * rate(who, 0) / rate(rival, 0),
                                 100 * rate(who, 1) / rate(rival, 1));
    }
  }
  return made;
}

std::string rule(const std::string& head) {
  std::string line = "|";
  for (auto bars = std::count(head.begin(), head.end(), '|') - 1; bars-- > 0;) line += "---|";
  return line;
}

}  // namespace

int main(int count, char** words) {
  std::vector<std::string> scenes(words + 1, words + count);
  if (scenes.empty()) scenes = {"spheres", "statue", "terrain", "plant_front"};
  const char* const asked = std::getenv("HITPIPE_BENCH_REPEATS");
  const int repeats = asked ? std::max(std::atoi(asked), 1) : 7;
  fmt::print("{}; {}; {}; median of {} turns, processor time; M rays/s, primary / diffuse\n",
             hitpipe::host::processor(), hitpipe::host::compiler(), hitpipe::host::today(), repeats);
  for (const std::size_t threads : {1U, 2U}) {
    std::vector<Row> rows;
    for (const std::string& scene : scenes) rows.push_back(row(scene, threads, repeats));
    fmt::print("\n{} thread{}:\n\n{}\n{}\n", threads, threads == 1 ? "" : "s", rows[0].head,
               rule(rows[0].head));
    for (const Row& each : rows) fmt::print("{}\n", each.cells);
    if (rows[0].ratio_head == "| scene |") continue;
    fmt::print("\n{}\n{}\n", rows[0].ratio_head, rule(rows[0].ratio_head));
    for (const Row& each : rows) fmt::print("{}\n", each.ratios);
  }
}
