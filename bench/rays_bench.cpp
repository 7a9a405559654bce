// What a user of the library gets beside Embree 3, as tables in markdown: rays a second and builds through the C
// interface (<hitpipe/scene.h>), on one thread. Embree is asked by rtcIntersect1, which gives t, u, v and the normal,
// in robust mode with AVX2. Primary rays are those of 512 x 512 pixels; from each hit one diffuse ray leaves by the
// cosine of the angle to the plane of the triangle. All trace the same binary32 rays, and take turns, so that all see
// the same moods of the machine; the median of their turns counts, in processor time.
//   rays_bench [SCENE[*N]...]      each triangle cut in four, N times; HITPIPE_BENCH_REPEATS=n
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <hitpipe/scene.h>
#include <malloc.h>

#include "host/machine.hpp"
#include "rays/scene/scene.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/tree/bvh.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/cosine_rays.hpp"
#include "sw_ref/scene/load_scene.hpp"
#ifdef HITPIPE_EMBREE
#include "bench/embree_tracer.hpp"
#endif

namespace {

namespace ref = hitpipe::ref;
using Rays = std::vector<ref::Ray>;
using Numbers = std::vector<std::uint32_t>;

constexpr int image_side = 512;
constexpr int tile_side = 8;
constexpr std::size_t kinds = 2;  // primary, diffuse

[[noreturn]] void fail(const std::string& why) {
  fmt::print(stderr, "rays_bench: {}\n", why);
  std::exit(1);
}
void check(hitpipe_status status) {
  if (status != HITPIPE_OK) fail(hitpipe_error());
}

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
double median(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  return (all[(all.size() - 1) / 2] + all[all.size() / 2]) / 2;
}
std::size_t allocated() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// Each triangle as four, by the middles of its edges.
void cut_in_four(ref::Mesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, unsigned> middles;
  const auto middle = [&](unsigned a, unsigned b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<unsigned>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) * 0.5F);
    return found->second;
  };
  std::vector<glm::uvec3> cut;
  for (const glm::uvec3& corners : mesh.triangles) {
    const unsigned a = middle(corners.x, corners.y), b = middle(corners.y, corners.z),
                   c = middle(corners.z, corners.x);
    for (const glm::uvec3& part : {glm::uvec3(corners.x, a, c), glm::uvec3(a, corners.y, b),
                                   glm::uvec3(c, b, corners.z), glm::uvec3(a, b, c)})
      cut.push_back(part);
  }
  mesh.triangles = std::move(cut);
}

Rays primary_rays(const ref::Camera& camera) {
  Rays rays;
  for (int top = 0; top < image_side; top += tile_side)
    for (int left = 0; left < image_side; left += tile_side)
      for (int i = 0; i < tile_side * tile_side; ++i)
        rays.push_back(
            ref::primary_ray(camera, left + i % tile_side, top + i / tile_side, image_side, image_side));
  return rays;
}
Rays diffuse_rays(const ref::Mesh& mesh, const Rays& rays, const Numbers& triangles) {
  constexpr std::uint64_t seed = 1;
  Rays diffuse;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (triangles[i] == ref::Hit::none) continue;
    diffuse.push_back(ref::cosine_ray(ref::flat_surface_point(mesh, triangles[i], rays[i]), seed << 32U | i,
                                      ref::Ray::infinite));
  }
  return diffuse;
}
std::vector<hitpipe_ray> own_rays(const Rays& rays) {
  std::vector<hitpipe_ray> own;
  for (const ref::Ray& ray : rays)
    own.push_back({{ray.origin.x, ray.origin.y, ray.origin.z},
                   {ray.direction.x, ray.direction.y, ray.direction.z},
                   ray.length});
  return own;
}

/// A scene of the library, and what it took to make.
struct Opened {
  std::shared_ptr<hitpipe_scene> scene;
  double seconds = 0;
  std::size_t bytes = 0;
};
Opened open(const ref::Mesh& mesh, const char* world, const glm::vec3& eye) {
  const hitpipe_mesh of{&mesh.vertices[0].x, mesh.vertices.size(), &mesh.triangles[0].x,
                        mesh.triangles.size()};
  hitpipe_transform to_cube{};
  check(hitpipe_fit_scene(&of, &eye.x, 1, &to_cube));
  const bool floats = std::string(world) == "float";
  const hitpipe_scene_options options{
      .world = world, .hierarchy = nullptr, .transform = floats ? nullptr : &to_cube, .threads = 1};
  hitpipe_scene* made = nullptr;
  const std::size_t before = allocated();
  const double start = seconds();
  check(hitpipe_scene_open(&of, &options, &made));
  return {{made, hitpipe_scene_close}, seconds() - start, allocated() - before};
}

/// One who is asked, and what.
struct Contestant {
  std::string name;
  std::size_t rival;  ///< with whose rate its own is compared
  std::function<void(std::size_t kind, Numbers& found)> ask;
  bool exact = false;  ///< triangles of the float world
  std::vector<double> turns[kinds] = {};
};

struct Row {
  std::string name;
  std::size_t triangles = 0;
  std::vector<std::string> names;
  std::vector<double> rates[kinds];  ///< M rays a second
  std::vector<std::size_t> rivals;
  std::vector<double> build_seconds, build_bytes;
};

Row measure(const std::string& name, int repeats) {
  const std::size_t star = name.find('*');
  ref::Scene scene = ref::load_scene(name.substr(0, star));
  for (int i = star == std::string::npos ? 0 : std::atoi(name.c_str() + star + 1); i > 0; --i)
    cut_in_four(scene.mesh);
  const ref::Mesh& mesh = scene.mesh;
  Rays rays[kinds] = {primary_rays(scene.camera), {}};
  ref::BuildOptions build = ref::surface_area_build;
  const ref::Bvh bvh = ref::build_bvh(mesh, build);
  const std::unique_ptr<ref::Tracer> exact = ref::make_tracer(mesh, bvh, {});
  Numbers right[kinds];
  const auto judge = [&](std::size_t kind) {
    right[kind].resize(rays[kind].size());
    ref::TraceCounts counts;
    exact->trace({rays[kind], ref::Query::closest, right[kind]}, counts);
  };
  judge(0);
  rays[1] = diffuse_rays(mesh, rays[0], right[0]);
  judge(1);
  const std::vector<hitpipe_ray> own[kinds] = {own_rays(rays[0]), own_rays(rays[1])};

  Row row{.name = name,
          .triangles = mesh.triangles.size(),
          .names = {},
          .rates = {},
          .rivals = {},
          .build_seconds = {},
          .build_bytes = {}};
  const auto built = [&](double took, std::size_t bytes) {
    row.build_seconds.push_back(took);
    row.build_bytes.push_back(static_cast<double>(bytes) / static_cast<double>(row.triangles));
  };
  std::vector<Contestant> all;
  std::size_t of_nearest = 0, of_any = 0, of_count = 0;
#ifdef HITPIPE_EMBREE
  const char* const device = "threads=1,isa=avx2";
  const double start = seconds();
  const hitpipe::bench::EmbreeTracer embree(mesh, {device, true});
  built(seconds() - start, embree.bytes());
  const hitpipe::bench::EmbreeTracer counter(mesh, {device, true, true});
  all.push_back(
      {"Embree nearest", 0, [&](std::size_t kind, Numbers& found) { embree.trace(rays[kind], found); }});
  all.push_back({"Embree any", 1, [&](std::size_t kind, Numbers& found) { embree.any(rays[kind], found); }});
  all.push_back(
      {"Embree count", 2, [&](std::size_t kind, Numbers& found) { counter.count(rays[kind], found); }});
  of_any = 1, of_count = 2;
#endif
  std::vector<Opened> worlds;
  std::vector<double> ts(rays[0].size()), weights(3 * rays[0].size());
  std::vector<std::uint8_t> met(rays[0].size());
  for (const char* const world : {"float", "20+1s20"}) {
    const bool floats = std::string(world) == "float";
    const Opened& made = worlds.emplace_back(open(mesh, world, scene.camera.eye));
    built(made.seconds, made.bytes);
    hitpipe_scene* const asked = made.scene.get();
    const auto nearest = [&, asked](double* t, double* w) {
      return [&, asked, t, w](std::size_t kind, Numbers& found) {
        const hitpipe_nearest_out out{found.data(), t, w};
        check(hitpipe_nearest(asked, own[kind].data(), own[kind].size(), 1, &out));
      };
    };
    all.push_back({fmt::format("{}: number", world), of_nearest, nearest(nullptr, nullptr), floats});
    all.push_back({fmt::format("{}: t", world), of_nearest, nearest(ts.data(), nullptr), floats});
    all.push_back(
        {fmt::format("{}: t, weights", world), of_nearest, nearest(ts.data(), weights.data()), floats});
    all.push_back({fmt::format("{}: any", world), of_any, [&, asked](std::size_t kind, Numbers&) {
                     check(hitpipe_any(asked, own[kind].data(), own[kind].size(), 1, met.data()));
                   }});
    all.push_back({fmt::format("{}: count", world), of_count, [&, asked](std::size_t kind, Numbers& found) {
                     check(
                         hitpipe_count(asked, own[kind].data(), own[kind].size(), 1, found.data(), nullptr));
                   }});
  }
  for (std::size_t kind = 0; kind < kinds; ++kind)
    for (int turn = 0; turn < repeats; ++turn)
      for (Contestant& who : all) {
        Numbers found(rays[kind].size());
        const double from = seconds();
        who.ask(kind, found);
        who.turns[kind].push_back(seconds() - from);
        if (who.exact && found != right[kind])
          fail(fmt::format("{}: {} finds other triangles", name, who.name));
      }
  for (const Contestant& who : all) {
    row.names.push_back(who.name);
    row.rivals.push_back(who.rival);
    for (std::size_t kind = 0; kind < kinds; ++kind)
      row.rates[kind].push_back(static_cast<double>(rays[kind].size()) / median(who.turns[kind]) * 1e-6);
  }
  return row;
}

void print_line(const std::vector<std::string>& cells) {
  fmt::print("|");
  for (const std::string& cell : cells) fmt::print(" {} |", cell);
  fmt::print("\n");
}
void print_head(const std::vector<std::string>& cells) {
  print_line(cells);
  fmt::print("|");
  for (std::size_t i = 0; i < cells.size(); ++i) fmt::print("{}", i == 0 ? "---|" : "--:|");
  fmt::print("\n");
}

}  // namespace

int main(int count, char** words) {
  std::vector<std::string> scenes(words + 1, words + count);
  if (scenes.empty()) scenes = {"spheres", "statue", "terrain", "plant_front", "city", "spheres*2"};
  const char* const asked = std::getenv("HITPIPE_BENCH_REPEATS");
  const int repeats = asked ? std::max(std::atoi(asked), 1) : 5;
  fmt::print("{}; {}; {}; one thread, median of {} turns, processor time\n", hitpipe::host::processor(),
             hitpipe::host::compiler(), hitpipe::host::today(), repeats);
  std::vector<Row> rows;
  for (const std::string& scene : scenes) rows.push_back(measure(scene, repeats));

  fmt::print("\nM rays/s, primary / diffuse:\n\n");
  std::vector<std::string> head{""};
  for (const Row& row : rows) head.push_back(row.name);
  print_head(head);
  std::vector<std::string> sizes{"triangles"};
  for (const Row& row : rows) sizes.push_back(fmt::format("{}", row.triangles));
  print_line(sizes);
  for (std::size_t who = 0; who < rows[0].names.size(); ++who) {
    std::vector<std::string> cells{rows[0].names[who]};
    for (const Row& row : rows)
      cells.push_back(fmt::format("{:.2f} / {:.2f}", row.rates[0][who], row.rates[1][who]));
    print_line(cells);
  }
#ifdef HITPIPE_EMBREE
  fmt::print("\nShare of Embree robust's rays over the scenes, %: least, median, most.\n\n");
  print_head({"", "primary", "diffuse"});
  for (std::size_t who = 3; who < rows[0].names.size(); ++who) {
    std::vector<std::string> cells{rows[0].names[who]};
    for (const auto kind : {0, 1}) {
      std::vector<double> shares;
      for (const Row& row : rows)
        shares.push_back(100 * row.rates[kind][who] / row.rates[kind][row.rivals[who]]);
      std::sort(shares.begin(), shares.end());
      cells.push_back(fmt::format("{:.0f}, {:.0f}, {:.0f}", shares.front(), median(shares), shares.back()));
    }
    print_line(cells);
  }
#endif
  fmt::print("\nBuild: seconds, and bytes a triangle afterwards.\n\n");
  print_head(head);
  const std::size_t worlds = rows[0].build_seconds.size();
  for (std::size_t who = 0; who < worlds; ++who) {
    std::vector<std::string> cells{worlds == 3 && who == 0 ? "Embree"
                                   : who + 1 == worlds     ? "20+1s20"
                                                           : "float"};
    for (const Row& row : rows)
      cells.push_back(fmt::format("{:.2f}, {:.0f}", row.build_seconds[who], row.build_bytes[who]));
    print_line(cells);
  }
}
